// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Numbers as people in a measuring room write them: a true minus, thin spaces between thousands, one number of places.

const minus = "\u2212";
const thin = "\u2009";
const absent = "\u2013";

/** With `places` decimals; a dash for what is not there. */
export function fixed(value: number | null | undefined, places: number): string {
  if (value === null || value === undefined || !Number.isFinite(value)) return absent;
  const text = Math.abs(value).toFixed(places);
  const [whole, rest] = text.split(".") as [string, string?];
  const grouped = whole.length > 4 ? whole.replace(/\B(?=(\d{3})+$)/g, thin) : whole;
  const sign = value < 0 && Number(text) !== 0 ? minus : "";
  return sign + grouped + (rest ? `.${rest}` : "");
}

export const count = (value: number | null | undefined): string => fixed(value, 0);

/** Millimetres shown as micrometres, as deviations are read. */
export const micrometres = (mm: number | null | undefined, places = 1): string =>
  fixed(mm === null || mm === undefined ? mm : mm * 1000, places);

/** Three significant digits, plain or in powers of ten. */
export function significant(value: number | null | undefined, digits = 3): string {
  if (value === null || value === undefined || !Number.isFinite(value)) return absent;
  if (value === 0) return "0";
  const exponent = Math.floor(Math.log10(Math.abs(value)));
  if (exponent >= -4 && exponent < 6) return fixed(value, Math.max(0, digits - 1 - exponent));
  const [mantissa, power] = value.toExponential(digits - 1).split("e") as [string, string];
  const raised = [...String(Number(power))].map((c) => (c === "-" ? "\u207b" : "\u2070\u00b9\u00b2\u00b3\u2074\u2075\u2076\u2077\u2078\u2079"[Number(c)])).join("");
  return `${mantissa.replace("-", minus)}\u2009\u00d7\u200910${raised}`;
}

export const percent = (share: number | null | undefined, places = 1): string =>
  share === null || share === undefined ? absent : `${fixed(share * 100, places)}${thin}%`;

/** "−10 … +10" for a pair of limits in mm, in micrometres. */
export function limitsText(limits: readonly [number, number]): string {
  const part = (mm: number): string => (mm > 0 ? "+" : "") + fixed(mm * 1000, Number.isInteger(Math.round(mm * 1e6) / 1000) ? 0 : 1);
  return `${part(limits[0])} \u2026 ${part(limits[1])}${thin}\u00b5m`;
}
