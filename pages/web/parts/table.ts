// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Tables that scroll sideways on a narrow screen, and lists of named values.
import { h, type Child } from "./dom";

export interface Column<Row> {
  name: string;
  cell: (row: Row) => Child;
  /** Text rather than a number. */
  words?: boolean;
  /** Marks the cell as beyond its limit. */
  beyond?: (row: Row) => boolean;
}

/** The first column heads its row. */
export function table<Row>(caption: string, columns: Column<Row>[], rows: Row[]): HTMLElement {
  const head = h("tr", {}, ...columns.map((column) => h("th", { scope: "col", class: column.words ? "words" : undefined }, column.name)));
  const body = rows.map((row) => h("tr", {}, ...columns.map((column, i) => {
    if (i === 0) return h("th", { scope: "row" }, column.cell(row));
    const classes = [column.words ? "words" : "", column.beyond?.(row) ? "beyond" : ""].filter(Boolean).join(" ");
    return h("td", { class: classes || undefined }, column.cell(row));
  })));
  return h("div", { class: "scroll", tabindex: "0", role: "region", "aria-label": caption },
    h("table", {}, h("caption", {}, caption), h("thead", {}, head), h("tbody", {}, ...body)));
}

export function pairs(entries: [string, Child][]): HTMLElement {
  return h("dl", { class: "pairs" }, ...entries.flatMap(([name, value]) => [h("dt", {}, name), h("dd", {}, value)]));
}

/** The row of large figures: what is read first. */
export function figures(entries: { name: string; value: string; unit?: string }[]): HTMLElement {
  return h("dl", { class: "figures" }, ...entries.map(({ name, value, unit }) =>
    h("div", {}, h("dt", {}, name), h("dd", {}, value, unit ? h("small", {}, `\u2009${unit}`) : null))));
}
