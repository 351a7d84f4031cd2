// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The loop page: a part before and after its correction, in the fixed datums and best-fitted.
import { Chart } from "../parts/chart";
import { card, choice, h, type Child } from "../parts/dom";
import { count, fixed } from "../parts/number";
import { drawPage, footer, masthead } from "../parts/page";
import { figures, pairs, table } from "../parts/table";
import type { CalibrationParameter, LoopInput, Part, Section } from "./loop_input";

const um = (mm: number, places = 1): string => fixed(mm * 1e3, places);
const inMicrometres = (values: number[]): number[] => values.map((value) => value * 1e3);
const unitOf = (name: string): string => name.slice(name.lastIndexOf("_") + 1);

/** In or out by the limit, said by a word. */
function tag(part: Part, limit_mm: number): HTMLElement {
  const inside = part.max_abs_deviation_mm <= limit_mm;
  return h("span", { class: `tag ${inside ? "accept" : "reject"}` }, inside ? "within" : "out");
}

function parts(input: LoopInput): HTMLElement {
  const rows: { name: string; part: Part }[] = [
    { name: "First part", part: input.before },
    { name: "Second part, nothing done", part: input.uncorrected },
    { name: "Second part, path corrected", part: input.after },
    ...(input.calibrated ? [{ name: "Second part, machine corrected", part: input.calibrated }] : []),
  ];
  return table("Largest deviations in \u00b5m", [
    { name: "part", cell: (row) => h("a", { href: row.part.report }, row.name) },
    { name: "fixed datums", cell: (row) => um(row.part.max_abs_deviation_mm), beyond: (row) => row.part.max_abs_deviation_mm > input.limit_mm },
    { name: "rms, fixed datums", cell: (row) => um(row.part.rms_deviation_mm) },
    { name: "best-fitted", cell: (row) => um(row.part.best_fit_max_abs_deviation_mm) },
    { name: "the part itself", cell: (row) => um(row.part.true_max_abs_deviation_mm) },
    { name: `\u00b1${um(input.limit_mm, 0)} \u00b5m, fixed datums`, words: true, cell: (row) => tag(row.part, input.limit_mm) },
  ], rows);
}

function sectionChart(section: Section, fitted: boolean, limit_mm: number): HTMLElement {
  const { datum, best_fit } = section.curves;
  const chart = new Chart({
    label: `${section.label}, ${fitted ? "best-fitted" : "fixed datums"}`, x_name: "along the section", x_unit: "mm", x_places: 1,
    x: section.curves.arc_length_mm, y_name: "deviation", y_unit: "\u00b5m", limits: [-limit_mm * 1e3, limit_mm * 1e3], height_px: 230,
    curves: fitted ? [
      { name: "first", values: inMicrometres(best_fit.before_mm), color: "beyond", width: 1.5, places: 2 },
      { name: "corrected", values: inMicrometres(best_fit.after_mm), color: "series", width: 2, places: 2 },
    ] : [
      { name: "first", values: inMicrometres(datum.before_mm), color: "beyond", width: 1.5, places: 2 },
      { name: "second, nothing done", values: inMicrometres(datum.uncorrected_mm), color: "series-soft", width: 1, dash: [5, 4], places: 2 },
      { name: "second, corrected", values: inMicrometres(datum.after_mm), color: "series", width: 2, places: 2 },
    ],
  });
  return h("div", {}, h("h3", {}, section.label), chart.element);
}

function sections(input: LoopInput): HTMLElement {
  const place = h("div", { class: "columns spaced" });
  const show = (fitted: boolean): void => place.replaceChildren(...input.sections.map((section) => sectionChart(section, fitted, input.limit_mm)));
  const side = choice("Judged", [{ name: "In the fixed datums", value: false }, { name: "Best-fitted", value: true }], false, show);
  show(false);
  return card("sections", "Sections before and after", side, place);
}

const stateWords = (p: CalibrationParameter): string =>
  p.state === "inseparable" ? (p.with.length > 0 ? `seen only together with ${p.with.join(", ")}` : "not seen") : p.state === "weak" ? "too uncertain to correct"
    : p.significant ? "corrected" : "nothing found";

