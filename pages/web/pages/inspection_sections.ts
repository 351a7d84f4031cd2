// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Profile sections as in Fountas 2017, fig. 11: deviation against the number of the measurement or against arc length.
import { Chart, type ChartInput } from "../parts/chart";
import { card, choice, h, type Child } from "../parts/dom";
import { count, fixed, micrometres } from "../parts/number";
import { table, type Column } from "../parts/table";
import { limitsOf, type InspectionInput, type Section, type SectionCurve } from "./inspection_input";

type Abscissa = "number" | "arc";

const um = (mm: number): number => mm * 1000;

type DrawnSection = Section & { curve: SectionCurve };

function chartInput({ label, curve }: DrawnSection, limits_mm: readonly [number, number] | undefined, abscissa: Abscissa): ChartInput {
  const deviation_um = curve.deviation_mm.map(um);
  const isBeyond = (mm: number): boolean => limits_mm !== undefined && (mm < limits_mm[0] || mm > limits_mm[1]);
  const beyond = curve.deviation_mm.map((mm) => (isBeyond(mm) ? um(mm) : null));
  return {
    label: `Deviation along section ${label}`,
    x_name: abscissa === "arc" ? "arc length" : "measurement", x_unit: abscissa === "arc" ? "mm" : "", x_places: abscissa === "arc" ? 3 : 0,
    x: abscissa === "arc" ? curve.arc_length_mm : curve.deviation_mm.map((_, i) => i + 1),
    y_name: "deviation", y_unit: "\u00b5m",
    limits: limits_mm ? [um(limits_mm[0]), um(limits_mm[1])] : undefined,
    curves: [
      { name: "deviation", values: deviation_um, color: "series" },
      ...(curve.form_mm ? [{ name: "form", values: curve.form_mm.map(um), color: "ink", dash: [7, 4] }] : []),
      ...(beyond.some((value) => value !== null) ? [{ name: "beyond", values: beyond, color: "beyond", marks: true }] : []),
    ],
  };
}

function sectionTable(sections: Section[]): HTMLElement {
  const columns: Column<Section>[] = [
    { name: "section", cell: (s) => s.label },
    { name: "points", cell: (s) => count(s.deviation.count) },
    { name: "lowest, \u00b5m", cell: (s) => micrometres(s.deviation.min_mm, 2) },
    { name: "highest, \u00b5m", cell: (s) => micrometres(s.deviation.max_mm, 2) },
    { name: "mean, \u00b5m", cell: (s) => micrometres(s.deviation.mean_mm, 2) },
    { name: "rms, \u00b5m", cell: (s) => micrometres(s.deviation.rms_mm, 2) },
    { name: "zone t, \u00b5m", cell: (s) => micrometres(s.deviation.profile_mm, 2) },
    { name: "length, mm", cell: (s) => fixed(s.length_mm, 3) },
  ];
  return table("Sections", columns, sections);
}

function scallopTable(sections: Section[]): Child {
  const found = sections.filter((s) => s.scallops);
  if (found.length === 0) return null;
  return table("Scallops against the plan; heights over the form of the section", [
    { name: "section", cell: (s) => s.label },
    { name: "found", cell: (s) => count(s.scallops?.count) },
    { name: "planned", cell: (s) => count(s.scallops?.planned_count) },
    { name: "spacing, mm", cell: (s) => fixed(s.scallops?.mean_spacing_mm, 3) },
    { name: "planned step-over, mm", cell: (s) => fixed(s.scallops?.planned_step_over_mm, 3) },
    { name: "mean height, \u00b5m", cell: (s) => micrometres(s.scallops?.mean_height_mm, 2) },
    { name: "largest, \u00b5m", cell: (s) => micrometres(s.scallops?.max_height_mm, 2) },
  ], found);
}

export function sectionsCard(input: InspectionInput): Child {
  const sections = input.sections ?? [];
  if (sections.length === 0) return null;
  const drawn = sections.filter((section): section is DrawnSection => section.curve !== undefined);
  const limits = limitsOf(input);
  const charts = drawn.map((section) => new Chart(chartInput(section, limits, "number")));
  const options: { name: string; value: Abscissa }[] = [{ name: "Measurement number", value: "number" }, { name: "Arc length", value: "arc" }];
  const side = drawn.length === 0 ? null : choice("Abscissa", options, "number", (abscissa) =>
    drawn.forEach((section, i) => charts[i]?.show(chartInput(section, limits, abscissa))));
  const plots = drawn.map((section, i) => h("div", { class: "figure" }, h("h3", {}, section.label),
    section.curve.form ? h("p", { class: "soft" }, section.curve.form) : null, charts[i]?.element));
  const hint = drawn.length === 0 ? null : h("p", { class: "soft hint" }, "Point at a curve to read it off, drag to look closer, double click to see all of it.");
  const coarse = sections.find((s) => s.scallops_note);
  const note = coarse ? h("p", { class: "soft" }, `No scallops: ${coarse.scallops_note}.`) : null;
  const out = card("sections", "Profile sections", side, h("div", { class: "columns curves" }, ...plots), hint, sectionTable(sections), scallopTable(sections), note);
  out.classList.add("long");
  return out;
}
