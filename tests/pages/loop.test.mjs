// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The loop page in a browser.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";

import { assertQuiet, assertReadable, Stage } from "./page_test.mjs";
import { loopSample } from "./samples.mjs";

const stage = new Stage();
const sample = loopSample();
before(() => stage.open());
after(() => stage.close());

const um = (mm) => (mm * 1e3).toFixed(1);

test("shows every part in both judgements, and every section", async () => {
    const page = await stage.show("loop", sample);
    const rows = await page.evaluate("[...document.querySelectorAll('#parts tbody tr')].map((r) => [...r.children].map((c) => c.textContent))");
    assert.equal(rows.length, 4);
    assert.deepEqual(rows[0].slice(0, 2), ["First part", um(sample.before.max_abs_deviation_mm)]);
    assert.equal(rows[0][3], um(sample.before.best_fit_max_abs_deviation_mm));
    assert.deepEqual(rows.map((row) => row[5]), ["out", "out", "within", "within"]);
    assert.equal(await page.evaluate("document.querySelectorAll('#sections .chart canvas').length"), 4);
    const found = await page.evaluate("[...document.querySelectorAll('#calibration tbody tr')].map((r) => [...r.children].map((c) => c.textContent))");
    assert.equal(found[0][0], "pivot_length_mm");
    assert.equal(found[0][3], "0.0512", "the hidden error stands beside what was found");
    assert.equal(found[2][1], "\u2013", "what was refused has no value");
    assertQuiet(page);
});

test("leaves the calibration out where there was none", async () => {
    const page = await stage.show("loop", { ...sample, calibration: null, calibrated: null });
    assert.equal(await page.evaluate("document.querySelectorAll('#calibration').length"), 0);
    assert.equal(await page.evaluate("document.querySelectorAll('#parts tbody tr').length"), 3);
    assertQuiet(page);
});

for (const scheme of ["light", "dark"]) {
    test(`reads well: ${scheme}`, async () => {
        const page = await stage.show("loop", sample, { scheme });
        await assertReadable(page);
        assertQuiet(page);
    });
}
