// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The capability page: every characteristic over all parts, the least capable first.
import { Chart } from "../parts/chart";
import { card, choice, h, svg, type Child } from "../parts/dom";
import { binned, histogram } from "../parts/histogram";
import { count, fixed, percent, significant } from "../parts/number";
import { drawPage, footer, masthead } from "../parts/page";
import { figures, pairs, table } from "../parts/table";
import { characteristicOf, type CapabilityInput, type Characteristic } from "./capability_input";

/** ISO 22514-2 leaves the bar to the contract; these are the usual ones, and the words say so. */
const usualBar = 1.33;
const leastBar = 1;
const trendBar = 0.01;

type Level = "good" | "fair" | "poor" | "unknown";

function levelOf(c: Characteristic): Level {
  if (c.json.beyond_limits > 0) return "poor";
  const ppk = c.json.ppk;
  if (ppk === null) return "unknown";
  return ppk >= usualBar ? "good" : ppk >= leastBar ? "fair" : "poor";
}

const levelWords: Record<Level, string> = { good: `Ppk \u2265 ${usualBar}`, fair: `Ppk below ${usualBar}`, poor: "not capable", unknown: "no index" };
const levelClasses: Record<Level, string> = { good: "accept", fair: "undecided", poor: "reject", unknown: "not-asked" };

const tag = (level: Level): HTMLElement => h("span", { class: `tag ${levelClasses[level]}` }, levelWords[level]);
const hasTrend = (c: Characteristic): boolean => c.json.trend_probability !== null && c.json.trend_probability < trendBar;

/** The values in the order of the parts, small, between their limits. */
function sparkline(c: Characteristic): SVGElement {
  const [width, height] = [88, 26];
  const low = Math.min(...c.values);
  const span = Math.max(...c.values) - low || 1;
  const points = c.values.map((value, i) =>
    `${(2 + (i * (width - 4)) / Math.max(1, c.values.length - 1)).toFixed(1)},${(height - 3 - ((value - low) / span) * (height - 6)).toFixed(1)}`);
  return svg("svg", { width, height, role: "img", "aria-label": `${c.title} over ${c.values.length} parts` },
    svg("polyline", { points: points.join(" "), fill: "none", style: "stroke:var(--series);stroke-width:1.5" }));
}

function overview(all: Characteristic[], show: (c: Characteristic) => void): HTMLElement {
  const link = (c: Characteristic): Child => {
    const button = h("a", { href: `#${idOf(c)}` }, c.title);
    button.addEventListener("click", () => show(c));
    return button;
  };
  return table("Least capable first", [
    { name: "characteristic", cell: link },
    { name: "n", cell: (c) => count(c.json.count) },
    { name: "mean", cell: (c) => `${fixed(c.mean, 4)} ${c.unit}` },
    { name: "Cp", cell: (c) => fixed(c.json.cp, 2) }, { name: "Cpk", cell: (c) => fixed(c.json.cpk, 2) },
    { name: "Pp", cell: (c) => fixed(c.json.pp, 2) }, { name: "Ppk", cell: (c) => fixed(c.json.ppk, 2) },
    { name: "beyond", cell: (c) => count(c.json.beyond_limits), beyond: (c) => c.json.beyond_limits > 0 },
    { name: "over parts", words: true, cell: sparkline },
    { name: "trend", words: true, cell: (c) => (hasTrend(c) ? `${(c.slope ?? 0) > 0 ? "rising" : "falling"}` : "\u2013") },
    { name: "", words: true, cell: (c) => tag(levelOf(c)) },
  ], all);
}

let serial = 0;
const ids = new Map<Characteristic, string>();
function idOf(c: Characteristic): string {
  const known = ids.get(c);
  if (known) return known;
  const made = `characteristic-${++serial}`;
  ids.set(c, made);
  return made;
}

