// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The optimization page in a browser.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";

import { assertQuiet, assertReadable, Stage } from "./page_test.mjs";
import { optimizationSample } from "./samples.mjs";

const stage = new Stage();
before(() => stage.open());
after(() => stage.close());

test("says what was found beside what it is compared with, and draws path, front, convergence and population", async () => {
    const page = await stage.show("optimization", optimizationSample());
    assert.equal(await page.text("h1"), "Benchmark");
    assert.deepEqual(await page.texts("#comparison .tag"), ["within tolerance"]);
    assert.deepEqual(await page.texts("#comparison thead th"), ["", "found", "best constant lead"]);
    assert.equal((await page.texts("#front .scroll tbody th")).length, 4);
    assert.equal((await page.texts("#population .scroll tbody th")).length, 8);
    assert.equal(await page.evaluate("document.querySelectorAll('.chart canvas').length"), 3);
    // 14 passes of 21 contacts are 14 x 20 pieces of line.
    assert.equal(await page.evaluate("document.querySelector('#map .map').dataset.trace"), "280");
    assert.equal(await page.evaluate("document.documentElement.scrollWidth <= innerWidth"), true);
    assertQuiet(page);
});

test("shows the map of the other path when asked", async () => {
    const page = await stage.show("optimization", optimizationSample());
    const legend = () => page.text("#map svg.legend");
    const found = await legend();
    await page.evaluate("[...document.querySelectorAll('#map button, #map input')].find((e) => (e.textContent || e.parentElement.textContent).includes('best constant lead')).click()");
    assert.notEqual(await legend(), found);
    assertQuiet(page);
});

test("leaves out what the document does not have, and says where the tolerance is missed", async () => {
    const page = await stage.show("optimization", { ...optimizationSample({ mode: "paper", before: false }), overcut_max_mm: 0.07 });
    assert.deepEqual(await page.texts("#comparison .tag"), ["not within tolerance"]);
    assert.equal(await page.evaluate("document.querySelector('#front') === null"), true);
    assert.deepEqual(await page.texts("#comparison thead th"), ["", "found"]);
    assertQuiet(page);
});

for (const scheme of ["light", "dark"]) {
    test(`reads well: ${scheme}`, async () => {
        const page = await stage.show("optimization", optimizationSample(), { scheme });
        await assertReadable(page);
        assertQuiet(page);
    });
}
