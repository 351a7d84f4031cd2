// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The optimization page: what was found and what it leaves, beside what it is compared with, and how the search went.
import { Chart } from "../parts/chart";
import { DeviationMap, views } from "../parts/deviation_map";
import { card, choice, h, type Child } from "../parts/dom";
import { count, fixed, micrometres } from "../parts/number";
import { drawPage, footer, masthead } from "../parts/page";
import { figures, table } from "../parts/table";
import type { FrontPoint, Individual, OptimizationInput } from "./optimization_input";

const percent = (value: number): string => `${fixed(value, 2)} %`;
const um = (value: number): string => `${micrometres(value, 1)} \u00b5m`;

function keepsTolerance(input: OptimizationInput): boolean {
  return input.overcut_max_mm <= input.tolerance_mm && input.undercut_max_mm <= input.tolerance_mm && input.reached_percent > 100 - 1e-9;
}

/** Best beside what it is compared with: a path by chance, or the best constant lead. */
function comparison(input: OptimizationInput): Child {
  const { before } = input;
  const seconds = (value: number | null): string => (value === null ? "\u2013" : `${fixed(value, 1)} s`);
  const rows: [string, string, string][] = [
    ["tool", input.best.tool, before?.tool ?? ""],
    ["passes", count(input.passes), count(before?.passes)],
    ["contact points", count(input.cc_points), count(before?.cc_points)],
    ["machining time", seconds(input.machining_time_s), seconds(before?.machining_time_s ?? null)],
    ["overcut", um(input.overcut_max_mm), um(before?.overcut_max_mm ?? 0)],
    ["material left", um(input.undercut_max_mm), um(before?.undercut_max_mm ?? 0)],
    ["within tolerance", percent(input.within_tolerance_percent), percent(before?.within_tolerance_percent ?? 0)],
  ];
  const kept = keepsTolerance(input);
  const word = h("span", { class: `tag ${kept ? "accept" : "reject"}` }, kept ? "within tolerance" : "not within tolerance");
  return card("comparison", "What was found", word, table(`Tolerance \u00b1${fixed(input.tolerance_mm, 3)} mm, exact envelope of the tool`, [
    { name: "", cell: (row: [string, string, string]) => row[0] },
    { name: "found", cell: (row) => row[1] },
    ...(before ? [{ name: before.name, cell: (row: [string, string, string]) => row[2] }] : []),
  ], rows));
}

function mapCard(input: OptimizationInput): Child {
  const { map: data, before } = input;
  if (data.x_mm.length === 0) return null;
  const range = { low_mm: -input.tolerance_mm, high_mm: input.tolerance_mm, are_limits: true };
  const map = new DeviationMap(data, range, data.deviation_mm);
  map.trace(input.path.position_mm, input.path.pass);
  const look = h("div", { class: "choice", role: "group", "aria-label": "View" }, ...Object.entries(views).map(([name, from]) => {
    const button = h("button", { type: "button" }, name);
    button.addEventListener("click", () => map.look(from));
    return button;
  }));
  const controls = h("div", { class: "controls" }, look);
  const other = data.before_deviation_mm;
  if (before && other)
    controls.prepend(choice("Path", [{ name: "Found", value: data.deviation_mm }, { name: before.name, value: other }], data.deviation_mm, (deviation) => {
      map.show(deviation);
      map.showTrace(deviation === data.deviation_mm);
    }));
  return card("map", "Path on the surface, coloured by deviation", controls, map.element,
    h("p", { class: "soft hint" }, "Lines: contacts of the path that was found. Drag to turn, wheel to zoom, double click to start over. Ringed points lie beyond the tolerance."));
}

function convergenceCard(input: OptimizationInput): Child {
  const c = input.convergence;
  const chart = new Chart({
    label: "Objective by number of candidates judged", x_name: "candidates judged", x_unit: "", x_places: 0, x: c.evaluations,
    y_name: "objective", y_unit: "", height_px: 260,
    curves: [
      { name: "best", values: c.best, color: "series", places: 5 },
      { name: "mean of population", values: c.mean, color: "ink", dash: [7, 4], width: 1.5, places: 5 },
      { name: "worst of population", values: c.worst, color: "ink-soft", dash: [2, 3], width: 1.5, places: 5, hidden: true },
    ],
  });
  return card("convergence", "Convergence", null, chart.element,
    h("p", { class: "soft" }, `${count(input.evaluations)} candidates in ${count(c.best.length)} generations, ${count(input.viral_evaluations)} of them first met by an infection.`));
}

