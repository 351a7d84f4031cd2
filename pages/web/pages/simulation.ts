// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The simulation page: the verdict, the stock before and after with the tool on its path, and the list of collisions.
import { card, choice, h, type Child } from "../parts/dom";
import { views } from "../parts/deviation_map";
import { count, fixed, micrometres } from "../parts/number";
import { drawPage, footer, masthead } from "../parts/page";
import { SolidView, type MeshData, type Shown } from "../parts/solid_view";
import { figures, table } from "../parts/table";
import { verdictBanner, type Verdict } from "../parts/verdict";
import type { CollisionItem, PackedMesh, SimulationInput } from "./simulation_input";

const fileName = (path: string): string => path.split("/").pop() as string;
const lineOf = (item: { cl_line?: number; program_line?: number }): number => item.cl_line ?? item.program_line ?? 0;

function decision(input: SimulationInput): [Verdict, string] {
  const why: string[] = [];
  const rapid = input.collisions.filter((item) => item.with === "rapid").length;
  if (input.collision_count > 0) {
    const where = rapid > 0 ? `, ${count(rapid)} of them rapid moves through material` : "";
    why.push(`${count(input.collision_count)} ${input.collision_count === 1 ? "collision" : "collisions"}${where}; ${fixed(input.collision_volume_mm3, 1)}\u2009mm\u00b3 in all.`);
  }
  if (input.machine_range_violations) why.push(`${count(input.machine_range_violations)} moves out of the range of ${input.machine}.`);
  const off = Math.max(input.overcut_max_mm ?? 0, input.undercut_max_mm ?? 0) > input.tolerance_mm;
  if (off) why.push(`The surface is off by more than ${micrometres(input.tolerance_mm, 0)}\u2009\u00b5m.`);
  if (why.length > 0) return ["reject", why.join(" ")];
  const against = input.nominal ? `, and all of the cut surface within ${micrometres(input.tolerance_mm, 0)}\u2009\u00b5m` : "";
  return input.nominal ? ["accept", `No collision${against}.`] : ["not-asked", "No collision; nothing to measure against was given."];
}

function keyFigures(input: SimulationInput): HTMLElement {
  const measured = input.nominal === null ? [] : [
    { name: "Deepest overcut", value: micrometres(input.overcut_max_mm), unit: "\u00b5m" },
    { name: "Most material left", value: micrometres(input.undercut_max_mm), unit: "\u00b5m" },
    { name: "Within tolerance", value: fixed(input.within_tolerance_percent, 2), unit: "%" },
  ];
  return figures([
    { name: "Moves", value: count(input.moves) },
    { name: "Removed", value: fixed(input.removed_volume_mm3, 0), unit: "mm\u00b3" },
    ...measured,
    { name: "Collisions", value: count(input.collision_count) },
  ]);
}

/** A slider over the path, and a button that lets the tool run along it. */
class Player {
  readonly element: HTMLElement;
  private readonly slider: HTMLInputElement;
  private readonly button: HTMLButtonElement;
  private readonly said = h("output", { class: "soft" });
  private timer = 0;

  constructor(private readonly input: SimulationInput, private readonly view: SolidView) {
    const last = Math.max(0, input.path.move.length - 1);
    this.slider = h("input", { type: "range", min: 0, max: last, value: 0, "aria-label": "Place on the path" });
    this.button = h("button", { type: "button", "aria-pressed": "false" }, "Run");
    this.slider.addEventListener("input", () => this.go(Number(this.slider.value)));
    this.button.addEventListener("click", () => (this.timer ? this.stop() : this.run()));
    this.element = h("div", { class: "player" }, h("div", { class: "choice" }, this.button), this.slider, this.said);
    this.go(0);
  }

  /** To the move, or the shown one nearest before it. */
  goToMove(move: number): void {
    this.stop();
    const behind = this.input.path.move.findIndex((shown) => shown > move);
    const index = behind < 0 ? this.input.path.move.length - 1 : Math.max(0, behind - 1);
    this.slider.value = String(index);
    this.go(index);
  }

  private go(index: number): void {
    const { path, moves, program } = this.input;
    this.view.place(index);
    const kind = path.rapid[index] ? "rapid" : "feed";
    this.said.textContent = `move ${count((path.move[index] ?? 0) + 1)} of ${count(moves)}, ${program ? "program" : "CL"} line ${count(path.line[index])}, ${kind}`;
  }

  private run(): void {
    const last = Number(this.slider.max);
    const step = Math.max(1, Math.round(last / 1200));
    if (Number(this.slider.value) >= last) this.slider.value = "0";
    this.button.textContent = "Stop";
    this.button.setAttribute("aria-pressed", "true");
    const next = (): void => {
      const index = Math.min(last, Number(this.slider.value) + step);
      this.slider.value = String(index);
      this.go(index);
      if (index >= last) this.stop();
      else this.timer = requestAnimationFrame(next);
    };
    this.timer = requestAnimationFrame(next);
  }

