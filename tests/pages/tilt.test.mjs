// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The tilt page in a browser.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";

import { assertQuiet, assertReadable, Stage } from "./page_test.mjs";
import { tiltSample } from "./samples.mjs";

const stage = new Stage();
before(() => stage.open());
after(() => stage.close());

test("says whether the path is free, and shows every run", async () => {
    const page = await stage.show("tilt", tiltSample());
    assert.equal(await page.text("h1"), "CAVITY");
    assert.deepEqual(await page.texts("#comparison .tag"), ["free of collision"]);
    assert.match(await page.text("#program"), /^Posted program proven: read back without a finding, 941 of 941 cutter locations met/);
    assert.equal((await page.texts("#runs tbody th")).length, 3);
    assert.equal(await page.evaluate("document.querySelectorAll('.chart canvas').length"), 1);
    assert.equal(await page.evaluate("document.documentElement.scrollWidth <= innerWidth"), true);
    assertQuiet(page);
});

test("says it where it is not, and leaves out a search that was none", async () => {
    const page = await stage.show("tilt", { ...tiltSample({ free: false }), runs: [], curves: [] });
    assert.deepEqual(await page.texts("#comparison .tag"), ["not free of collision"]);
    assert.match(await page.text("#program"), /^No program was posted/);
    assert.equal(await page.evaluate("document.querySelectorAll('.chart canvas').length"), 0);
    assertQuiet(page);
});

for (const scheme of ["light", "dark"]) {
    test(`reads well: ${scheme}`, async () => {
        const page = await stage.show("tilt", tiltSample(), { scheme });
        await assertReadable(page);
        assertQuiet(page);
    });
}
