// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The texture page: every stylus profile with its curves and the table of its parameters.
import { Chart } from "../parts/chart";
import { card, h, type Child } from "../parts/dom";
import { count, fixed, significant } from "../parts/number";
import { drawPage, footer, masthead } from "../parts/page";
import { figures, table } from "../parts/table";
import type { Parameter, Profile, TextureCurves, TextureInput } from "./texture_input";

const units: Record<string, string> = {
  um: "\u00b5m", mm: "mm", percent: "%", deg: "\u00b0", per_mm: "1/mm", mm3_per_mm2: "mm\u00b3/mm\u00b2", peaks: "peaks",
};
const unitText = (unit: string): string => units[unit] ?? unit;

function charts(curves: TextureCurves): HTMLElement[] {
  const primary = new Chart({
    label: "Primary profile and waviness", x_name: "trace", x_unit: "mm", x_places: 4, x: curves.primary.x_mm,
    y_name: "height", y_unit: "\u00b5m",
    curves: [
      { name: "P", values: curves.primary.height_um, color: "series-soft", width: 1, places: 3 },
      { name: "W", values: curves.primary.waviness_um, color: "beyond", width: 2, places: 3 },
    ],
  });
  const roughness = new Chart({
    label: "Roughness profile", x_name: "trace", x_unit: "mm", x_places: 4, x: curves.roughness.x_mm, y_name: "height", y_unit: "\u00b5m",
    curves: [{ name: "R", values: curves.roughness.height_um, color: "series", width: 1, places: 3 }],
  });
  return [
    h("div", { class: "figure" }, h("h3", {}, "Primary profile P and waviness W"), primary.element),
    h("div", { class: "figure" }, h("h3", {}, "Roughness R"), roughness.element),
  ];
}

function valueOf(parameters: Parameter[], name: string): string {
  return significant(parameters.find((parameter) => parameter.name === name)?.value, 4);
}

function parameterTable(profile: Profile): HTMLElement {
  const { P, R, W } = profile.parameters;
  return table("Parameters of the unfiltered profile P, of roughness R and of waviness W", [
    { name: "", cell: (i) => (P[i] as Parameter).name.slice(1) },
    { name: "P", cell: (i) => significant(P[i]?.value, 4) },
    { name: "R", cell: (i) => significant(R[i]?.value, 4) },
    { name: "W", cell: (i) => significant(W[i]?.value, 4) },
    { name: "unit", words: true, cell: (i) => unitText((P[i] as Parameter).unit) },
    { name: "taken at", words: true, cell: (i) => (P[i]?.condition ?? "").replaceAll("um", "\u00b5m") },
    { name: "source", words: true, cell: (i) => (P[i] as Parameter).source },
  ], P.map((_, i) => i));
}

function profileCards(profile: Profile, index: number): Child[] {
  const { P, R } = profile.parameters;
  const head = figures([
    { name: "Ra", value: valueOf(R, "Ra"), unit: "\u00b5m" }, { name: "Rz", value: valueOf(R, "Rz"), unit: "\u00b5m" },
    { name: "RSm", value: valueOf(R, "RSm"), unit: "mm" }, { name: "Pa", value: valueOf(P, "Pa"), unit: "\u00b5m" },
    { name: "Pt", value: valueOf(P, "Pt"), unit: "\u00b5m" }, { name: "PSm", value: valueOf(P, "PSm"), unit: "mm" },
  ]);
  const notes = [profile.form, ...profile.notes];
  const about = `${count(profile.points)} heights, ${fixed(profile.spacing_mm * 1000, 2)}\u2009\u00b5m apart, over ${fixed(profile.length_mm, 3)}\u2009mm`;
  const out = card(`profile-${index + 1}`, profile.profile_file, h("span", { class: "soft" }, about), head,
    ...(profile.curves ? charts(profile.curves) : []), parameterTable(profile),
    h("ul", { class: "notes" }, ...notes.map((note) => h("li", {}, note))));
  out.classList.add("long");
  return [out];
}

function draw(input: TextureInput): Child[] {
  const title = input.title ?? (input.profiles.length === 1 ? (input.profiles[0] as Profile).profile_file : `${count(input.profiles.length)} profiles`);
  return [
    masthead("Surface texture", title, []),
    ...input.profiles.flatMap(profileCards),
    footer(input, "Between samples a profile is a smooth curve; parameters are integrals, extremes and crossings of it. A dash: the profile does not have it."),
  ];
}

drawPage(draw);
