// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The tilt page: whether the tilted path is free, what it costs, and how the search went (Weinert & Stautner 2004, Figs. 4 and 5).
import { Chart, type Curve } from "../parts/chart";
import { card, h, type Child } from "../parts/dom";
import { count, fixed } from "../parts/number";
import { drawPage, footer, masthead } from "../parts/page";
import { figures, table } from "../parts/table";
import type { Posted, Run, RunCurves, TiltInput } from "./tilt_input";

const point = (at: number[]): string => `X${fixed(at[0], 2)} Y${fixed(at[1], 2)} Z${fixed(at[2], 2)}`;

/** Over the runs that came as far as a generation: mean and standard deviation. */
function overRuns(runs: number[][]): { mean: number[]; spread: number[] } {
  const length = Math.max(...runs.map((run) => run.length));
  const mean: number[] = [];
  const spread: number[] = [];
  for (let g = 0; g < length; ++g) {
    const values = runs.filter((run) => g < run.length).map((run) => run[g] as number);
    const middle = values.reduce((sum, v) => sum + v, 0) / values.length;
    mean.push(middle);
    spread.push(Math.sqrt(values.reduce((sum, v) => sum + (v - middle) ** 2, 0) / Math.max(1, values.length - 1)));
  }
  return { mean, spread };
}

function convergence(curves: RunCurves[]): Chart {
  const best = overRuns(curves.map((run) => run.best));
  const mean = overRuns(curves.map((run) => run.mean));
  const worst = overRuns(curves.map((run) => run.worst));
  const drawn: Curve[] = [
    { name: "best", values: best.mean, color: "series", places: 4 },
    { name: "mean", values: mean.mean, color: "ink", dash: [7, 4], width: 1.5, places: 4 },
    { name: "worst", values: worst.mean, color: "ink-soft", dash: [2, 3], width: 1.5, places: 4 },
  ];
  if (curves.length > 1)
    drawn.push({ name: "spread of best", values: best.spread, color: "ink-soft", width: 1, hidden: true, places: 4 },
      { name: "spread of mean", values: mean.spread, color: "ink-soft", width: 1, hidden: true, places: 4 });
  return new Chart({
    label: "Fitness by generation", x_name: "generation", x_unit: "", x_places: 0, x: best.mean.map((_, i) => i),
    y_name: "fitness, 1 is free of collision", y_unit: "", height_px: 300, curves: drawn,
  });
}

/** What became of the path on the control: posted, read back, and the moves of the program simulated. */
function program(posted: Posted | undefined): Child[] {
  if (posted === undefined) return [];
  const { points, matched, simulated } = posted;
  if (points === undefined || matched === undefined || simulated === null)
    return [h("p", { class: "soft", id: "program" }, posted.not_posted === null ? "No program was posted: the path is not free of collision." : `No program: ${posted.not_posted}`)];
  const found = `${count(matched)} of ${count(points)} cutter locations met; its own moves, simulated, go through ${fixed(simulated.collision_volume_mm3, 3)} mm\u00b3 of the part`;
  return [h("p", { class: "soft", id: "program" }, `Posted program ${posted.pass ? "proven" : "NOT proven"}: read back ${posted.verify_pass ? "without a finding" : "with findings"}, ${found}.`)];
}

function draw(input: TiltInput): Child[] {
  const { start, tilted } = input;
  const word = h("span", { class: `tag ${input.collision_free ? "accept" : "reject"}` }, input.collision_free ? "free of collision" : "not free of collision");
  const volume = (v: number): string => `${fixed(v, 3)} mm\u00b3`;
  const speed = (v: number): string => `${fixed(v, 1)} m/min`;
  const rows: [string, string, string][] = [
    ["collision volume", volume(start.proof.collision_volume_mm3), volume(tilted.proof.collision_volume_mm3)],
    ["deepest collision", `${fixed(start.proof.depth_mm, 3)} mm`, `${fixed(tilted.proof.depth_mm, 3)} mm`],
    ["contact speed, mean", speed(start.contact.speed_mean_m_per_min), speed(tilted.contact.speed_mean_m_per_min)],
    ["contact speed, least", speed(start.contact.speed_min_m_per_min), speed(tilted.contact.speed_min_m_per_min)],
    ["force proxy, mean", fixed(start.contact.force_proxy_mean, 3), fixed(tilted.contact.force_proxy_mean, 3)],
  ];
  const comparison = table("Upright and tilted", [
    { name: "", cell: (row: [string, string, string]) => row[0] },
    { name: "upright", cell: (row) => row[1] }, { name: "tilted", cell: (row) => row[2] },
  ], rows);
  const runs = table("Every run", [
    { name: "seed", cell: (run: Run) => String(run.seed) },
    { name: "tilt points", words: true, cell: (run) => run.tilt_points_mm.map(point).join("; ") },
    { name: "free from generation", cell: (run) => (run.generations_to_collision_free === null ? "never" : count(run.generations_to_collision_free)) },
    { name: "evaluations", cell: (run) => count(run.evaluations) },
    { name: "harmony, s", cell: (run) => fixed(run.fitness.harmony_s, 2) },
  ], input.runs);
  return [
    masthead("Tilted path", input.name, [`${input.machine}`, `${count(input.cutter_locations)} cutter locations`]),
    figures([
      { name: "Machining time", value: fixed(input.machining_time_s, 1), unit: "s" },
      { name: "Rotary travel", value: input.rotary_travel_deg.map((v) => `${fixed(v, 0)}\u00b0`).join(" + ") },
      { name: "Tilt points", value: count(input.tilt_points_mm.length) },
      { name: "Shortest stick-out", value: fixed(input.shortest_stick_out_mm, 1), unit: `mm of ${fixed(input.stick_out_mm, 1)}` },
      { name: "Free from generation", value: input.generations_to_collision_free === null ? "\u2013" : count(input.generations_to_collision_free) },
    ]),
    card("comparison", input.tilt_points_mm.map(point).join("; "), word, comparison, ...program(input.posted)),
    ...(input.runs.length > 0 ? [
      card("convergence", input.curves.length === 1 ? "The search" : `The search, mean of ${count(input.curves.length)} runs`, null, convergence(input.curves).element),
      card("runs", "Runs", null, runs),
    ] : []),
    footer(input, `Collisions by simulation of all motion at ${input.proof_resolution_mm} mm. Fitness: 1 is free of collision, 0 out of the machine\u2019s range, between them 1 less the share of the largest volume of the first generation. The force proxy is the force relative to a contact on the ball\u2019s equator (Kienzle, exponent 0.25).`),
  ];
}

drawPage(draw);