  private stop(): void {
    cancelAnimationFrame(this.timer);
    this.timer = 0;
    this.button.textContent = "Run";
    this.button.setAttribute("aria-pressed", "false");
  }
}

function viewCard(input: SimulationInput, view: SolidView, player: Player): HTMLElement {
  const options: { name: string; value: Shown }[] = [{ name: "Before", value: "before" }, { name: "After", value: "after" }];
  if (input.deviation_mm) options.push({ name: "Deviation", value: "deviation" });
  const what = choice("Stock", options, input.deviation_mm ? "deviation" : "after", (value) => view.show(value));
  const path = choice("Path", [{ name: "Path off", value: false }, { name: "Path on", value: true }], false, (on) => view.showPath(on));
  const look = h("div", { class: "choice", role: "group", "aria-label": "View" }, ...Object.entries(views).map(([name, from]) => {
    const button = h("button", { type: "button" }, name);
    button.addEventListener("click", () => view.look(from));
    return button;
  }));
  const every = input.path.every > 1 ? ` Every ${count(input.path.every)}th move is shown.` : "";
  const hint = h("p", { class: "soft hint" },
    `Drag to turn, wheel to zoom, right button to move. The stock is drawn ${fixed(input.mesh_mm, 2)}\u2009mm coarse; figures are those of ${fixed(input.resolution_mm, 3)}\u2009mm.${every}`);
  return card("view", "Stock and tool", h("div", { class: "controls" }, what, path, look), view.element, player.element, hint);
}

/** Rows that a person reads; all are marked on the stock. */
const mostRows = 40;

function collisionsCard(input: SimulationInput, player: Player): Child {
  if (input.collisions.length === 0) return null;
  const button = (item: CollisionItem): HTMLElement => {
    const out = h("button", { type: "button" }, "Show");
    out.setAttribute("aria-label", `Show move ${item.move + 1}`);
    out.addEventListener("click", () => player.goToMove(item.move));
    return h("span", { class: "choice" }, out);
  };
  const rows = table("Collisions in the order of the path", [
    { name: "move", cell: (item: CollisionItem) => count(item.move + 1) },
    { name: input.program ? "program line" : "CL line", cell: (item) => count(lineOf(item)) },
    { name: "part", words: true, cell: (item) => item.part },
    { name: "hits", words: true, cell: (item) => (item.with === "rapid" ? "stock, in a rapid move" : item.with) },
    { name: "depth mm", cell: (item) => fixed(item.depth_mm, 3) },
    { name: "volume mm\u00b3", cell: (item) => fixed(item.volume_mm3, 2) },
    { name: "at X Y Z mm", cell: (item) => item.position_mm.map((value) => fixed(value, 2)).join("\u2002") },
    { name: "", cell: button },
  ], input.collisions.slice(0, mostRows));
  const more = input.collision_count > mostRows
    ? h("p", { class: "soft" }, `The first ${count(mostRows)} of ${count(input.collision_count)}; summary.json has them all.`) : null;
  return card("collisions", "Collisions", null, rows, more);
}

function rangeCard(input: SimulationInput): Child {
  if (input.machine_range.length === 0) return null;
  return card("range", `Out of the range of ${input.machine}`, null, table("Moves that end where the machine does not reach", [
    { name: "move", cell: (item) => count(item.move + 1) },
    { name: input.program ? "program line" : "CL line", cell: (item) => count(lineOf(item)) },
    { name: "why", words: true, cell: (item) => item.reason },
  ], input.machine_range));
}

function bytesOf(base64: string): ArrayBuffer {
  return Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0)).buffer;
}

const unpacked = (mesh: PackedMesh): MeshData => ({
  vertices_mm: new Float32Array(bytesOf(mesh.vertices_mm)), triangles: new Uint32Array(bytesOf(mesh.triangles)),
});

function draw(input: SimulationInput): Child[] {
  const view = new SolidView({
    before: unpacked(input.before), after: unpacked(input.after), tolerance_mm: input.tolerance_mm,
    deviation_mm: input.deviation_mm === undefined ? undefined : new Float32Array(bytesOf(input.deviation_mm)),
    path: input.path, tools: input.tool_shapes, collisions: input.collisions,
  });
  const player = new Player(input, view);
  const [verdict, why] = decision(input);
  return [
    masthead("Simulation", fileName(input.file), [input.nominal ? `against ${fileName(input.nominal)}` : ""]),
    verdictBanner(verdict, why),
    keyFigures(input),
    viewCard(input, view, player),
    collisionsCard(input, player),
    rangeCard(input),
    footer(input, "The motion between cutter locations is included: the tip on a line, the axis on the great circle."),
  ];
}

drawPage(draw);
