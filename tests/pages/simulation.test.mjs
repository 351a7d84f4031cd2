// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The simulation page in a browser.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";

import { assertQuiet, assertReadable, Stage } from "./page_test.mjs";
import { simulationSample } from "./samples.mjs";

const stage = new Stage();
before(() => stage.open());
after(() => stage.close());

test("a collision decides, and its row puts the tool there", async () => {
    const sample = simulationSample();
    const page = await stage.show("simulation", sample);
    assert.equal(await page.text("h1"), "groove.cls");
    assert.match(await page.text(".verdict"), /Does not conform.*1 collision;.*14\.2/s);
    assert.match(await page.text("#collisions tbody tr"), /31.*39.*holder.*stock.*0\.812.*14\.20/s);
    await page.evaluate("document.querySelector('#collisions button').click()");
    await page.settle();
    const { tip_mm } = sample.path;
    const wanted = [0, 1, 2].map((k) => tip_mm[90 + k].toFixed(3)).join(" ");
    assert.equal(await page.evaluate("document.querySelector('.map').dataset.tip"), wanted);
    assert.match(await page.text("#view output"), /move 31 of 81, CL line 39, feed/);
    assertQuiet(page);
});

test("without collisions there is no list of them", async () => {
    const page = await stage.show("simulation", simulationSample({ collisions: 0 }));
    assert.match(await page.text(".verdict"), /Conforms/);
    assert.equal(await page.evaluate("document.querySelectorAll('#collisions').length"), 0);
    assertQuiet(page);
});

for (const scheme of ["light", "dark"]) {
    test(`is readable, ${scheme}`, async () => {
        await assertReadable(await stage.show("simulation", simulationSample(), { scheme }));
    });
}
