// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The texture page in a browser.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";

import { assertQuiet, assertReadable, Stage } from "./page_test.mjs";
import { textureSample } from "./samples.mjs";

const stage = new Stage();
const sample = textureSample();
before(() => stage.open());
after(() => stage.close());

test("shows curves and every parameter with unit and source", async () => {
    const page = await stage.show("texture", sample);
    assert.equal(await page.text("h1"), "Scan5535.csv");
    assert.equal(await page.evaluate("document.querySelectorAll('.chart canvas').length"), 2);
    const rows = await page.evaluate("[...document.querySelectorAll('.scroll tbody tr')].map((r) => [...r.children].map((c) => c.textContent))");
    assert.equal(rows.length, sample.profiles[0].parameters.P.length);
    assert.deepEqual(rows[0], ["a", "0.3000", "0.3000", "0.3000", "\u00b5m", "", "ISO 4287:1997"]);
    const ten_point = rows.find((row) => row[0] === "zJIS");
    assert.equal(ten_point[3], "\u2013", "what a profile does not have is a dash");
    assert.equal(rows.find((row) => row[0] === "Tp")[5], "1 \u00b5m under the highest peak");
    assertQuiet(page);
});

test("reads off the roughness under the pointer", async () => {
    const page = await stage.show("texture", sample);
    const at = await page.evaluate(`(() => {
        const over = document.querySelectorAll(".u-over")[1];
        over.scrollIntoView({ block: "center" });
        const r = over.getBoundingClientRect();
        return { x: r.left + r.width / 3, y: r.top + r.height / 2 };
    })()`);
    await page.mouse("mouseMoved", at.x, at.y);
    await page.settle();
    const [x, height] = (await page.texts(".figure + .figure .u-value")).map((text) => Number(text.replace("\u2212", "-")));
    const { roughness } = sample.profiles[0].curves;
    const index = roughness.x_mm.findIndex((value) => Math.abs(value - x) < 1e-6);
    assert.ok(index > 0, `${x}`);
    assert.ok(Math.abs(roughness.height_um[index] - height) < 0.0006, `${height}`);
    assertQuiet(page);
});

for (const scheme of ["light", "dark"]) {
    test(`reads well: ${scheme}`, async () => {
        const page = await stage.show("texture", sample, { scheme });
        await assertReadable(page);
        assertQuiet(page);
    });
}
