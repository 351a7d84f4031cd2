// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// A histogram with the limits and the normal distribution of the same mean and spread, as SVG: crisp on paper, and in the
// colours of the theme by itself.
import { svg } from "./dom";
import { count, fixed } from "./number";

export interface HistogramInput {
  /** n + 1 edges of n bins. */
  edges: number[];
  counts: number[];
  unit: string;
  x_name: string;
  limits?: readonly [number, number] | undefined;
  mean?: number | undefined;
  deviation?: number | undefined;
}

const width = 560;
const height = 330;
const box = { left: 48, right: width - 12, top: 12, bottom: height - 44 };

/** Round steps of 1, 2, 5 × 10ⁿ, `about` of them over the range. */
export function niceTicks(low: number, high: number, about: number): number[] {
  const raw = (high - low || 1) / about;
  const power = 10 ** Math.floor(Math.log10(raw));
  const step = power * ([1, 2, 5, 10].find((factor) => factor * power >= raw) as number);
  const ticks: number[] = [];
  for (let i = Math.ceil(low / step - 1e-9); i * step <= high + step * 1e-9; ++i) ticks.push(Number((i * step).toPrecision(12)));
  return ticks;
}

/** Bins of equal width over the values: Freedman and Diaconis 1981, width 2·IQR/∛n, at most 60 bins. */
export function binned(values: number[]): { edges: number[]; counts: number[] } {
  if (values.length === 0) return { edges: [], counts: [] };
  const sorted = Float64Array.from(values).sort();
  const n = sorted.length;
  const low = sorted[0] ?? 0;
  const high = sorted[n - 1] ?? 0;
  const spread = (sorted[Math.floor(0.75 * (n - 1))] ?? 0) - (sorted[Math.floor(0.25 * (n - 1))] ?? 0);
  const width_wanted = (2 * spread) / Math.cbrt(Math.max(1, n));
  const bins = high > low ? Math.max(1, Math.min(60, Math.ceil((high - low) / (width_wanted || high - low)))) : 1;
  const size = (high - low) / bins || 1;
  const counts = new Array<number>(bins).fill(0);
  for (const value of sorted) {
    const bin = Math.min(bins - 1, Math.floor((value - low) / size));
    counts[bin] = (counts[bin] as number) + 1;
  }
  return { edges: Array.from({ length: bins + 1 }, (_, i) => low + i * size), counts };
}

class Frame {
  constructor(private readonly low: number, private readonly high: number, readonly top: number) {}
  x(value: number): number {
    return box.left + ((value - this.low) / (this.high - this.low)) * (box.right - box.left);
  }
  y(value: number): number {
    return box.bottom - (value / this.top) * (box.bottom - box.top);
  }
  ticksX(): number[] {
    return niceTicks(this.low, this.high, 7);
  }
}

/** How high the normal distribution of all the values stands over its mean, in values per bin. */
function peakOf(input: HistogramInput): number {
  if (input.mean === undefined || !input.deviation || input.edges.length < 2) return 0;
  const total = input.counts.reduce((sum, value) => sum + value, 0);
  const bin = (input.edges[1] as number) - (input.edges[0] as number);
  return (total * bin) / (input.deviation * Math.sqrt(2 * Math.PI));
}

function frameOf(input: HistogramInput): Frame {
  const ends = [input.edges[0] as number, input.edges[input.edges.length - 1] as number, ...(input.limits ?? [])];
  const low = Math.min(...ends);
  const high = Math.max(...ends);
  const air = (high - low || 1) * 0.05;
  // Room for the bell as well, but not so much that the bars become flat.
  const highest = Math.max(...input.counts, 1);
  return new Frame(low - air, high + air, Math.max(highest, Math.min(peakOf(input), 2 * highest)) * 1.06);
}

function bell(input: HistogramInput, frame: Frame): SVGElement | null {
  const { mean, deviation } = input;
  const peak = peakOf(input);
  if (mean === undefined || !deviation || peak === 0) return null;
  const points: string[] = [];
  for (let i = 0; i <= 120; ++i) {
    const z = -4 + (8 * i) / 120;
    const x = frame.x(mean + z * deviation);
    if (x < box.left || x > box.right) continue;
    points.push(`${x.toFixed(1)},${Math.max(box.top, frame.y(peak * Math.exp(-0.5 * z * z))).toFixed(1)}`);
  }
  return svg("polyline", { class: "bell", points: points.join(" ") });
}

export function histogram(input: HistogramInput): SVGSVGElement {
  const frame = frameOf(input);
  const out = svg("svg", { class: "histogram", viewBox: `0 0 ${width} ${height}`, role: "img",
    "aria-label": `Histogram of ${input.x_name} in ${input.unit}, ${input.counts.length} bins` });
  if (input.limits) {
    const [low, high] = input.limits;
    out.append(svg("rect", { class: "band", x: frame.x(low), y: box.top, width: frame.x(high) - frame.x(low), height: box.bottom - box.top }));
  }
  for (const tick of niceTicks(0, frame.top, 4)) {
    if (!Number.isInteger(tick)) continue;
    out.append(svg("line", { class: "rule", x1: box.left, x2: box.right, y1: frame.y(tick), y2: frame.y(tick) }));
    out.append(svg("text", { x: box.left - 7, y: frame.y(tick), "text-anchor": "end", "dominant-baseline": "central" }, count(tick)));
  }
  input.counts.forEach((value, i) => out.append(...bar(input, frame, value, i)));
  const curve = bell(input, frame);
  if (curve) out.append(curve);
  for (const limit of input.limits ?? []) {
    out.append(svg("line", { class: "limit", x1: frame.x(limit), x2: frame.x(limit), y1: box.top, y2: box.bottom }));
  }
  for (const tick of frame.ticksX()) {
    out.append(svg("text", { x: frame.x(tick), y: box.bottom + 17, "text-anchor": "middle" }, String(tick).replace("-", "\u2212")));
  }
  out.append(svg("text", { x: (box.left + box.right) / 2, y: height - 6, "text-anchor": "middle" }, `${input.x_name}, ${input.unit}`));
  return out;
}

/** A bar, and over it an area to point at that names its range and count. */
function bar(input: HistogramInput, frame: Frame, value: number, index: number): SVGElement[] {
  const from = input.edges[index] as number;
  const to = input.edges[index + 1] as number;
  const middle = (from + to) / 2;
  const out = input.limits !== undefined && (middle < input.limits[0] || middle > input.limits[1]);
  const x = frame.x(from) + 0.5;
  const bar_width = Math.max(1, frame.x(to) - frame.x(from) - 1);
  return [
    svg("rect", { class: out ? "bar out" : "bar", x, y: frame.y(value), width: bar_width, height: box.bottom - frame.y(value) }),
    svg("rect", { class: "hit", x, y: box.top, width: bar_width, height: box.bottom - box.top },
      svg("title", {}, `${fixed(from, 2)} \u2026 ${fixed(to, 2)} ${input.unit}: ${count(value)}`)),
  ];
}
