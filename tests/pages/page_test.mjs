// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// What every page test starts with: a rendered page in a browser; and ends with: nothing said, nothing asked for.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";

import { Browser } from "./browser.mjs";

/** A browser and a scratch folder for the tests of one file. */
export class Stage {
    async open() {
        this.folder = mkdtempSync(join(tmpdir(), "cusp-pages-"));
        this.browser = await Browser.start();
        this.pages = 0;
    }
    async close() {
        await this.browser.close();
        rmSync(this.folder, { recursive: true, force: true });
    }

    /** Renders `document` (an object, or text as it is) and opens it. */
    async show(name, document, options) {
        const stem = join(this.folder, `${name}-${++this.pages}`);
        writeFileSync(`${stem}.json`, typeof document === "string" ? document : JSON.stringify(document));
        execFileSync(process.env.CUSP_RENDER_PAGE, [name, `${stem}.json`, `${stem}.html`]);
        return this.browser.open(`${stem}.html`, options);
    }
}

/** The page said nothing to the console and asked for nothing but itself. */
export function assertQuiet(page) {
    // The software renderer of a headless browser remarks on the kept buffer when a test reads it.
    assert.deepEqual(page.console.filter((line) => !line.includes("GPU stall due to ReadPixels")), []);
    assert.deepEqual(page.requests.filter((url) => !/^(file|data|blob):/.test(url)), []);
    assert.equal(page.requests.filter((url) => url.startsWith("file:")).length, 1, "the page is one file");
}

/** WCAG 2.2 contrast of two "rgb(r, g, b)" texts. */
export function contrast(one, other) {
    const luminance = (text) => {
        const [r, g, b] = text.match(/[\d.]+/g).map((c) => {
            const share = Number(c) / 255;
            return share <= 0.04045 ? share / 12.92 : ((share + 0.055) / 1.055) ** 2.4;
        });
        return 0.2126 * r + 0.7152 * g + 0.0722 * b;
    };
    const [high, low] = [luminance(one), luminance(other)].sort((a, b) => b - a);
    return (high + 0.05) / (low + 0.05);
}

/** Every text of the page against what lies under it: WCAG 2.2 AA, 4.5 : 1. */
export async function assertReadable(page) {
    const pairs = await page.evaluate(`[...document.querySelectorAll("h1, h2, h3, p, td, th, dt, dd, li, button, .word, .why, .tag")].map((e) => {
        let ground = e;
        while (getComputedStyle(ground).backgroundColor === "rgba(0, 0, 0, 0)") ground = ground.parentElement;
        return [getComputedStyle(e).color, getComputedStyle(ground).backgroundColor, e.textContent.slice(0, 40)];
    })`);
    assert.ok(pairs.length > 30);
    for (const [ink, ground, text] of pairs) assert.ok(contrast(ink, ground) >= 4.5, `${text}: ${ink} on ${ground}`);
}