function detail(c: Characteristic, parts: string[]): HTMLElement {
  const ends = [c.lower, c.upper].filter((limit): limit is number => limit !== undefined);
  const both = c.lower !== undefined && c.upper !== undefined ? ([c.lower, c.upper] as const) : undefined;
  const outside = c.values.map((value) => ((c.lower !== undefined && value < c.lower) || (c.upper !== undefined && value > c.upper) ? value : null));
  const flat = (value: number): number[] => c.values.map(() => value);
  const run = new Chart({
    label: `${c.title} from part to part`, x_name: "value", x_unit: "", x_places: 0, x: c.values.map((_, i) => i + 1),
    y_name: c.json.kind.toLowerCase(), y_unit: c.unit, limits: both, height_px: 250,
    curves: [
      { name: "measured", values: c.values, color: "series", places: 4 },
      { name: "mean", values: flat(c.mean), color: "ink-soft", dash: [7, 4], width: 1, places: 4 },
      ...(both ? [] : ends.map((limit) => ({ name: "limit", values: flat(limit), color: "limit", dash: [5, 4], width: 1, places: 4 }))),
      ...(outside.some((value) => value !== null) ? [{ name: "beyond", values: outside, color: "beyond", marks: true, places: 4 }] : []),
    ],
  });
  const quantity = (value: number | undefined): string => (value === undefined ? "\u2013" : `${significant(value, 6)} ${c.unit}`);
  const spread = pairs([
    ["target", quantity(c.target)], ["limits", `${quantity(c.lower)} to ${quantity(c.upper)}`],
    ["standard deviation, all values", quantity(c.overall)], ["standard deviation, part to part", quantity(c.within)],
    ["slope per part", quantity(c.slope)], ["probability of such an order without trend", percent(c.json.trend_probability, 2)],
    ["beyond 3 \u03c3 from part to part", c.json.out_of_control.length === 0 ? "none" : c.json.out_of_control.map((i) => parts[i] ?? String(i + 1)).join(", ")],
  ]);
  const bins = binned(c.values);
  const indices = figures([
    { name: "Cp", value: fixed(c.json.cp, 2) }, { name: "Cpk", value: fixed(c.json.cpk, 2) },
    { name: "Pp", value: fixed(c.json.pp, 2) }, { name: "Ppk", value: fixed(c.json.ppk, 2) },
  ]);
  return card(idOf(c), c.title, tag(levelOf(c)), indices, h("div", { class: "columns spaced" },
    run.element,
    histogram({ edges: bins.edges, counts: bins.counts, unit: c.unit, x_name: c.json.kind.toLowerCase(), limits: both, mean: c.mean, deviation: c.overall })),
    spread);
}

function draw(input: CapabilityInput): Child[] {
  const rank = (c: Characteristic): number => c.json.ppk ?? (c.json.beyond_limits > 0 ? -1 : Infinity);
  const all = input.characteristics.map(characteristicOf).sort((a, b) => rank(a) - rank(b));
  const place = h("div", {});
  const first = all[0];
  const show = (c: Characteristic): void => place.replaceChildren(detail(c, input.parts));
  const showAll = (): void => place.replaceChildren(...all.map((c) => detail(c, input.parts)));
  const side = choice("Details", [{ name: "One at a time", value: false }, { name: "All", value: true }], false, (everything) => {
    if (everything) showAll();
    else if (first) show(first);
  });
  if (first) show(first);
  const files = input.files.map((file) => file.file.split("/").pop() as string);
  const poor = all.filter((c) => levelOf(c) === "poor").length;
  return [
    masthead("Capability", input.title ?? (files.length === 1 ? (files[0] as string) : `${count(files.length)} files`), []),
    figures([
      { name: "Parts", value: count(input.parts.length) }, { name: "Characteristics", value: count(all.length) },
      { name: "Not capable", value: count(poor) }, { name: "With a trend", value: count(all.filter(hasTrend).length) },
      { name: "Values", value: count(all.reduce((sum, c) => sum + c.json.count, 0)) },
    ]),
    card("overview", "Characteristics", side, overview(all, show)),
    place,
    footer(input, "C from the moving range of neighbours, P from all values (ISO 22514-2). A trend: an order that has less than 1 % probability without one (Mann and Kendall)."),
  ];
}

drawPage(draw);
