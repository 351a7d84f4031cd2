// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The quieter parts of the inspection page: fixed datums beside best fit, alignment and solve, worst points, notes.
import { card, h, type Child } from "../parts/dom";
import { count, fixed, micrometres, percent, significant } from "../parts/number";
import { pairs, table, type Column } from "../parts/table";
import { verdictTag } from "../parts/verdict";
import { limitsOf, type Alignment, type Evaluation, type InspectionInput } from "./inspection_input";

/** Fixed datums and best fit answer different questions; side by side nobody takes one for the other. */
export function comparisonCard(input: InspectionInput): Child {
  const { best_fit_deviation: best, datum_deviation: datum } = input;
  if (!best || !datum || input.alignment?.fit === "none") return null;
  const row = (name: string, cell: (e: Evaluation) => Child): { name: string; cells: Child[] } => ({ name, cells: [cell(best), cell(datum)] });
  const rows = [
    row("lowest, \u00b5m", (e) => micrometres(e.min_mm, 2)), row("highest, \u00b5m", (e) => micrometres(e.max_mm, 2)),
    row("mean, \u00b5m", (e) => micrometres(e.mean_mm, 2)), row("root mean square, \u00b5m", (e) => micrometres(e.rms_mm, 2)),
    row("standard deviation, \u00b5m", (e) => micrometres(e.standard_deviation_mm, 2)),
    row("profile zone t, \u00b5m", (e) => micrometres(e.profile_mm, 2)),
    row("beyond limits", (e) => count(e.decision?.points_outside)), row("outliers", (e) => count(e.outliers)),
    row("P(conforming)", (e) => percent(e.decision?.least_conforming_probability)),
    row("decision", (e) => (e.decision ? verdictTag(e.decision.verdict) : "\u2013")),
  ];
  const judged = input.judged === "datum" ? "fixed datums" : "best fit";
  return card("comparison", "Best fit and fixed datums", null,
    table(`Best fit shows the form, fixed datums form and place together. Judged: ${judged}.`, [
      { name: "", cell: (r) => r.name },
      { name: "best fit", cell: (r) => r.cells[0] },
      { name: "fixed datums", cell: (r) => r.cells[1] },
    ], rows));
}

interface Freedom {
  key: string;
  name: string;
  unit: string;
  value: number;
}

function freedomsOf(alignment: Alignment): Freedom[] {
  const axes = ["x", "y", "z"];
  const [t, r] = [alignment.translation_mm, alignment.rotation_vector_rad];
  return [
    ...axes.map((axis, i) => ({ key: `t${axis}`, name: `along ${axis}`, unit: "mm", value: t[i] as number })),
    ...axes.map((axis, i) => ({ key: `r${axis}`, name: `about ${axis}`, unit: "rad", value: r[i] as number })),
  ];
}

/** Lengths to 10 nm, angles to 0.01 µrad. */
const poseText = (f: Freedom): string => `${fixed(f.value, f.unit === "mm" ? 5 : 8)} ${f.unit}`;

function poseTable(alignment: Alignment): HTMLElement {
  const columns: Column<Freedom>[] = [{ name: "freedom", cell: (f) => f.name }, { name: "value", cell: poseText }];
  const spread = alignment.standard_deviation;
  if (spread && alignment.fit !== "none") {
    const state = (f: Freedom): string =>
      alignment.locked?.includes(f.key) ? "locked" : alignment.weakly_determined?.includes(f.key) ? "weakly" : "well";
    const error = (f: Freedom): Child => {
      if (state(f) === "locked") return "\u2013";
      const value = spread[`${f.key}_${f.unit}`];
      return value === undefined ? "\u2013" : f.unit === "mm" ? `${significant(value * 1000)} \u00b5m` : `${significant(value * 1e6)} \u00b5rad`;
    };
    columns.push({ name: "standard deviation", cell: error }, { name: "determined", words: true, cell: state });
  }
  return table("Pose of the measured frame in the nominal frame", columns, freedomsOf(alignment));
}

