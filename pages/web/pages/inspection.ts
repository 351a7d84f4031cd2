// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The inspection page: decision first, then where the part is off, how it was found, and what to know of it.
import type { ScaleRange } from "../parts/color_scale";
import { card, choice, h, type Child } from "../parts/dom";
import { DeviationMap, views } from "../parts/deviation_map";
import { binned, histogram } from "../parts/histogram";
import { count, fixed, limitsText, micrometres } from "../parts/number";
import { drawPage, footer, masthead } from "../parts/page";
import { figures } from "../parts/table";
import { verdictBanner, verdictWord } from "../parts/verdict";
import { alignmentCard, comparisonCard, notesCard, worstCard } from "./inspection_cards";
import { limitsOf, type InspectionInput } from "./inspection_input";
import { sectionsCard } from "./inspection_sections";

/** The ends of the colour scale: the limits, or without limits the largest deviation on either side. */
function scaleRange(input: InspectionInput): ScaleRange {
  const limits = limitsOf(input);
  if (limits) return { low_mm: limits[0], high_mm: limits[1], are_limits: true };
  const end = Math.max(Math.abs(input.deviation.min_mm), Math.abs(input.deviation.max_mm), 1e-6);
  return { low_mm: -end, high_mm: end, are_limits: false };
}

/** The report writes reasons as they follow a colon. */
function sentence(text: string): string {
  const whole = text.charAt(0).toUpperCase() + text.slice(1);
  return /[.!?]$/.test(whole) ? whole : `${whole}.`;
}

const fileName = (path: string): string => path.split("/").pop() as string;

function whyText(input: InspectionInput): string {
  const { decision, judged } = input;
  const limits = limitsOf(input);
  const parts = [
    decision?.reason ? sentence(decision.reason) : undefined,
    limits ? `Limits ${limitsText(limits)}, ${judged === "datum" ? "in the fixed datums" : "after best fit"}.` : undefined,
    decision?.rule ? `Rule: ${decision.rule}.` : undefined,
    decision?.uncertainty ? `Standard uncertainty ${micrometres(decision.uncertainty.standard_mm, 2)}\u2009\u00b5m, ${decision.uncertainty.stated ? "stated" : "from the points"}.` : undefined,
  ];
  return parts.filter(Boolean).join(" ");
}

function keyFigures(input: InspectionInput): HTMLElement {
  const d = input.deviation;
  const beyond = input.decision?.points_outside;
  return figures([
    { name: "Points", value: count(input.points) },
    { name: "Lowest", value: micrometres(d.min_mm), unit: "\u00b5m" },
    { name: "Highest", value: micrometres(d.max_mm), unit: "\u00b5m" },
    { name: "Mean", value: micrometres(d.mean_mm, 2), unit: "\u00b5m" },
    { name: "Root mean square", value: micrometres(d.rms_mm, 2), unit: "\u00b5m" },
    { name: "Profile zone t", value: micrometres(d.profile_mm), unit: "\u00b5m" },
    ...(beyond !== undefined ? [{ name: "Beyond limits", value: count(beyond) }] : []),
  ]);
}

function mapCard(input: InspectionInput): Child {
  const data = input.map;
  if (!data || data.x_mm.length === 0) return null;
  const map = new DeviationMap(data, scaleRange(input), data.deviation_mm);
  const look = h("div", { class: "choice", role: "group", "aria-label": "View" }, ...Object.entries(views).map(([name, from]) => {
    const button = h("button", { type: "button" }, name);
    button.addEventListener("click", () => map.look(from));
    return button;
  }));
  const controls = h("div", { class: "controls" }, look, liftControl(map, data.deviation_mm, data.x_mm));
  const { best_fit_deviation_mm: best, datum_deviation_mm: datum } = data;
  if (best && datum) {
    controls.prepend(choice("Evaluation", [{ name: "Best fit", value: best }, { name: "Fixed datums", value: datum }],
      input.judged === "datum" ? datum : best, (deviation) => map.show(deviation)));
  }
  const hint = h("p", { class: "soft hint" }, "Drag to turn, wheel to zoom, right button to move, double click to start over. Ringed points lie beyond a limit.");
  const thinned = data.thinning ? h("p", { class: "soft" }, data.thinning) : null;
  return card("map", "Deviation map", controls, map.element, thinned, hint);
}

