// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The parts of the monitor page that are drawn anew at every answer: state, figures, axes, alarms, transfer, ledger.
import { h, type Child } from "../parts/dom";
import { count, fixed } from "../parts/number";
import { figures, pairs, table } from "../parts/table";
import { verdictSign, type Verdict } from "../parts/verdict";
import type { MonitorInput, Now, Transfer } from "./monitor_input";

interface Said {
  look: Verdict;
  word: string;
  why: string;
}

function controlSaid(now: Now): Said {
  const alarm = now.alarms?.[now.alarms.length - 1];
  const line = now.line ? `line ${count(now.line)}` : "";
  if (alarm) {
    const resume = now.resume_line ? ` Resume at line ${count(now.resume_line)}.` : "";
    return { look: "reject", word: `Alarm ${alarm.number}`, why: `${alarm.line ? `Line ${count(alarm.line)}: ` : ""}${alarm.text}.${resume}` };
  }
  if (now.state === "active") return { look: "accept", word: "Running", why: [now.program, line, now.rapid ? "rapid" : ""].filter(Boolean).join(", ") };
  if (now.state === "interrupted") return { look: "undecided", word: "Interrupted", why: [now.waiting_for, now.program, line].filter(Boolean).join(", ") };
  if (now.finished) return { look: "not-asked", word: "Finished", why: `${now.program ?? ""} has run to its end.` };
  return { look: "not-asked", word: "Reset", why: now.program ? `${now.program} is chosen.` : "No program is chosen." };
}

const transferWords: Record<string, Said> = {
  delivered: { look: "accept", word: "Delivered", why: "The control has the program, bit for bit." },
  refused: { look: "reject", word: "Refused", why: "" },
  aborted: { look: "reject", word: "Aborted", why: "" },
};

function transferSaid(transfer: Transfer): Said {
  const end = transferWords[transfer.state];
  if (end) return { ...end, why: transfer.message ? `${transfer.message}.` : end.why };
  return { look: "undecided", word: transfer.state.charAt(0).toUpperCase() + transfer.state.slice(1), why: transfer.control_state ? `The control: ${transfer.control_state}.` : "" };
}

/** What is going on, in a word; `lost` when the server has not answered lately. */
export function banner(input: MonitorInput, now: Now | null, lost: boolean): HTMLElement {
  let said: Said = { look: "not-asked", word: "Waiting", why: "Nothing has been told yet." };
  if (now) said = input.kind === "transfer" && now.transfer ? transferSaid(now.transfer) : controlSaid(now);
  if (lost && !now?.over) said = { look: "undecided", word: "No connection", why: "What stands here is what was told last." };
  return h("section", { class: `verdict ${said.look}`, "aria-label": "State" },
    h("div", { class: "sign" }, verdictSign(said.look)), h("div", { class: "word" }, said.word), h("div", { class: "why" }, said.why));
}

export function keyFigures(now: Now): HTMLElement {
  const entries: { name: string; value: string; unit?: string }[] = [];
  if (now.line !== undefined) entries.push({ name: "Line", value: count(now.line) });
  if (now.feed_mm_per_min !== undefined) entries.push({ name: "Feed", value: fixed(now.feed_mm_per_min, 0), unit: "mm/min" });
  if (now.override_percent !== undefined) entries.push({ name: "Override", value: fixed(now.override_percent, 0), unit: "%" });
  if (now.fifo) entries.push({ name: "FIFO", value: fixed((100 * now.fifo.bytes) / Math.max(1, now.fifo.capacity_bytes), 0), unit: `% of ${fixed(now.fifo.capacity_bytes / 1024, 0)} kB` });
  if (now.queue) entries.push({ name: "Blocks ahead", value: count(now.queue.blocks) });
  if (now.link) entries.push({ name: "Link", value: fixed(now.link.bytes_per_s / 1000, 1), unit: "kB/s" });
  entries.push({ name: "Time", value: fixed(now.time_s, 1), unit: "s" });
  return figures(entries);
}

