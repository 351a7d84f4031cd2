// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Curves over one axis (uPlot): series, an optional band between two limits, values read off under the pointer.
import uPlot from "uplot";

import { h } from "./dom";
import { fixed } from "./number";
import { followTheme, token, type Drawing } from "./theme";

export interface Curve {
  name: string;
  values: (number | null)[];
  /** Name of a colour token. */
  color: string;
  width?: number;
  dash?: number[];
  /** Marks instead of a line. */
  marks?: boolean;
  /** Decimals under the pointer. */
  places?: number;
  hidden?: boolean;
  /** On the axis at the right. */
  scale?: "y2";
}

export interface ChartInput {
  label: string;
  x_name: string;
  x_unit: string;
  x: number[];
  x_places: number;
  y_name: string;
  y_unit: string;
  /** A second axis at the right, with fixed ends. */
  y2?: { name: string; unit: string; low: number; high: number };
  curves: Curve[];
  /** Drawn as a band with dashed ends. */
  limits?: readonly [number, number] | undefined;
  height_px?: number;
}

function axis(name: string, unit: string, size: number): uPlot.Axis {
  return {
    label: unit ? `${name}, ${unit}` : name,
    labelSize: 22, labelGap: 2, size, gap: 5, font: "12px system-ui, sans-serif", labelFont: "12px system-ui, sans-serif",
    stroke: token("ink-soft"),
    grid: { stroke: token("line"), width: 1 },
    ticks: { stroke: token("line"), width: 1, size: 5 },
    values: (_plot, splits) => splits.map((value) => String(value).replace("-", "\u2212")),
  };
}

/** The band and its ends lie below the curves. */
function bandHook(limits: readonly [number, number]): (plot: uPlot) => void {
  return (plot) => {
    const { ctx, bbox } = plot;
    const [low, high] = limits.map((limit) => Math.round(plot.valToPos(limit, "y", true))) as [number, number];
    ctx.save();
    ctx.beginPath();
    ctx.rect(bbox.left, bbox.top, bbox.width, bbox.height);
    ctx.clip();
    ctx.fillStyle = token("band");
    ctx.fillRect(bbox.left, high, bbox.width, low - high);
    ctx.strokeStyle = token("limit");
    ctx.lineWidth = devicePixelRatio;
    ctx.setLineDash([5 * devicePixelRatio, 4 * devicePixelRatio]);
    for (const end of [low, high]) {
      ctx.beginPath();
      ctx.moveTo(bbox.left, end);
      ctx.lineTo(bbox.left + bbox.width, end);
      ctx.stroke();
    }
    ctx.restore();
  };
}

/** The range of y: all curves that are shown, the limits, and some air. */
function yRange(input: ChartInput): uPlot.Range.Function {
  return (_plot, min, max) => {
    const low = Math.min(min ?? 0, input.limits ? input.limits[0] : min ?? 0);
    const high = Math.max(max ?? 1, input.limits ? input.limits[1] : max ?? 1);
    const air = (high - low || 1) * 0.08;
    return [low - air, high + air];
  };
}

function series(curve: Curve): uPlot.Series {
  const color = token(curve.color);
  return {
    label: curve.name, stroke: color, scale: curve.scale ?? "y", width: curve.width ?? 1.5, show: !curve.hidden,
    ...(curve.dash ? { dash: curve.dash } : {}),
    ...(curve.marks ? { paths: () => null, points: { show: true, size: 7, fill: color, stroke: color } } : { points: { show: false } }),
    value: (_plot, value) => (value === null || value === undefined ? "\u2013" : fixed(value, curve.places ?? 2)),
  };
}

/** Charts are flatter on paper, so that a page holds four. */
const paperHeight_px = 170;

function options(input: ChartInput, width_px: number, on_paper: boolean): uPlot.Options {
  return {
    width: width_px, height: on_paper ? paperHeight_px : input.height_px ?? 220,
    cursor: { drag: { x: true, y: false }, points: { size: 7 } },
    scales: { x: { time: false }, y: { range: yRange(input) }, ...(input.y2 ? { y2: { range: [input.y2.low, input.y2.high] } } : {}) },
    axes: [axis(input.x_name, input.x_unit, 34), axis(input.y_name, input.y_unit, 46),
      ...(input.y2 ? [{ ...axis(input.y2.name, input.y2.unit, 40), scale: "y2", side: 1 as const, grid: { show: false } }] : [])],
    legend: { live: true },
    series: [
      { label: input.x_name, value: (_plot, value) => (value === null || value === undefined ? "\u2013" : fixed(value, input.x_places)) },
      ...input.curves.map(series),
    ],
    hooks: input.limits ? { drawClear: [bandHook(input.limits)] } : {},
  };
}

/** A chart that fills its parent's width and follows theme and paper. Drag to zoom, double-click to see everything. */
export class Chart implements Drawing {
  readonly element: HTMLElement;
  private plot: uPlot | undefined;

  constructor(private input: ChartInput) {
    this.element = h("div", { class: "chart", role: "img", "aria-label": input.label });
    new ResizeObserver(() => this.fit()).observe(this.element);
    followTheme(this);
  }

  show(input: ChartInput): void {
    this.input = input;
    this.element.setAttribute("aria-label", input.label);
    this.redraw();
  }

  /** More of the same curves: only the numbers change. */
  feed(x: number[], values: (number | null)[][]): void {
    this.input = { ...this.input, x, curves: this.input.curves.map((curve, i) => ({ ...curve, values: values[i] ?? [] })) };
    if (this.plot) this.plot.setData([x, ...values] as uPlot.AlignedData);
    else this.redraw();
  }

  redraw(paper_px?: number): void {
    const width_px = paper_px ?? this.element.clientWidth;
    if (width_px === 0) return;
    this.plot?.destroy();
    const data = [this.input.x, ...this.input.curves.map((curve) => curve.values)] as uPlot.AlignedData;
    this.plot = new uPlot(options(this.input, width_px, paper_px !== undefined), data, this.element);
  }

  private fit(): void {
    const width_px = this.element.clientWidth;
    if (!this.plot) this.redraw();
    else if (width_px > 0 && width_px !== this.plot.width) this.plot.setSize({ width: width_px, height: this.plot.height });
  }
}
