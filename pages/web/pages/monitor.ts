// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The monitor page: a control or a transfer as it is just now. It asks for small answers and keeps no connection.
import { Chart, type ChartInput } from "../parts/chart";
import { card, choice, h, type Child } from "../parts/dom";
import { views } from "../parts/orbit";
import { drawPage, footer, masthead } from "../parts/page";
import { PathView } from "../parts/path_view";
import { poll } from "../parts/poll";
import { alarmList, axesTable, banner, keyFigures, ledgerTable, transferBody } from "./monitor_cards";
import type { Curves, MonitorInput, Now, ProgramPath, State, Track } from "./monitor_input";

/** What the server keeps as well. */
const mostSamples = 900;
const kilo = 1000;

type Values = (number | null)[];

/** The curves so far, and the two charts of them. */
class RunningCurves {
  private next = 0;
  private readonly time_s: number[] = [];
  private readonly values: Record<"feed" | "override" | "fifo" | "link", Values> = { feed: [], override: [], fifo: [], link: [] };
  readonly motion = new Chart(this.motionInput());
  readonly feeding = new Chart(this.feedingInput());

  get cursor(): number {
    return this.next;
  }

  take(curves: Curves): void {
    if (curves.time_s.length === 0) return;
    this.next = curves.from + curves.time_s.length;
    this.time_s.push(...curves.time_s);
    this.values.feed.push(...curves.feed_mm_per_min);
    this.values.override.push(...curves.override_percent);
    this.values.fifo.push(...curves.fifo_percent);
    this.values.link.push(...curves.link_bytes_per_s.map((value) => (value === null ? null : value / kilo)));
    const surplus = Math.max(0, this.time_s.length - mostSamples);
    for (const list of [this.time_s, ...Object.values(this.values)]) list.splice(0, surplus);
    this.motion.feed(this.time_s, this.motionInput().curves.map((curve) => curve.values));
    this.feeding.feed(this.time_s, this.feedingInput().curves.map((curve) => curve.values));
  }

  private base(label: string, y_name: string, y_unit: string): Omit<ChartInput, "curves"> {
    return { label, x_name: "time", x_unit: "s", x: this.time_s, x_places: 1, y_name, y_unit, height_px: 200 };
  }

  private motionInput(): ChartInput {
    return { ...this.base("Feed and override over time", "feed", "mm/min"), y2: { name: "override", unit: "%", low: 0, high: 125 },
      curves: [
        { name: "feed", values: this.values.feed, color: "series", places: 0 },
        { name: "override", values: this.values.override, color: "beyond", dash: [6, 4], places: 0, scale: "y2" },
      ] };
  }

  private feedingInput(): ChartInput {
    return { ...this.base("Link rate and FIFO fill over time", "link", "kB/s"), y2: { name: "FIFO", unit: "%", low: 0, high: 105 },
      curves: [
        { name: "link", values: this.values.link, color: "series", places: 1 },
        { name: "FIFO", values: this.values.fifo, color: "beyond", dash: [6, 4], places: 0, scale: "y2" },
      ] };
  }
}

/** The picture, told what is new. */
class LivePath {
  readonly view = new PathView("Tool path with the tool");
  readonly note = h("p", { class: "soft hint" }, "");
  run = 0;
  point = 0;
  private version = 0;
  private path: ProgramPath | undefined;

  take(track: Track): boolean {
    if (track.run !== this.run) {
      this.run = track.run;
      this.point = 0;
      this.view.clearDone();
    }
    if (track.from === this.point && track.cutting.length > 0) {
      this.view.addDone(track.tip_mm, track.cutting);
      this.point += track.cutting.length;
    }
    this.view.element.dataset["points"] = String(this.point);
    return this.point < track.count;
  }

  async follow(version: number): Promise<void> {
    if (version === this.version) return;
    this.version = version;
    const path = (await (await fetch("path", { cache: "no-store" })).json()) as ProgramPath;
    this.path = path;
    this.view.showPlanned(path.tip_mm ?? [], path.rapid ?? []);
    this.view.element.dataset["planned"] = String(path.points ?? 0);
    this.note.textContent = !path.points ? "The programmed path is not known here; what the tool does is drawn as it comes."
      : path.whole === false ? "The programmed path could not be read to its end; its beginning is drawn." : "";
  }

  /** Where the control says the tool is, or else the end of the line it says it runs. */
  place(now: Now): void {
    if (now.tool) return this.view.placeTool(now.tool.tip_mm, now.tool.axis);
    const lines = this.path?.line;
    const tips = this.path?.tip_mm;
    if (!now.line || !lines?.length || !tips) return;
    let index = lines.findIndex((line) => line >= (now.line as number));
    if (index < 0) index = lines.length - 1;
    this.view.placeTool(tips.slice(3 * index, 3 * index + 3), [0, 0, 1]);
  }
}

