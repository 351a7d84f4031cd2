// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The document of the tilt page: report.json of `cusp tilt` (docs/json.md) with the curves of every run.
import type { Stamp } from "../parts/page";

export interface Contact {
  speed_min_m_per_min: number;
  speed_mean_m_per_min: number;
  speed_max_m_per_min: number;
  force_proxy_mean: number;
  force_proxy_max: number;
}

export interface Proof {
  collision_volume_mm3: number;
  depth_mm: number;
  collisions: number;
}

export interface Posted {
  pass: boolean;
  not_posted: string | null;
  verify_pass: boolean | null;
  points?: number;
  matched?: number;
  simulated: Proof | null;
}

export interface Fitness {
  range_excess: number | null;
  collision_volume_mm3: number | null;
  harmony_s: number | null;
}

export interface Run {
  seed: number;
  tilt_points_mm: number[][];
  generations_to_collision_free: number | null;
  evaluations: number;
  fitness: Fitness;
}

/** By generation: 1 is free of collision, 0 out of the machine's range. */
export interface RunCurves {
  seed: number;
  best: number[];
  mean: number[];
  worst: number[];
}

export interface TiltInput extends Stamp {
  name: string;
  machine: string;
  cutter_locations: number;
  path_length_mm: number;
  collision_free: boolean;
  tilt_points_mm: number[][];
  generations_to_collision_free: number | null;
  fitness: Fitness;
  rotary_travel_deg: number[];
  rewinds: number;
  machining_time_s: number | null;
  shortest_stick_out_mm: number | null;
  stick_out_mm: number;
  center_error_max_mm: number;
  proof_resolution_mm: number;
  start: { proof: Proof; contact: Contact };
  tilted: { proof: Proof; contact: Contact };
  runs: Run[];
  posted?: Posted;
  curves: RunCurves[];
}