function populationCard(input: OptimizationInput): Child {
  const { candidates: c, convergence } = input;
  const bound = Math.max(...convergence.mean.filter((v): v is number => v !== null), 0) * 2;
  const chart = new Chart({
    label: "Every candidate in the order it was judged", x_name: "candidate", x_unit: "", x_places: 0, x: c.objectives.map((_, i) => i + 1),
    y_name: "objective", y_unit: "", height_px: 260,
    curves: [{ name: "candidate", values: c.objectives.map((v) => (v !== null && v <= bound ? v : null)), color: "series", marks: true, places: 5 }],
  });
  const angle = (name: string): boolean => name.endsWith("_rad");
  const cell = (name: string, value: number): string =>
    name === "tool" ? input.tools[Math.round(value)] ?? "" : angle(name) ? fixed((value * 180) / Math.PI, 3) : fixed(value, 4);
  const heading = (name: string): string => (angle(name) ? `${name.slice(0, -4)}, \u00b0` : name.endsWith("_mm") ? `${name.slice(0, -3)}, mm` : name).replaceAll("_", " ");
  const sorted = [...c.population].sort((a, b) => (a.objective ?? Infinity) - (b.objective ?? Infinity));
  const last = table("The last population", [
    { name: "objective", cell: (row: Individual) => (row.objective === null ? "\u2013" : fixed(row.objective, 5)) },
    ...c.names.map((name, i) => ({ name: heading(name), words: name === "tool", cell: (row: Individual) => cell(name, row.values[i] as number) })),
  ], sorted);
  return card("population", "Population", null, chart.element, last);
}

function frontCard(input: OptimizationInput): Child {
  if (input.front.length === 0) return null;
  const sorted = [...input.front].sort((a, b) => a.machining_time_s - b.machining_time_s);
  const values = (on: boolean): (number | null)[] => sorted.map((p) => (p.on_front === on ? p.deviation_mm * 1000 : null));
  const chart = new Chart({
    label: "Deviation against machining time", x_name: "machining time", x_unit: "s", x_places: 1, x: sorted.map((p) => p.machining_time_s),
    y_name: "largest deviation", y_unit: "\u00b5m", height_px: 260, limits: [0, input.tolerance_mm * 1000],
    curves: [
      { name: "on the front", values: values(true), color: "series", marks: true, places: 2 },
      { name: "beaten", values: values(false), color: "ink-soft", marks: true, places: 2 },
    ],
  });
  return card("front", "Time against deviation", null, chart.element, table("Levelled paths, on the grid they were levelled on", [
    { name: "tool", cell: (p: FrontPoint) => p.tool },
    { name: "passes", cell: (p) => count(p.passes) },
    { name: "time, s", cell: (p) => fixed(p.machining_time_s, 1) },
    { name: "deviation, \u00b5m", cell: (p) => micrometres(p.deviation_mm, 2), beyond: (p) => p.deviation_mm > input.tolerance_mm },
    { name: "", words: true, cell: (p) => (p.on_front ? "on the front" : "") },
  ], sorted));
}

function draw(input: OptimizationInput): Child[] {
  const mode = input.mode === "true" ? "least time within the tolerance" : "the paper\u2019s criteria";
  return [
    masthead("Optimised path", input.name || "Finishing path", [mode, input.planner === "outside" ? "planned by an outside CAM" : "", `seed ${input.seed}`]),
    figures([
      { name: "Tool", value: input.best.tool },
      { name: "Machining time", value: input.machining_time_s === null ? "\u2013" : fixed(input.machining_time_s, 1), unit: "s" },
      { name: "Contact points", value: count(input.cc_points) },
      { name: "Mean chord error", value: micrometres(input.mean_chord_error_mm, 2), unit: "\u00b5m" },
      { name: "Within tolerance", value: fixed(input.within_tolerance_percent, 2), unit: "%" },
    ]),
    comparison(input), mapCard(input), frontCard(input), convergenceCard(input), populationCard(input),
    footer(input, `Found paths are judged on a grid of ${fixed(input.grid_mm, 2)} mm; the map and the path beside it on one of 1 mm.`),
  ];
}

drawPage(draw);
