// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The capability page in a browser.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";

import { assertQuiet, assertReadable, Stage } from "./page_test.mjs";
import { capabilitySample } from "./samples.mjs";

const stage = new Stage();
const sample = capabilitySample();
before(() => stage.open());
after(() => stage.close());

test("lists every characteristic, the least capable first", async () => {
    const page = await stage.show("capability", sample);
    assert.equal(await page.text("h1"), "results.qif");
    assert.deepEqual(await page.texts("#overview tbody th"), ["DRIFTING of BORE", "GOOD of BORE", "FREE of BORE"]);
    assert.deepEqual(await page.texts("#overview .tag"), ["not capable", "Ppk \u2265 1.33", "no index"]);
    const good = sample.characteristics[0];
    const row = await page.evaluate("[...document.querySelectorAll('#overview tbody tr')][1].innerText");
    assert.ok(row.includes(good.ppk.toFixed(2)), row);
    assert.match(await page.evaluate("[...document.querySelectorAll('#overview tbody tr')][0].innerText"), /rising/);
    assert.equal(await page.evaluate("document.documentElement.scrollWidth <= innerWidth"), true);
    assert.equal(await page.evaluate("(() => { const t = document.querySelector('#overview .scroll'); return t.scrollWidth <= t.clientWidth; })()"), true);
    assertQuiet(page);
});

test("opens a characteristic from the list, and all of them", async () => {
    const page = await stage.show("capability", sample);
    const headings = () => page.texts("h2");
    assert.deepEqual(await headings(), ["Characteristics", "DRIFTING of BORE"]);
    await page.evaluate("document.querySelectorAll('#overview tbody a')[1].click()");
    assert.deepEqual(await headings(), ["Characteristics", "GOOD of BORE"]);
    await page.evaluate("document.querySelectorAll('#overview .choice button')[1].click()");
    await page.settle();
    assert.deepEqual(await headings(), ["Characteristics", "DRIFTING of BORE", "GOOD of BORE", "FREE of BORE"]);
    assert.equal(await page.evaluate("document.querySelectorAll('.chart canvas').length"), 3);
    assertQuiet(page);
});

for (const scheme of ["light", "dark"]) {
    test(`reads well: ${scheme}`, async () => {
        const page = await stage.show("capability", sample, { scheme });
        await assertReadable(page);
        assertQuiet(page);
    });
}