export function axesTable(now: Now): Child {
  if (!now.axes?.length) return h("p", { class: "soft" }, "The control has not told its axes yet.");
  const unit = (a: { unit: string }): string => (a.unit === "mm" ? "mm" : "\u00b0");
  const limit = (value: number | null | undefined): string => (value === null || value === undefined ? "\u2013" : fixed(value, 0));
  const with_limits = now.axes.some((a) => a.min !== undefined);
  const rows = table("Positions in the machine", [
    { name: "axis", cell: (a) => a.name },
    { name: "position", cell: (a) => `${fixed(a.value, 3)} ${unit(a)}` },
    ...(with_limits ? [{ name: "from", cell: (a: { min?: number | null }) => limit(a.min) }, { name: "to", cell: (a: { max?: number | null }) => limit(a.max) }] : []),
  ], now.axes);
  if (!now.tool) return rows;
  const text = (values: number[], places: number): string => values.map((value) => fixed(value, places)).join("\u2002");
  return h("div", {}, rows, h("h3", { class: "spaced" }, "Tool"), pairs([
    ["tip, mm", text(now.tool.tip_mm, 3)], ["axis", text(now.tool.axis, 5)],
  ]));
}

export function alarmList(now: Now): Child {
  if (!now.alarms?.length) return h("p", { class: "soft" }, "No alarm.");
  return table("Only RESET at the control clears an alarm", [
    { name: "number", cell: (a) => String(a.number) }, { name: "line", cell: (a) => (a.line ? count(a.line) : "\u2013") },
    { name: "text", words: true, cell: (a) => a.text },
  ], now.alarms);
}

export function transferBody(now: Now): Child {
  const transfer = now.transfer;
  if (!transfer?.total_bytes) return h("p", { class: "soft" }, `Nothing has been sent${transfer ? `; the receiver is ${transfer.state}` : ""}.`);
  const share = (transfer.bytes ?? 0) / transfer.total_bytes;
  const entries: [string, Child][] = [
    ["program", transfer.name ?? ""], ["state", transfer.state],
    ["bytes", `${count(transfer.bytes ?? 0)} of ${count(transfer.total_bytes)}`],
    ["mode", transfer.drip ? "runs while it comes" : "stored, then run"],
  ];
  if (transfer.chunks_sent !== undefined) entries.push(["chunks", `${count(transfer.chunks_sent)}, ${count(transfer.chunks_repeated ?? 0)} repeated`]);
  if (now.link?.measured_bytes_per_s) entries.push(["measured link", `${fixed(now.link.measured_bytes_per_s / 1000, 1)} kB/s`]);
  if (transfer.digest) entries.push(["SHA-256", h("span", { class: "digest" }, transfer.digest)]);
  return h("div", {},
    h("div", { class: "bar", role: "progressbar", "aria-label": "Transfer", "aria-valuemin": 0, "aria-valuemax": 100, "aria-valuenow": Math.round(share * 100) },
      h("div", { style: `width: ${(share * 100).toFixed(2)}%` })),
    pairs(entries));
}

export function ledgerTable(now: Now): Child {
  if (!now.ledger?.length) return h("p", { class: "soft" }, "No ledger is kept, or nothing is in it.");
  return table("The last entries, newest first", [
    { name: "time, UTC", cell: (e) => e.time_utc.replace("T", " ").replace("Z", "") },
    { name: "event", words: true, cell: (e) => e.event }, { name: "program", words: true, cell: (e) => e.program },
    { name: "bytes", cell: (e) => count(e.bytes) }, { name: "SHA-256", words: true, cell: (e) => `${e.digest.slice(0, 12)}\u2026` },
    { name: "operator", words: true, cell: (e) => e.operator ?? "" }, { name: "detail", words: true, cell: (e) => e.detail ?? "" },
  ], now.ledger);
}
