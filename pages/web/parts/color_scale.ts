// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// From a deviation to a colour, against the tolerance: neutral at zero, full blue and full orange at the limits. Beyond a
// limit the colour stays and the point gets a ring and a larger size, so that the verdict does not hang on hue.
import { svg } from "./dom";
import { fixed } from "./number";
import { token } from "./theme";

export type Rgb = [number, number, number];

export interface ScaleRange {
  low_mm: number;
  high_mm: number;
  /** The ends are the limits; without limits they only end the scale. */
  are_limits: boolean;
}

function parseColor(text: string): Rgb {
  const value = Number.parseInt(text.replace("#", ""), 16);
  return [(value >> 16) & 255, (value >> 8) & 255, value & 255];
}

const stopNames = ["scale-low", "scale-low-mid", "scale-zero", "scale-high-mid", "scale-high"];

export class ColorScale {
  private readonly stops: Rgb[];

  constructor(readonly range: ScaleRange) {
    this.stops = stopNames.map((name) => parseColor(token(name)));
  }

  /** −1 at the lower limit, 0 at zero, 1 at the upper limit; a limit on the far side of zero does not turn the scale. */
  private position(deviation_mm: number): number {
    const end = deviation_mm < 0 ? Math.max(-this.range.low_mm, 1e-12) : Math.max(this.range.high_mm, 1e-12);
    return Math.max(-1, Math.min(1, deviation_mm / end));
  }

  isBeyond(deviation_mm: number): boolean {
    return this.range.are_limits && (deviation_mm < this.range.low_mm || deviation_mm > this.range.high_mm);
  }

  color(deviation_mm: number): Rgb {
    const place = (this.position(deviation_mm) + 1) * 2;
    const index = Math.min(3, Math.floor(place));
    const from = this.stops[index] as Rgb;
    const to = this.stops[index + 1] as Rgb;
    const share = place - index;
    return [0, 1, 2].map((i) => (from[i] as number) + ((to[i] as number) - (from[i] as number)) * share) as Rgb;
  }
}

/** Half the larger limit, rounded to one of 1, 2, 5: where the legend has its inner ticks. */
function tickStep(range_um: number): number {
  const power = 10 ** Math.floor(Math.log10(range_um / 4));
  return [1, 2, 5, 10].map((factor) => factor * power).find((step) => range_um / step <= 6) as number;
}

/** The legend: a bar from the lower to the upper end with ticks in µm, and what a ring means. */
export function legend(scale: ColorScale, beyond: number): SVGSVGElement {
  const { low_mm, high_mm, are_limits } = scale.range;
  const left = -24; // room for a count of six digits
  const right = 108;
  const top = 26;
  const bottom = 204;
  const y = (mm: number): number => bottom + ((mm - low_mm) / (high_mm - low_mm)) * (top - bottom);
  const label = `Colour scale from ${fixed(low_mm * 1000, 1)} to ${fixed(high_mm * 1000, 1)} micrometres`;
  const out = svg("svg", { class: "legend", viewBox: `${left} 0 ${right - left} 250`, preserveAspectRatio: "xMaxYMin meet", role: "img", "aria-label": label });
  const bands = 60;
  for (let i = 0; i < bands; ++i) {
    const mm = low_mm + ((i + 0.5) / bands) * (high_mm - low_mm);
    const y_top = y(low_mm + ((i + 1) / bands) * (high_mm - low_mm));
    const fill = `rgb(${scale.color(mm).map(Math.round).join(" ")})`;
    out.append(svg("rect", { x: 84, y: y_top, width: 16, height: (bottom - top) / bands + 0.5, style: `fill:${fill};stroke:none` }));
  }
  out.append(svg("rect", { x: 84, y: top, width: 16, height: bottom - top, fill: "none" }));
  out.append(svg("text", { x: 100, y: 10, "text-anchor": "end", class: "unit" }, are_limits ? "limits, \u00b5m" : "\u00b5m"));
  const step_um = tickStep((high_mm - low_mm) * 1000);
  const ticks = new Set([low_mm * 1000, high_mm * 1000]);
  for (let um = Math.ceil((low_mm * 1000) / step_um) * step_um; um <= high_mm * 1000; um += step_um) {
    if ([low_mm, high_mm].every((end) => Math.abs(end * 1000 - um) > step_um * 0.45)) ticks.add(um);
  }
  for (const um of ticks) {
    const sign = um > 1e-9 ? "+" : "";
    const places = Math.abs(um - Math.round(um)) < 1e-6 ? 0 : 1;
    out.append(svg("line", { class: "tick", x1: 79, x2: 84, y1: y(um / 1000), y2: y(um / 1000) }));
    out.append(svg("text", { x: 75, y: y(um / 1000), "text-anchor": "end" }, sign + fixed(um, places)));
  }
  if (are_limits) {
    const fill = `rgb(${scale.color(high_mm).map(Math.round).join(" ")})`;
    out.append(svg("circle", { class: "ring", cx: 92, cy: 228, r: 5.5, style: `fill:${fill}` }));
    out.append(svg("text", { x: 80, y: 228, "text-anchor": "end" }, `beyond: ${fixed(beyond, 0)}`));
  }
  return out;
}