/** What stands behind a value: angles are small. */
const valueOf = (p: CalibrationParameter, value: number | null): string => (value === null ? "\u2013" : fixed(value, unitOf(p.name) === "deg" ? 5 : 4));

/** Each remedy once, with the errors it is for. */
function remedies(parameters: CalibrationParameter[]): HTMLElement | null {
  const by_remedy = new Map<string, string[]>();
  for (const p of parameters)
    if (p.state !== "identified" && p.remedy) by_remedy.set(p.remedy, [...(by_remedy.get(p.remedy) ?? []), p.name]);
  if (by_remedy.size === 0) return null;
  return h("div", {}, h("h3", {}, "What would tell the rest"), pairs([...by_remedy].map(([remedy, names]): [string, Child] => [names.join(", "), remedy])));
}

function calibration(input: LoopInput): HTMLElement | null {
  if (!input.calibration) return null;
  const truth = new Map(input.hidden.map((one) => [one.name, one.value]));
  return card("calibration", "What the machine has wrong", null,
    h("p", {}, `From ${count(input.calibration.points)} points on an artefact cut with tilts to all sides; ${um(input.calibration.rms_mm, 2)} \u00b5m are left. The tool's length is a presetter's word, the zero of the last rotary axis that of an indicator.`),
    table("Errors found, with 95 % intervals, and the hidden ones", [
      { name: "error", cell: (p) => p.name },
      { name: "found", cell: (p) => valueOf(p, p.value) },
      { name: "\u00b1", cell: (p) => valueOf(p, p.interval_95) },
      { name: "hidden", cell: (p) => valueOf(p, truth.get(p.name) ?? 0) },
      { name: "unit", words: true, cell: (p) => unitOf(p.name) },
      { name: "", words: true, cell: stateWords },
    ], input.calibration.parameters), remedies(input.calibration.parameters));
}

function draw(input: LoopInput): Child[] {
  const { compensation, link } = input;
  return [
    masthead("Closed loop", input.title ?? "Cut, measured, corrected", [input.machine, `seed ${input.seed}`]),
    figures([
      { name: "First part", value: `\u00b1${um(input.before.max_abs_deviation_mm)}`, unit: "\u00b5m" },
      { name: "Nothing done", value: `\u00b1${um(input.uncorrected.max_abs_deviation_mm)}`, unit: "\u00b5m" },
      { name: "Path corrected", value: `\u00b1${um(input.after.max_abs_deviation_mm)}`, unit: "\u00b5m" },
      ...(input.calibrated ? [{ name: "Machine corrected", value: `\u00b1${um(input.calibrated.max_abs_deviation_mm)}`, unit: "\u00b5m" }] : []),
    ]),
    card("parts", "In the fixed datums, and best-fitted", null, parts(input),
      h("p", {}, "A best fit takes the pose away, and with it most of what a wrong machine does: a loop that looks at the fit alone corrects nothing.")),
    sections(input),
    h("div", { class: "columns spaced" },
      card("corrected", "What was corrected", null, pairs([
        ["locations moved", `${count(compensation.moved)} of ${count(compensation.locations)}`],
        ["largest shift", `${um(compensation.max_shift_mm)} \u00b5m`],
        ["waves followed", `longer than ${fixed(compensation.shortest_wave_mm, 1)} mm`],
        ["cut deeper than meant", `${um(compensation.gouge_mm, 2)} \u00b5m at most`],
      ])),
      card("remains", "What remains, and why", null, pairs(input.remains.map((one): [string, Child] => [one.what, `${um(one.mm, 2)} \u00b5m`]))),
      card("link", "On its way", null, pairs([
        ["link", link.address || "handed over"], ["program", `${count(input.blocks)} blocks, ${count(link.bytes)} bytes`],
        ["transfer", `${fixed(link.seconds, 2)} s, ${count(link.chunks)} pieces, ${count(link.chunks_repeated)} repeated`],
        ["read back", link.compared ? "the same, byte for byte" : "no"], ["machine time", `${fixed(input.run_s, 1)} s`],
      ]))),
    calibration(input),
    footer(input, `The machine, its errors and the measuring machine are virtual; programs, link, control and inspection are those of the commands. ${fixed(input.seconds, 1)} s in all.`),
  ];
}

drawPage(draw);
