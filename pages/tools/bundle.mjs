// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Bundles every page of web/pages.json into one HTML text and writes them all as one C++ source of bytes.
//
//   node bundle.mjs OUTPUT.cpp
import { readFileSync, writeFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";

import { ensureModules } from "./modules.mjs";

const folder = join(dirname(fileURLToPath(import.meta.url)), "..");
/** Where the JSON document goes; the C++ side joins the two halves around it. */
const dataMark = "@@DATA@@";

async function bundle(esbuild, entry) {
    const result = await esbuild.build({
        entryPoints: [join(folder, "web", entry)],
        bundle: true,
        write: false,
        minify: true,
        charset: "utf8",
        format: "iife",
        target: ["chrome100", "firefox100", "safari15"],
        loader: { ".css": "text" },
        metafile: true,
        // Whole licences stand at the end instead.
        legalComments: "none",
        logLevel: "warning",
    });
    return result.outputFiles[0].text + licences(Object.keys(result.metafile.inputs));
}

/** What is bundled travels with its licence. */
function licences(inputs) {
    const packages = new Set(inputs.map((file) => /node_modules\/((?:@[^/]+\/)?[^/]+)\//.exec(file)?.[1]).filter(Boolean));
    return [...packages].sort().map((name) => {
        const at = join(folder, "node_modules", name);
        const { version } = JSON.parse(readFileSync(join(at, "package.json"), "utf8"));
        return `/*\n${name} ${version}\n\n${readFileSync(join(at, "LICENSE"), "utf8").trim().replaceAll("*/", "* /")}\n*/\n`;
    }).join("");
}

async function styleSheet(esbuild) {
    const result = await esbuild.build({
        entryPoints: [join(folder, "web/style/page.css")], bundle: true, write: false, minify: true, charset: "utf8",
        target: ["chrome100", "firefox100", "safari15"], logLevel: "warning",
    });
    return result.outputFiles[0].text;
}

/** The policy lets the page load nothing at all; a page with `"live": true` may ask the server it came from. */
function html(page, style, script) {
    const policy = "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data: blob:" +
        (page.live ? "; connect-src 'self'" : "");
    return `<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="color-scheme" content="light dark">
<meta name="generator" content="cusp">
<meta http-equiv="Content-Security-Policy" content="${policy}">
<link rel="icon" href="data:,">
<title>${page.title}</title>
<style>${style}</style>
</head>
<body data-page="${page.name}">
<noscript>This page draws its figures with JavaScript, which is switched off here. The numbers are in the JSON and CSV files beside it.</noscript>
<main id="page"></main>
<script type="application/json" id="data">${dataMark}</script>
<script>${script}</script>
</body>
</html>
`;
}

/** A C++ string literal; bytes beyond ASCII in octal, which unlike hexadecimal escapes ends after three digits. */
function literal(bytes) {
    let out = "";
    for (const byte of bytes) {
        if (byte === 0x22 || byte === 0x5c) out += "\\" + String.fromCharCode(byte);
        else if (byte === 0x0a) out += "\\n";
        else if (byte < 0x20 || byte > 0x7e || byte === 0x3f) out += "\\" + byte.toString(8).padStart(3, "0");
        else out += String.fromCharCode(byte);
    }
    return `"${out}"`;
}

/** Pieces below the 65 536 characters that every compiler takes. */
function pieces(text) {
    const bytes = Buffer.from(text, "utf8");
    const out = [];
    for (let begin = 0; begin < bytes.length; begin += 32768) {
        const piece = bytes.subarray(begin, begin + 32768);
        out.push(`    {${literal(piece)}, ${piece.length}},\n`);
    }
    return out.join("");
}

function cppSource(pages) {
    let arrays = "";
    let table = "";
    for (const { name, text } of pages) {
        const halves = text.split(dataMark);
        if (halves.length !== 2) throw new Error(`page ${name}: ${dataMark} must stand there exactly once`);
        arrays += `constexpr std::string_view ${name}_before[] = {\n${pieces(halves[0])}};\n`;
        arrays += `constexpr std::string_view ${name}_after[] = {\n${pieces(halves[1])}};\n`;
        table += `    {"${name}", ${name}_before, ${name}_after},\n`;
    }
    return `// Made by pages/tools/bundle.mjs; not for reading.
#include "page_template.hpp"

namespace cusp::pages {
namespace {
${arrays}constexpr PageTemplate templates[] = {
${table}};
}  // namespace
std::span<const PageTemplate> pageTemplates() { return templates; }
}  // namespace cusp::pages
`;
}

async function main(output) {
    ensureModules(folder);
    const esbuild = await import("esbuild");
    const style = await styleSheet(esbuild);
    const pages = [];
    for (const page of JSON.parse(readFileSync(join(folder, "web/pages.json"), "utf8"))) {
        const script = await bundle(esbuild, `pages/${page.name}.ts`);
        if (/<\/script/i.test(script)) throw new Error(`page ${page.name}: its script would end its own element`);
        pages.push({ name: page.name, text: html(page, style, script) });
    }
    writeFileSync(output, cppSource(pages));
}

await main(process.argv[2]);