function solveEntries(alignment: Alignment): [string, Child][] {
  const um = (mm: number | undefined): string => `${micrometres(mm, 4)} \u00b5m`;
  const entries: [string, Child | undefined][] = [
    ["fit", alignment.fit], ["ended", alignment.termination], ["iterations", alignment.iterations?.toString()],
    ["iterations with a sample before", alignment.coarse_iterations?.toString()],
    ["points that took part", alignment.points === undefined ? undefined : count(alignment.points)],
    ["points beyond an edge, left out", alignment.beyond_edge === undefined ? undefined : count(alignment.beyond_edge)],
    ["rms at the start", alignment.start_rms_mm === undefined ? undefined : um(alignment.start_rms_mm)],
    ["rms", alignment.rms_mm === undefined ? undefined : um(alignment.rms_mm)],
    ["largest residual", alignment.minimax_mm === undefined ? undefined : um(alignment.minimax_mm)],
    ["condition", alignment.condition === undefined ? undefined : significant(alignment.condition)],
  ];
  return entries.filter((entry): entry is [string, Child] => entry[1] !== undefined);
}

export function alignmentCard(input: InspectionInput): Child {
  const alignment = input.alignment;
  if (!alignment) return null;
  return card("alignment", "Alignment", null, h("div", { class: "columns" }, poseTable(alignment),
    h("div", {}, h("h3", {}, "Solve"), pairs(solveEntries(alignment)))));
}

export function worstCard(input: InspectionInput): Child {
  const worst = input.worst ?? [];
  if (worst.length === 0) return null;
  const limits = limitsOf(input);
  return card("worst", "Largest deviations", null, table("Points count from 1 in the order they were measured", [
    { name: "point", cell: (p) => count(p.point + 1) },
    { name: "x, mm", cell: (p) => fixed(p.x_mm, 3) }, { name: "y, mm", cell: (p) => fixed(p.y_mm, 3) }, { name: "z, mm", cell: (p) => fixed(p.z_mm, 3) },
    { name: "\u00b5m", cell: (p) => micrometres(p.deviation_mm, 2), beyond: (p) => Boolean(limits && (p.deviation_mm < limits[0] || p.deviation_mm > limits[1])) },
  ], worst));
}

function measuredNotes(input: InspectionInput): string[] {
  const { measured, outlier_rule: rule, deviation, decision } = input;
  const notes: string[] = [];
  if (measured?.kind) {
    const ball = measured.kind === "centre" ? `centres of a ball of radius ${fixed(measured.probe_radius_mm, 4)} mm` : "points of the surface";
    notes.push(`The points are ${ball}${measured.kind_source ? ` (${measured.kind_source})` : ""}.`);
  }
  if (measured?.unit_stated === false) notes.push("The file states no unit of length; millimetres were assumed.");
  if (decision?.uncertainty) notes.push(`Standard uncertainty ${micrometres(decision.uncertainty.standard_mm, 3)} \u00b5m: ${decision.uncertainty.source}`);
  if (deviation.beyond_edge) notes.push(`${count(deviation.beyond_edge)} points lie beyond an edge of the nominal and do not count.`);
  if (rule && deviation.outliers !== undefined) {
    notes.push(`Outliers: ${count(deviation.outliers)}, farther from the median than ${fixed(rule.factor, 1)} \u00d7 1.4826 \u00d7 MAD and than ${micrometres(rule.floor_mm, 2)} \u00b5m.`);
  }
  return notes;
}

export function notesCard(input: InspectionInput): Child {
  const said = (input.diagnostics?.items ?? []).map((item) => `${item.severity}: ${item.message} [${item.code}]`);
  const notes = [...measuredNotes(input), ...(input.notes ?? []), ...said];
  if (notes.length === 0) return null;
  return card("notes", "What to know", null, h("ul", { class: "notes" }, ...notes.map((note) => h("li", {}, note))));
}
