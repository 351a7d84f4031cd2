// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The document of the loop page: the summary of `cusp demo` (docs/json.md), and with it the curves of the sections.
import type { Stamp } from "../parts/page";

/** A part in both judgements. */
export interface Part {
  max_abs_deviation_mm: number;
  rms_deviation_mm: number;
  best_fit_max_abs_deviation_mm: number;
  true_max_abs_deviation_mm: number;
  report: string;
}

export interface Section {
  label: string;
  before_mm: number;
  uncorrected_mm: number;
  after_mm: number;
  before_best_fit_mm: number;
  after_best_fit_mm: number;
  curves: {
    arc_length_mm: number[];
    datum: { before_mm: number[]; uncorrected_mm: number[]; after_mm: number[] };
    best_fit: { before_mm: number[]; after_mm: number[] };
  };
}

export interface CalibrationParameter {
  name: string;
  meaning: string;
  state: "identified" | "weak" | "inseparable";
  value: number | null;
  interval_95: number | null;
  significant: boolean;
  with: string[];
  remedy: string | null;
}

export interface LoopInput extends Stamp {
  machine: string;
  seed: number;
  limit_mm: number;
  before: Part;
  uncorrected: Part;
  after: Part;
  calibrated: Part | null;
  sections: Section[];
  hidden: { name: string; value: number }[];
  compensation: { moved: number; locations: number; max_shift_mm: number; gouge_mm: number; shortest_wave_mm: number };
  remains: { what: string; mm: number }[];
  calibration: { parameters: CalibrationParameter[]; points: number; rms_mm: number; noise_mm: number } | null;
  link: { address: string; bytes: number; seconds: number; chunks: number; chunks_repeated: number; compared: boolean };
  blocks: number;
  run_s: number;
  seconds: number;
}
