// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The inspection page in a browser.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";

import { assertQuiet, assertReadable, contrast, Stage } from "./page_test.mjs";
import { inspectionSample } from "./samples.mjs";

const stage = new Stage();
const sample = inspectionSample();
before(() => stage.open());
after(() => stage.close());

test("shows the decision, the figures and every part of the report", async () => {
    const page = await stage.show("inspection", sample);
    assert.equal(await page.text(".verdict .word"), "Undecided");
    assert.match(await page.text(".verdict .why"), /than its uncertainty allows\. Limits \u221210 \u2026 \+10\u2009\u00b5m, after best fit\. Rule: ISO 14253-1:2017, 95 %\. Standard uncertainty 0\.80/);
    const shown = await page.texts(".figures dd");
    assert.equal(shown[0], "12\u2009000");
    assert.equal(shown[1], `${(sample.deviation.min_mm * 1000).toFixed(1).replace("-", "\u2212")}\u2009\u00b5m`);
    assert.deepEqual(await page.texts("h2"), ["Deviation map", "Profile sections", "Distribution", "Best fit and fixed datums", "Alignment", "Largest deviations", "What to know"]);
    assert.equal((await page.texts("#sections .figure h3")).length, 4);
    assert.equal(await page.evaluate("document.querySelectorAll('#sections canvas').length"), 4);
    assert.equal(await page.evaluate("document.documentElement.scrollWidth <= innerWidth"), true, "nothing is cut off at the side");
    assertQuiet(page);
});

test("draws the map, turns it with the mouse and names the point under the pointer", async () => {
    const page = await stage.show("inspection", sample);
    const colors = await page.evaluate(`(() => {
        const canvas = document.querySelector(".map canvas");
        const copy = document.createElement("canvas");
        [copy.width, copy.height] = [canvas.width, canvas.height];
        const context = copy.getContext("2d");
        context.drawImage(canvas, 0, 0);
        const { data } = context.getImageData(0, 0, copy.width, copy.height);
        const seen = { blue: 0, orange: 0 };
        for (let i = 0; i < data.length; i += 4) {
            if (data[i + 2] > data[i] + 40) ++seen.blue;
            if (data[i] > data[i + 2] + 40) ++seen.orange;
        }
        return seen;
    })()`);
    assert.ok(colors.blue > 2000 && colors.orange > 2000, `both signs are seen: ${JSON.stringify(colors)}`);
    const at = await page.evaluate(`(() => {
        document.querySelector("#map").scrollIntoView();
        const r = document.querySelector(".map canvas").getBoundingClientRect();
        return { x: r.left + r.width / 2, y: r.top + r.height / 2 };
    })()`);
    await page.mouse("mouseMoved", at.x, at.y);
    await page.settle();
    assert.match(await page.text(".map .tip"), /^[+\u2212\d.]+ \u00b5mx y z  /);
    const before_turn = await page.evaluate("document.querySelector('.map').dataset.camera");
    await page.mouse("mousePressed", at.x, at.y, 1);
    await page.mouse("mouseMoved", at.x + 120, at.y + 20, 1);
    await page.mouse("mouseReleased", at.x + 120, at.y + 20, 0);
    await page.settle();
    assert.notEqual(await page.evaluate("document.querySelector('.map').dataset.camera"), before_turn);
    assertQuiet(page);
});

test("sections go from measurement number to arc length and show values under the pointer", async () => {
    const page = await stage.show("inspection", sample);
    const hover = `(() => {
        const over = document.querySelector("#sections .u-over");
        over.scrollIntoView({ block: "center" });
        const r = over.getBoundingClientRect();
        return { x: r.left + r.width / 2, y: r.top + r.height / 2 };
    })()`;
    const read = async () => {
        const at = await page.evaluate(hover);
        await page.mouse("mouseMoved", at.x, at.y);
        await page.settle();
        return page.texts("#sections .figure:first-child .u-value");
    };
    const by_number = await read();
    const index = Number(by_number[0]) - 1;
    assert.ok(index > 50 && index < 150, by_number[0]);
    const expected = (sample.sections[0].curve.deviation_mm[index] * 1000).toFixed(2).replace("-", "\u2212");
    assert.equal(by_number[1], expected);
    await page.evaluate("document.querySelectorAll('#sections .choice button')[1].click()");
    await page.settle();
    const by_arc = await read();
    const arc = Number(by_arc[0]);
    assert.ok(sample.sections[0].curve.arc_length_mm.some((s) => Math.abs(s - arc) < 0.0006), by_arc[0]);
    assertQuiet(page);
});

