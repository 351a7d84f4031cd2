// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Asking the server this page came from, again and again, one question at a time.

const every_ms = 200;
const hidden_ms = 2000;
const failed_ms = 1000;
const patience_ms = 5000;

/** Calls `ask` for the next address, hands the answer to `take`, and says by `lost` when there is none. */
export function poll<Answer>(ask: () => string, take: (answer: Answer) => boolean, lost: () => void): void {
  const once = async (): Promise<void> => {
    let next_ms = document.hidden ? hidden_ms : every_ms;
    try {
      const answer = await fetch(ask(), { cache: "no-store", signal: AbortSignal.timeout(patience_ms) });
      if (!answer.ok) throw new Error(String(answer.status));
      if (take((await answer.json()) as Answer)) next_ms = 0;
    } catch {
      lost();
      next_ms = failed_ms;
    }
    setTimeout(() => void once(), next_ms);
  };
  void once();
}
