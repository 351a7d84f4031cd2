// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The decision, said by a word, a sign and a colour, so that none of them is needed.
import { h, svg } from "./dom";

export type Verdict = "accept" | "reject" | "undecided" | "not-asked";

const words: Record<Verdict, string> = {
  accept: "Conforms", reject: "Does not conform", undecided: "Undecided", "not-asked": "No decision",
};
const signs: Record<Verdict, string> = {
  accept: "M5 12.5l4.5 4.5L19 7.5", reject: "M6 6l12 12M18 6L6 18",
  undecided: "M8.5 9a3.5 3.5 0 1 1 5 3.2c-1 .5-1.5 1-1.5 2.3M12 18.2v.1", "not-asked": "M6 12h12",
};

export function isVerdict(text: unknown): text is Verdict {
  return typeof text === "string" && text in words;
}

export const verdictWord = (verdict: Verdict): string => words[verdict];

/** The sign in its circle, drawn in the circle's ground. */
export function verdictSign(verdict: Verdict): SVGElement {
  return svg("svg", { viewBox: "0 0 24 24", fill: "none", "stroke-width": 2.6, "stroke-linecap": "round", "stroke-linejoin": "round", "aria-hidden": "true" },
    svg("path", { d: signs[verdict] }));
}

export function verdictBanner(verdict: Verdict, why: string): HTMLElement {
  return h("section", { class: `verdict ${verdict}`, "aria-label": "Decision" },
    h("div", { class: "sign" }, verdictSign(verdict)), h("div", { class: "word" }, words[verdict]), h("div", { class: "why" }, why));
}

export function verdictTag(verdict: Verdict): HTMLElement {
  return h("span", { class: `tag ${verdict}` }, words[verdict]);
}
