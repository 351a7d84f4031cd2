// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The document of the texture page: the summary of `cusp texture` (docs/json.md), and with it the curves.
import type { Stamp } from "../parts/page";

export interface Parameter {
  /** With its letter: "Pa". */
  name: string;
  value: number | null;
  unit: string;
  condition?: string;
  source: string;
}

export interface TextureCurves {
  primary: { x_mm: number[]; height_um: number[]; waviness_um: (number | null)[] };
  roughness: { x_mm: number[]; height_um: number[] };
}

export interface Profile {
  profile_file: string;
  points: number;
  spacing_mm: number;
  length_mm: number;
  tip_radius_mm: number | null;
  cutoff_mm: number;
  form: string;
  notes: string[];
  /** The same parameters in the same order for each band. */
  parameters: { P: Parameter[]; R: Parameter[]; W: Parameter[] };
  curves?: TextureCurves;
}

export interface TextureInput extends Stamp {
  profiles: Profile[];
}
