// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The document of the capability page: the summary of `cusp capability` (docs/json.md).
import type { Stamp } from "../parts/page";

/** Keys with a unit end in `_mm`, or in `_rad` for an angle. */
export interface CharacteristicJson {
  name: string;
  kind: string;
  feature: string | null;
  count: number;
  cp: number | null;
  cpk: number | null;
  pp: number | null;
  ppk: number | null;
  beyond_limits: number;
  trend_probability: number | null;
  out_of_control: number[];
  parts: number[];
  [key: string]: unknown;
}

export interface CapabilityInput extends Stamp {
  files: { file: string; qif_version: string; parts: number; measurements: number; without_value: number }[];
  parts: string[];
  characteristics: CharacteristicJson[];
}

/** A characteristic with its quantities by plain names; angles in degrees. */
export interface Characteristic {
  json: CharacteristicJson;
  title: string;
  unit: string;
  values: number[];
  mean: number;
  overall?: number | undefined;
  within?: number | undefined;
  lower?: number | undefined;
  upper?: number | undefined;
  target?: number | undefined;
  slope?: number | undefined;
}

export function characteristicOf(json: CharacteristicJson): Characteristic {
  const is_angle = "values_rad" in json;
  const suffix = is_angle ? "_rad" : "_mm";
  const scale = is_angle ? 180 / Math.PI : 1;
  const quantity = (key: string): number | undefined => {
    const value = json[key];
    return typeof value === "number" ? value * scale : undefined;
  };
  return {
    json, unit: is_angle ? "\u00b0" : "mm",
    title: json.feature ? `${json.name} of ${json.feature}` : json.name,
    values: (json[`values${suffix}`] as number[]).map((value) => value * scale),
    mean: quantity(`mean${suffix}`) ?? NaN,
    overall: quantity(`overall_deviation${suffix}`), within: quantity(`within_deviation${suffix}`),
    lower: quantity(`lower${suffix}`), upper: quantity(`upper${suffix}`), target: quantity(`target${suffix}`),
    slope: quantity(`slope${suffix}_per_part`),
  };
}
