// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The monitor page on a real `cusp controller`: a program is sent and run while a browser watches.
import assert from "node:assert/strict";
import { execFileSync, spawn } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";

import { Browser } from "./browser.mjs";
import { assertReadable } from "./page_test.mjs";

const command = process.env.CUSP_COMMAND;
const patience_ms = 25_000;

/** A program that winds in five axes for some seconds. */
function windingProgram(blocks) {
    const lines = ["G40 G17 G710 G94 G90 G60 G601", "TRAFOOF", "SUPA G0 Z0 D0", 'T="BALL_10"', "M6", "D1", "CYCLE832(0.01,_ORI_FINISH,0.1)",
        "G54", "S8000 M3", "G0 C20 A15", "TRAORI", "G54", "ORIAXES", "G0 X0 Y0 C20 A15", "Z50", "G1 Z0 F3000"];
    for (let i = 1; i <= blocks; ++i) {
        const s = 0.5 * i;
        lines.push(`X${(40 * Math.sin(s / 40)).toFixed(5)} Y${(0.05 * s + 0.4 * Math.sin(s / 7)).toFixed(5)} Z${(2 * Math.cos(s / 25) - 2).toFixed(5)} ` +
            `C${(20 + 10 * Math.sin(s / 60)).toFixed(5)} A${(15 + 5 * Math.sin(s / 45)).toFixed(5)}`);
    }
    return [...lines, "G0 Z100", "TRAFOOF", "SUPA G0 Z0 D0", "M30", ""].join("\n");
}

let folder;
let browser;
let control;
let said = "";
let link;
let address;

/** Waits for `find` to find something in what the control says. */
async function heard(find) {
    for (const until = Date.now() + patience_ms; Date.now() < until;) {
        const found = find();
        if (found) return found;
        await new Promise((resolve) => control.stdout.once("data", resolve));
    }
    throw new Error(`not heard: ${find}; the control said:\n${said}`);
}

/** Waits until `expression` holds in the page. */
async function until(page, expression) {
    for (const end = Date.now() + patience_ms; Date.now() < end;) {
        if (await page.evaluate(expression)) return;
        await page.settle();
    }
    throw new Error(`never: ${expression}; the page says: ${await page.text("main")}`);
}

function send(program) {
    writeFileSync(join(folder, "WIND.MPF"), program);
    return execFileSync(command, ["send", join(folder, "WIND.MPF"), "--to", link, "--arm", "--no-ledger"], { encoding: "utf8" });
}

before(async () => {
    folder = mkdtempSync(join(tmpdir(), "cusp-monitor-"));
    control = spawn(command, ["controller", "-m", "fooke-endura-ca", "--wcs-origin-mm", "3000", "0", "-700", "--listen", "tcp://127.0.0.1:0",
        "--monitor", "127.0.0.1:0", "--monitor-commands", "--ledger", join(folder, "ledger.sqlite"), "--store", folder],
    { stdio: ["pipe", "pipe", "inherit"] });
    control.stdout.on("data", (bytes) => (said += bytes));
    link = (await heard(() => /listening on (\S+)/.exec(said)))[1];
    address = (await heard(() => /monitor page at (\S+)/.exec(said)))[1];
    browser = await Browser.start();
});
after(async () => {
    control.stdin.end("quit\n");
    await browser?.close();
    rmSync(folder, { recursive: true, force: true });
});

/** Quiet, and asks nobody but the server it came from. */
function assertOwnOnly(page) {
    const origin = new URL(address).origin;
    assert.deepEqual(page.console.filter((line) => !line.includes("GPU stall due to ReadPixels")), []);
    assert.deepEqual(page.requests.filter((url) => !url.startsWith(`${origin}/`) && !/^(data|blob):/.test(url)), []);
}

test("a program runs before the eyes of whoever watches", async () => {
    const page = await browser.openUrl(address);
    await until(page, `document.querySelector("#axes tbody")?.rows.length === 5`);
    assert.equal(await page.text(".verdict .word"), "Reset");
    assert.match(await page.text("h1"), /Virtual control/);
    const program = windingProgram(3000);
    send(program);
    assert.equal(readFileSync(join(folder, "WIND.MPF"), "utf8"), program);
    await until(page, `document.querySelector("#transfer .digest") && Number(document.querySelector(".map.path").dataset.planned) > 100`);
    assert.match(await page.text("#transfer"), new RegExp(`${program.length.toLocaleString("en").replaceAll(",", ".")} of`));
    control.stdin.write("start\n");
    await until(page, `document.querySelector(".verdict .word").textContent === "Running" && Number(document.querySelector(".map.path").dataset.points) > 20`);
    const first = await page.evaluate(`document.querySelector(".map.path").dataset.tool`);
    await until(page, `document.querySelector(".map.path").dataset.tool !== ${JSON.stringify(first)}`);
    assert.match(await page.text(".figures"), /Feed[\d\s.]+mm\/min/);
    await until(page, `[...document.querySelectorAll("#ledger td")].some((e) => e.textContent === "running")`);
    assertOwnOnly(page);
});

test("commands reach the control, a start is none of them", async () => {
    const page = await browser.openUrl(address, { scheme: "dark" });
    await until(page, `document.querySelector(".verdict .word").textContent === "Running"`);
    assert.deepEqual(await page.texts("#commands .choice button"), ["NC stop", "Reset", "Continuous", "Single block"]);
    await page.evaluate(`document.querySelector("#commands .choice button").click(), 0`);
    await until(page, `document.querySelector(".verdict .word").textContent === "Interrupted"`);
    assert.match(await page.text(".verdict .why"), /NC stop/);
    await assertReadable(page);
    await page.evaluate(`[...document.querySelectorAll("#commands .choice button")][1].click(), 0`);
    await until(page, `document.querySelector(".verdict .word").textContent === "Reset"`);
    assertOwnOnly(page);
});

test("without the word in the address nobody commands", async () => {
    const page = await browser.openUrl(new URL(address).origin + "/");
    await until(page, `document.querySelector("#axes tbody")?.rows.length === 5`);
    assert.equal(await page.evaluate(`document.querySelector("#commands")`), null);
    const status = await page.evaluate(`fetch("command", { method: "POST", body: '{"do":"stop"}' }).then((answer) => answer.status)`);
    assert.equal(status, 403);
    await assertReadable(page);
});

test("an alarm is shown with its number and line", async () => {
    send("G54 G90\nSUPA G1 F3000 X99999\nM30\n");
    control.stdin.write("start\n");
    const page = await browser.openUrl(address);
    await until(page, `document.querySelector(".verdict .word").textContent === "Alarm 10720"`);
    assert.match(await page.text("#alarms"), /axis X would go to 99999/);
    assert.equal(await page.evaluate(`document.querySelectorAll("button:not([aria-label])").length === [...document.querySelectorAll("button")].filter((b) => b.textContent).length`), true);
    control.stdin.write("reset\n");
});

test("a control that is gone leaves its last figures and says so", async () => {
    const page = await browser.openUrl(address);
    await until(page, `document.querySelector("#axes tbody")?.rows.length === 5`);
    control.stdin.write("quit\n");
    await until(page, `document.querySelector(".verdict .word").textContent === "No connection"`);
    assert.equal(await page.evaluate(`document.querySelector("#axes tbody").rows.length`), 5);
});