/** A slider that moves points along their normals by up to what makes the largest deviation a tenth of the part. */
function liftControl(map: DeviationMap, deviation_mm: number[], x_mm: number[]): Child {
  if (!map.canLift) return null;
  const largest = deviation_mm.reduce((most, value) => Math.max(most, Math.abs(value)), 1e-9);
  const span = x_mm.reduce((most, value) => Math.max(most, value), -Infinity) - x_mm.reduce((least, value) => Math.min(least, value), Infinity);
  const most = Math.pow(10, Math.ceil(Math.log10(Math.max(span * 0.1, largest) / largest)));
  const slider = h("input", { type: "range", min: 0, max: 100, value: 0, "aria-label": "Exaggeration of the deviations" });
  const said = h("output", {}, "off");
  slider.addEventListener("input", () => {
    const factor = Math.round((Number(slider.value) / 100) * most);
    said.textContent = factor === 0 ? "off" : `\u00d7\u2009${count(factor)}`;
    map.lift(factor);
  });
  return h("label", {}, "Exaggerate", slider, said);
}

function binsOf(input: InspectionInput): { edges: number[]; counts: number[] } {
  const given = input.deviation.histogram;
  if (!given) return binned(input.map?.deviation_mm ?? []);
  return { edges: Array.from({ length: given.counts.length + 1 }, (_, i) => given.low_mm + i * given.bin_width_mm), counts: given.counts };
}

function histogramCard(input: InspectionInput): Child {
  const bins = binsOf(input);
  if (bins.counts.length === 0) return null;
  const limits = limitsOf(input);
  const um = (mm: number): number => mm * 1000;
  const spread_um = um(input.deviation.standard_deviation_mm);
  return card("distribution", "Distribution", null,
    histogram({
      edges: bins.edges.map(um), counts: bins.counts, unit: "\u00b5m", x_name: "deviation",
      limits: limits ? [um(limits[0]), um(limits[1])] : undefined, mean: um(input.deviation.mean_mm), deviation: spread_um,
    }),
    h("p", { class: "soft" }, `Line: normal distribution with the same mean and standard deviation, ${fixed(spread_um, 2)}\u2009\u00b5m.`));
}

function draw(input: InspectionInput): Child[] {
  const verdict = input.decision?.verdict ?? "not-asked";
  const title = input.title ?? fileName(input.points_file ?? "Inspection");
  const origin = [
    input.points_file ? `Measured: ${input.points_file}` : "",
    input.nominal_file ? `Nominal: ${input.nominal_file}${input.nominal_flipped ? " (normal turned round)" : ""}` : "",
    input.alignment ? `Fit: ${input.alignment.fit}` : "",
  ];
  const pair = [histogramCard(input), comparisonCard(input)];
  document.body.dataset["verdict"] = verdictWord(verdict);
  const doubts = (input.doubts ?? []).map((doubt) => h("p", { class: "problem", role: "alert" }, sentence(doubt)));
  return [
    masthead("Inspection report", title, origin),
    ...doubts,
    verdictBanner(verdict, whyText(input)),
    keyFigures(input),
    mapCard(input),
    sectionsCard(input),
    h("div", { class: "columns spaced" }, ...pair),
    alignmentCard(input),
    h("div", { class: "columns spaced" }, worstCard(input), notesCard(input)),
    footer(input, "Deviations are signed along the outward normal of the nominal surface: plus is too much material."),
  ];
}

drawPage(draw);