for (const scheme of ["light", "dark"]) {
    test(`reads well: ${scheme}`, async () => {
        const page = await stage.show("inspection", sample, { scheme });
        await assertReadable(page);
        const page_ground = await page.evaluate("getComputedStyle(document.documentElement).backgroundColor");
        assert.equal(contrast(page_ground, "rgb(255, 255, 255)") < 2, scheme === "light");
        assertQuiet(page);
    });
}

// Sizes of SVG rectangles are CSS properties: a rule for something else of the same class would win over their attributes.
test("bars of the histogram are as high as their counts", async () => {
    const page = await stage.show("inspection", sample);
    const wrong = await page.evaluate(`[...document.querySelectorAll(".histogram rect.bar")]
        .filter((e) => Math.abs(e.getBBox().height - Number(e.getAttribute("height"))) > 0.01).map((e) => e.outerHTML)`);
    assert.deepEqual(wrong, []);
    assert.ok(await page.evaluate("document.querySelectorAll('.histogram rect.bar').length") > 5);
    assertQuiet(page);
});

test("every control and figure has a name", async () => {
    const page = await stage.show("inspection", sample);
    const nameless = await page.evaluate(`[...document.querySelectorAll("button, input, canvas[tabindex], svg[role], section, [role=group], [role=region]")]
        .filter((e) => !(e.textContent.trim() || e.getAttribute("aria-label") || e.getAttribute("aria-labelledby"))).map((e) => e.outerHTML.slice(0, 80))`);
    assert.deepEqual(nameless, []);
    const h1 = await page.texts("h1");
    assert.deepEqual(h1, ["Sculptured benchmark part"]);
});

test("prints in light colours even from a dark screen", async () => {
    const page = await stage.show("inspection", sample, { scheme: "dark" });
    const pdf = await page.pdf();
    assert.equal(pdf.subarray(0, 5).toString(), "%PDF-");
    assert.ok(pdf.length > 50000);
    assert.equal(await page.evaluate("document.documentElement.hasAttribute('data-paper')"), false, "the screen is as before");
    assertQuiet(page);
});

test("shows what there is of a small report, and text as text", async () => {
    const page = await stage.show("inspection", {
        points: 3, title: "<b>bold</b>", deviation: { count: 3, min_mm: -0.001, max_mm: 0.002, mean_mm: 0, rms_mm: 0.001, standard_deviation_mm: 0.001, profile_mm: 0.004 },
    });
    assert.equal(await page.text("h1"), "<b>bold</b>");
    assert.equal(await page.text(".verdict .word"), "No decision");
    assert.deepEqual(await page.texts("h2"), []);
    assertQuiet(page);
});

test("doubts stand before the decision", async () => {
    const page = await stage.show("inspection", { ...sample, title: undefined, points_file: "/parts/17.csv", doubts: ["the points may be in inches"] });
    assert.equal(await page.text("h1"), "17.csv");
    assert.equal(await page.text(".problem"), "The points may be in inches.");
    assert.ok(await page.evaluate("document.querySelector('.problem').compareDocumentPosition(document.querySelector('.verdict')) & Node.DOCUMENT_POSITION_FOLLOWING"));
    assertQuiet(page);
});

test("says on the page that it cannot be drawn", async () => {
    const page = await stage.show("inspection", { points: 3 });
    assert.match(await page.text("[role=alert]"), /^This page cannot be drawn: /);
});
