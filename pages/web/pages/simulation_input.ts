// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The document of the simulation page: the summary of `cusp simulate` with meshes, path and tools.
import type { Stamp } from "../parts/page";

/** Base64 of little-endian numbers: coordinates as 32-bit floats, corners as 32-bit indices. */
export interface PackedMesh {
  vertices_mm: string;
  triangles: string;
}

export interface CollisionItem {
  with: string;
  part: string;
  move: number;
  cl_line?: number;
  program_line?: number;
  position_mm: [number, number, number];
  depth_mm: number;
  volume_mm3: number;
  file?: string;
}

/** Parallel lists, one entry a location shown: where the move numbered `move` ends. */
export interface PathData {
  tip_mm: number[];
  axis: number[];
  move: number[];
  tool: number[];
  rapid: number[];
  line: number[];
  /** Every so many moves are shown. */
  every: number;
}

export interface ToolShape {
  name: string;
  bodies: { part: string; profile_mm: [number, number][] }[];
}

export interface SimulationInput extends Stamp {
  file: string;
  nominal: string | null;
  program: boolean;
  moves: number;
  resolution_mm: number;
  mesh_mm: number;
  seconds: number;
  removed_volume_mm3: number;
  tolerance_mm: number;
  overcut_max_mm: number | null;
  undercut_max_mm: number | null;
  within_tolerance_percent: number | null;
  collision_volume_mm3: number;
  collision_count: number;
  collisions: CollisionItem[];
  machine: string | null;
  machine_range_violations: number | null;
  machine_range: { move: number; cl_line?: number; program_line?: number; reason: string }[];
  before: PackedMesh;
  after: PackedMesh;
  /** At the vertices of `after`, 32-bit floats; not a number where there is none. */
  deviation_mm?: string;
  path: PathData;
  tool_shapes: ToolShape[];
}
