// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Light, dark and paper: what draws on a canvas asks here for its colours, and is told when they change.

export interface Drawing {
  /** Draws again with the present tokens; `paper_px` is the width on paper, while printing. */
  redraw(paper_px?: number): void;
}

const drawings = new Set<Drawing>();
/** A4 less its margins, at the 96 px per inch of CSS, less the padding of a card. */
const paperWidth_px = 640;

export function token(name: string): string {
  return getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
}

export function followTheme(drawing: Drawing): void {
  drawings.add(drawing);
}

function redrawAll(paper_px?: number): void {
  for (const drawing of drawings) drawing.redraw(paper_px);
}

matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => redrawAll());
addEventListener("beforeprint", () => {
  document.documentElement.dataset["paper"] = "";
  redrawAll(paperWidth_px);
});
addEventListener("afterprint", () => {
  delete document.documentElement.dataset["paper"];
  redrawAll();
});