function pathCard(path: LivePath): HTMLElement {
  const look = h("div", { class: "choice", role: "group", "aria-label": "View" }, ...Object.entries(views).map(([name, from]) => {
    const button = h("button", { type: "button" }, name);
    button.addEventListener("click", () => path.view.look(from));
    return button;
  }));
  const key = h("p", { class: "soft key" }, h("span", { class: "stroke planned" }), "programmed ", h("span", { class: "stroke done" }), "run ",
    h("span", { class: "stroke rapid" }), "run, rapid ", h("span", { class: "dot" }), "tool");
  return card("path", "Tool path", look, path.view.element, key, path.note);
}

/** Commands exist where the server was told to take them and the address carries the word that permits it. */
function commandsCard(input: MonitorInput): Child {
  const token = location.hash.slice(1);
  if (!input.commands || !token) return null;
  const said = h("span", { role: "status" });
  const give = async (command: object): Promise<void> => {
    const answer = await fetch("command", { method: "POST", headers: { "X-Cusp-Token": token, "Content-Type": "application/json" }, body: JSON.stringify(command) });
    said.textContent = answer.ok ? "" : "refused";
  };
  const button = (name: string, command: object): HTMLElement => {
    const element = h("button", { type: "button" }, name);
    element.addEventListener("click", () => void give(command));
    return element;
  };
  const percent = h("output", {}, "100 %");
  const slider = h("input", { type: "range", min: 0, max: 120, step: 5, value: 100, "aria-label": "Feed override in percent" });
  slider.addEventListener("input", () => (percent.textContent = `${slider.value} %`));
  slider.addEventListener("change", () => void give({ do: "override", value: Number(slider.value) }));
  return card("commands", "Commands", said,
    h("div", { class: "controls" }, h("div", { class: "choice", role: "group", "aria-label": "Commands" }, button("NC stop", { do: "stop" }), button("Reset", { do: "reset" })),
      h("label", {}, "Override", slider, percent),
      choice("Single block", [{ name: "Continuous", value: 0 }, { name: "Single block", value: 1 }], 0, (value) => void give({ do: "single", value }))),
    h("p", { class: "soft" }, "The start belongs to whoever stands at the control. A software hold is no emergency stop."));
}

function draw(input: MonitorInput): Child[] {
  const curves = new RunningCurves();
  const path = new LivePath();
  const slot = (): HTMLElement => h("div", {});
  const live = { state: slot(), figures: slot(), axes: slot(), alarms: slot(), transfer: slot(), ledger: slot() };
  let now: Now | null = null;
  let drawn = "";
  const show = (lost: boolean): void => {
    live.state.replaceChildren(banner(input, now, lost));
    document.body.dataset["connection"] = lost ? "lost" : "held";
    if (!now) return;
    live.figures.replaceChildren(keyFigures(now));
    live.axes.replaceChildren(axesTable(now) as Node);
    live.alarms.replaceChildren(alarmList(now) as Node);
    live.transfer.replaceChildren(transferBody(now) as Node);
    const ledger = JSON.stringify(now.ledger ?? []);
    if (ledger !== drawn || !live.ledger.firstChild) live.ledger.replaceChildren(ledgerTable(now) as Node);
    drawn = ledger;
  };
  show(false);
  poll<State>(
    () => `state?sample=${curves.cursor}&run=${path.run}&point=${path.point}`,
    (state) => {
      now = state.now;
      curves.take(state.curves);
      const more = path.take(state.track);
      void path.follow(state.path);
      if (now) path.place(now);
      show(false);
      return more;
    },
    () => show(true));
  const title = input.title ?? "Monitor";
  return [
    masthead(input.kind === "transfer" ? "Transfer" : "Control", title, [input.machine ?? "", ...(input.links ?? [])]),
    h("div", { role: "status" }, live.state),
    live.figures,
    commandsCard(input),
    pathCard(path),
    h("div", { class: "columns curves spaced" }, card("motion", "Feed and override", null, curves.motion.element),
      card("feeding", input.kind === "transfer" ? "Link" : "Link and FIFO", null, curves.feeding.element)),
    h("div", { class: "columns spaced" }, card("axes", "Axes", null, live.axes),
      h("div", { class: "stack" }, card("transfer", "Transfer", null, live.transfer), card("alarms", "Alarms", null, live.alarms))),
    card("ledger", "Ledger", null, live.ledger),
    footer(input, "A software hold is no emergency stop; this page shows and does not guard."),
  ];
}

drawPage(draw);
