// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// take_pictures.mjs RENDER_PAGE FOLDER: every page of a sample document as PNG, light and dark, and as PDF, to look at.
import { execFileSync } from "node:child_process";
import { mkdirSync, writeFileSync } from "node:fs";
import { join, resolve } from "node:path";

import { Browser } from "./browser.mjs";
import { capabilitySample, inspectionSample, loopSample, optimizationSample, simulationSample, textureSample, tiltSample } from "./samples.mjs";

const samples = { capability: capabilitySample, inspection: inspectionSample, loop: loopSample, loopSample, optimization: optimizationSample, simulation: simulationSample, texture: textureSample, tilt: tiltSample };
const [renderPage, where] = process.argv.slice(2);
const folder = resolve(where);
mkdirSync(folder, { recursive: true });
const browser = await Browser.start();
for (const [name, sample] of Object.entries(samples)) {
    const stem = join(folder, name);
    writeFileSync(`${stem}.json`, JSON.stringify(sample()));
    execFileSync(renderPage, [name, `${stem}.json`, `${stem}.html`]);
    for (const scheme of ["light", "dark"]) {
        const page = await browser.open(`${stem}.html`, { scheme });
        writeFileSync(`${stem}-${scheme}.png`, await page.screenshot());
        for (const line of page.console) console.log(`${name}, ${scheme}: ${line}`);
    }
    const paper = await browser.open(`${stem}.html`, { scheme: "dark", width: 690 });
    writeFileSync(`${stem}.pdf`, await paper.pdf());
    await paper.emulatePaper();
    writeFileSync(`${stem}-paper.png`, await paper.screenshot());
}
await browser.close();
