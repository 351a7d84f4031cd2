// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// What every page starts with: its document, its masthead, and a visible word when it cannot be drawn.
import { h, type Child } from "./dom";

/** What every document of cusp begins with. */
export interface Stamp {
  command?: string;
  version?: string;
  title?: string;
}

export function masthead(kind: string, title: string, origin: string[]): HTMLElement {
  document.title = `${title} \u2013 ${kind.toLowerCase()}`;
  return h("header", { class: "masthead" }, h("div", { class: "kind" }, kind), h("h1", {}, title),
    ...origin.filter(Boolean).map((text) => h("span", { class: "origin" }, text)));
}

export const footer = (stamp: Stamp, text: string): HTMLElement =>
  h("footer", {}, `${text} Made by cusp${stamp.version ? ` ${stamp.version}` : ""}.`);

/** Reads the document and draws it; a page that fails says so on itself, not only in the console. */
export function drawPage<Input extends Stamp>(draw: (input: Input) => Child[]): void {
  const place = document.getElementById("page") as HTMLElement;
  try {
    const input = JSON.parse(document.getElementById("data")?.textContent ?? "") as Input;
    for (const child of draw(input)) if (child) place.append(child);
  } catch (error) {
    place.append(h("p", { class: "problem", role: "alert" }, `This page cannot be drawn: ${String(error)}`));
    throw error;
  }
}
