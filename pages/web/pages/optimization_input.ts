// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The document of the optimization page: summary.json of `cusp optimize` (docs/json.md) with curves, map and path.
import type { Stamp } from "../parts/page";

export interface Before {
  name: string;
  tool: string;
  passes: number;
  cc_points: number;
  machining_time_s: number | null;
  overcut_max_mm: number;
  undercut_max_mm: number;
  within_tolerance_percent: number;
}

/** By generation. */
export interface Convergence {
  evaluations: number[];
  viral_evaluations: number[];
  best: (number | null)[];
  mean: (number | null)[];
  worst: (number | null)[];
  diversity: number[];
}

export interface Individual {
  values: number[];
  objective: number | null;
}

/** Every candidate judged, in order, and the population at the end; `values` runs in parallel with `names`. */
export interface Candidates {
  names: string[];
  lower: number[];
  upper: number[];
  objectives: (number | null)[];
  population: Individual[];
}

export interface FrontPoint {
  tool: string;
  passes: number;
  machining_time_s: number;
  deviation_mm: number;
  on_front: boolean;
}

export interface DeviationPoints {
  x_mm: number[];
  y_mm: number[];
  z_mm: number[];
  normal_x: number[];
  normal_y: number[];
  normal_z: number[];
  deviation_mm: number[];
  before_deviation_mm?: number[];
}

export interface OptimizationInput extends Stamp {
  name: string;
  mode: "paper" | "true";
  planner: string;
  best: { tool: string };
  objective: number;
  cc_points: number;
  passes: number;
  mean_chord_error_mm: number;
  overcut_max_mm: number;
  undercut_max_mm: number;
  within_tolerance_percent: number;
  reached_percent: number;
  tolerance_mm: number;
  grid_mm: number;
  machining_time_s: number | null;
  evaluations: number;
  viral_evaluations: number;
  seed: number;
  tools: string[];
  before: Before | null;
  convergence: Convergence;
  candidates: Candidates;
  front: FrontPoint[];
  map: DeviationPoints;
  /** Contacts on the surface: x, y, z of each, and the pass it belongs to. */
  path: { position_mm: number[]; pass: number[] };
}
