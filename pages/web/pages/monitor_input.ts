// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// What the monitor page is made with, and what its server answers: docs/json.md.
import type { Stamp } from "../parts/page";

/** The document in the page. */
export interface MonitorInput extends Stamp {
  /** A control that runs programs, or a transfer on its way to one. */
  kind: "control" | "transfer";
  machine?: string;
  links?: string[];
  commands?: boolean;
}

export interface Axis {
  name: string;
  unit: "mm" | "deg";
  value: number;
  min?: number | null;
  max?: number | null;
}

export interface Alarm {
  number: number;
  line: number;
  text: string;
}

export interface Transfer {
  state: string;
  control_state?: string;
  name?: string;
  bytes?: number;
  total_bytes?: number;
  digest?: string;
  drip?: boolean;
  chunks_sent?: number;
  chunks_repeated?: number;
  timeouts?: number;
  message?: string;
}

export interface LedgerEntry {
  number: number;
  time_utc: string;
  event: string;
  program: string;
  bytes: number;
  digest: string;
  operator?: string;
  detail?: string;
}

export interface Now {
  time_s: number;
  state?: "reset" | "active" | "interrupted";
  waiting_for?: string;
  program?: string;
  line?: number;
  completed_line?: number;
  resume_line?: number;
  finished?: boolean;
  rapid?: boolean;
  override_percent?: number;
  feed_mm_per_min?: number;
  axes?: Axis[];
  tool?: { tip_mm: number[]; axis: number[] };
  queue?: { blocks: number; starvations: number };
  fifo?: { bytes: number; capacity_bytes: number };
  link?: { clients?: number; bytes_per_s: number; measured_bytes_per_s?: number };
  transfer?: Transfer;
  alarms?: Alarm[];
  ledger?: LedgerEntry[];
  over?: boolean;
}

export interface Curves {
  from: number;
  time_s: number[];
  feed_mm_per_min: (number | null)[];
  override_percent: (number | null)[];
  fifo_percent: (number | null)[];
  link_bytes_per_s: (number | null)[];
}

export interface Track {
  run: number;
  from: number;
  /** How many points the track has by now. */
  count: number;
  tip_mm: number[];
  cutting: number[];
}

export interface State {
  now: Now | null;
  curves: Curves;
  track: Track;
  /** Version of the programmed path; 0: none. */
  path: number;
}

export interface ProgramPath {
  version: number;
  points?: number;
  whole?: boolean;
  tip_mm?: number[];
  line?: number[];
  rapid?: number[];
}
