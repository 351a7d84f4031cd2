// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The document of the inspection page: report.json of `cusp inspect` (docs/json.md), and with it what a report leaves
// out: the points of the map and the curves of the sections. Only `points` and `deviation` must be there; what else is
// absent is not shown. Lengths in mm, angles in rad; lists of a group run in parallel; points count from 0.
import type { Stamp } from "../parts/page";
import type { PointData } from "../parts/point_cloud";
import type { Verdict } from "../parts/verdict";

export interface Statistics {
  count: number;
  min_mm: number;
  max_mm: number;
  mean_mm: number;
  rms_mm: number;
  standard_deviation_mm: number;
  /** ISO 1101: the total width of a zone about the nominal. */
  profile_mm: number;
}

export interface Decision {
  verdict: Verdict;
  reason: string;
  rule?: string;
  lower_limit_mm?: number;
  upper_limit_mm?: number;
  uncertainty?: { standard_mm: number; stated: boolean; source: string };
  least_conforming_probability?: number;
  points_outside?: number;
}

export interface Evaluation extends Statistics {
  beyond_edge?: number;
  outliers?: number;
  histogram?: { low_mm: number; bin_width_mm: number; counts: number[] };
  decision?: Decision;
}

/** Scallops found over the form of a section, against the plan. */
export interface Scallops {
  count: number;
  planned_count?: number | null;
  mean_spacing_mm?: number | null;
  planned_step_over_mm?: number | null;
  mean_height_mm?: number | null;
  max_height_mm?: number | null;
}

/** One entry a point, in the order of the section. */
export interface SectionCurve {
  arc_length_mm: number[];
  deviation_mm: number[];
  /** The smooth form under the deviations, and how its order was chosen. */
  form_mm?: number[];
  form?: string;
}

export interface Section {
  label: string;
  length_mm: number;
  beyond_edge?: number;
  deviation: Statistics;
  curve?: SectionCurve;
  /** Against the planned step-over; `null` when the points are too coarse for it, `scallops_note` says why. */
  scallops?: Scallops | null;
  scallops_note?: string;
}

export interface Alignment {
  fit: string;
  rotation_vector_rad: [number, number, number];
  translation_mm: [number, number, number];
  termination?: string;
  iterations?: number;
  coarse_iterations?: number;
  points?: number;
  beyond_edge?: number;
  start_rms_mm?: number;
  rms_mm?: number;
  minimax_mm?: number;
  condition?: number;
  /** "tx" … "rz". */
  locked?: string[];
  weakly_determined?: string[];
  /** "tx_mm" … "rz_rad". */
  standard_deviation?: Record<string, number>;
}

export interface WorstPoint {
  point: number;
  x_mm: number;
  y_mm: number;
  z_mm: number;
  deviation_mm: number;
}

/** Fewer points than were measured when a cloud was thinned for the page; `thinning` says how. */
export interface MapData extends PointData {
  datum_deviation_mm?: number[];
  best_fit_deviation_mm?: number[];
  thinning?: string;
}

export interface InspectionInput extends Stamp {
  points_file?: string;
  nominal_file?: string;
  nominal_flipped?: boolean;
  points: number;
  measured?: { format?: string; kind?: string; kind_source?: string; probe_radius_mm?: number; mm_per_unit?: number; unit_stated?: boolean };
  alignment?: Alignment;
  judged?: "datum" | "best-fit";
  deviation: Evaluation;
  datum_deviation?: Evaluation;
  best_fit_deviation?: Evaluation;
  outlier_rule?: { factor: number; floor_mm: number };
  sections?: Section[];
  decision?: Decision;
  /** What speaks against trusting the figures, a sentence each. */
  doubts?: string[];
  map?: MapData;
  worst?: WorstPoint[];
  notes?: string[];
  diagnostics?: { items: { severity: string; code: string; message: string }[] };
}

/** The limits the decision was taken with, if there were any. */
export function limitsOf(input: InspectionInput): readonly [number, number] | undefined {
  const { lower_limit_mm, upper_limit_mm } = input.decision ?? {};
  return lower_limit_mm === undefined || upper_limit_mm === undefined ? undefined : [lower_limit_mm, upper_limit_mm];
}
