// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Headless Chromium over its debugging pipe: what a page looks like, says to the console and asks of the network. Needs
// nothing but Node 18 and the program `chromium`.
import { spawn } from "node:child_process";
import { mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";

const flags = ["--headless", "--no-sandbox", "--disable-gpu", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
    "--disable-background-networking", "--disable-component-update", "--disable-sync", "--no-first-run",
    "--no-default-browser-check", "--hide-scrollbars", "--force-device-scale-factor=1", "--remote-debugging-pipe"];

/** One browser process; `close` ends it and removes its profile. */
export class Browser {
    static async start(program = "chromium") {
        const browser = new Browser();
        browser.profile = mkdtempSync(join(tmpdir(), "cusp-chromium-"));
        browser.process = spawn(program, [...flags, `--user-data-dir=${browser.profile}`, "about:blank"],
            { stdio: ["ignore", "ignore", "ignore", "pipe", "pipe"] });
        browser.process.stdio[4].on("data", (bytes) => browser.take(bytes));
        browser.ended = new Promise((resolve) => browser.process.on("close", resolve));
        return browser;
    }

    constructor() {
        this.nextId = 1;
        this.waiting = new Map();
        this.listeners = new Set();
        this.pieces = [];
    }

    /** Messages are JSON texts that end with a NUL byte. */
    take(bytes) {
        for (let begin = 0; begin < bytes.length;) {
            const end = bytes.indexOf(0, begin);
            this.pieces.push(bytes.subarray(begin, end < 0 ? bytes.length : end));
            if (end < 0) return;
            this.receive(JSON.parse(Buffer.concat(this.pieces).toString("utf8")));
            this.pieces = [];
            begin = end + 1;
        }
    }

    receive(message) {
        const waiting = this.waiting.get(message.id);
        if (waiting) {
            this.waiting.delete(message.id);
            if (message.error) waiting.reject(new Error(message.error.message));
            else waiting.resolve(message.result);
        } else {
            for (const listener of this.listeners) listener(message);
        }
    }

    send(method, params = {}, sessionId) {
        const id = this.nextId++;
        this.process.stdio[3].write(JSON.stringify({ id, method, params, sessionId }) + "\0");
        return new Promise((resolve, reject) => this.waiting.set(id, { resolve, reject }));
    }

    /** `scheme`: "light" or "dark"; what the page says and asks for is collected in `console` and `requests`. */
    open(file, options) {
        return this.openUrl(`file://${file}`, options);
    }

    async openUrl(url, { scheme = "light", width = 1240, height = 1000 } = {}) {
        const { targetId } = await this.send("Target.createTarget", { url: "about:blank" });
        const { sessionId } = await this.send("Target.attachToTarget", { targetId, flatten: true });
        const page = new Page(this, sessionId);
        await page.prepare(scheme, width, height);
        await page.load(url);
        return page;
    }

    async close() {
        this.send("Browser.close").catch(() => {});
        await this.ended;
        rmSync(this.profile, { recursive: true, force: true, maxRetries: 5 });
    }
}

class Page {
    constructor(browser, sessionId) {
        this.browser = browser;
        this.sessionId = sessionId;
        this.console = [];
        this.requests = [];
        browser.listeners.add((message) => message.sessionId === sessionId && this.hear(message));
    }

    hear({ method, params }) {
        if (method === "Runtime.consoleAPICalled") this.console.push(`${params.type}: ${params.args.map((a) => a.value ?? a.description).join(" ")}`);
        if (method === "Runtime.exceptionThrown") this.console.push(`exception: ${params.exceptionDetails.exception?.description ?? params.exceptionDetails.text}`);
        if (method === "Log.entryAdded") this.console.push(`${params.entry.level}: ${params.entry.text}`);
        if (method === "Network.requestWillBeSent") this.requests.push(params.request.url);
        if (method === "Page.loadEventFired") this.loaded?.();
    }

    send(method, params) {
        return this.browser.send(method, params, this.sessionId);
    }

    async prepare(scheme, width, height) {
        for (const domain of ["Page", "Runtime", "Log", "Network"]) await this.send(`${domain}.enable`);
        await this.send("Emulation.setDeviceMetricsOverride", { width, height, deviceScaleFactor: 1, mobile: false });
        await this.setScheme(scheme);
    }

    setScheme(scheme) {
        return this.send("Emulation.setEmulatedMedia", { features: [{ name: "prefers-color-scheme", value: scheme }] });
    }

    /** The screen shows what a printer would get, in one endless page. */
    async emulatePaper() {
        await this.send("Emulation.setEmulatedMedia", { media: "print" });
        await this.evaluate("dispatchEvent(new Event('beforeprint')), 0");
        await this.settle();
    }

    async load(url) {
        const loaded = new Promise((resolve) => (this.loaded = resolve));
        await this.send("Page.navigate", { url });
        await loaded;
        await this.settle();
    }

    /** Two frames: what observers and animation frames were asked for is drawn. */
    settle() {
        return this.evaluate("new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => done(true))))");
    }

    /** The value of a JavaScript expression in the page; a promise is awaited. */
    async evaluate(expression) {
        const { result, exceptionDetails } = await this.send("Runtime.evaluate", { expression, awaitPromise: true, returnByValue: true });
        if (exceptionDetails) throw new Error(exceptionDetails.exception?.description ?? exceptionDetails.text);
        return result.value;
    }

    text(selector) {
        return this.evaluate(`document.querySelector(${JSON.stringify(selector)})?.textContent ?? null`);
    }
    texts(selector) {
        return this.evaluate(`[...document.querySelectorAll(${JSON.stringify(selector)})].map((e) => e.textContent)`);
    }

    mouse(type, x, y, buttons = 0) {
        const button = buttons ? "left" : "none";
        return this.send("Input.dispatchMouseEvent", { type, x, y, button, buttons, clickCount: type === "mouseMoved" ? 0 : 1 });
    }

    async screenshot() {
        const height = await this.evaluate("document.documentElement.scrollHeight");
        const width = await this.evaluate("innerWidth");
        await this.send("Emulation.setDeviceMetricsOverride", { width, height, deviceScaleFactor: 1, mobile: false });
        await this.settle();
        const { data } = await this.send("Page.captureScreenshot", { format: "png" });
        return Buffer.from(data, "base64");
    }

    async pdf() {
        const { data } = await this.send("Page.printToPDF", { printBackground: false, preferCSSPageSize: true });
        return Buffer.from(data, "base64");
    }
}
