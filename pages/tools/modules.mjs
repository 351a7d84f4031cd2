// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Brings node_modules into the state that package-lock.json names, once, and does nothing when it is there already.
import { spawnSync } from "node:child_process";
import { createHash } from "node:crypto";
import { copyFileSync, existsSync, mkdtempSync, readFileSync, renameSync, rmSync, writeFileSync } from "node:fs";
import { join } from "node:path";

const manifest = ["package.json", "package-lock.json", ".npmrc"];

/** What node_modules must have been made from: the manifest, and the platform, since esbuild is a native program. */
function wantedState(folder) {
    const hash = createHash("sha256");
    for (const file of manifest) hash.update(readFileSync(join(folder, file))).update("\0");
    return `${hash.digest("hex")} ${process.platform} ${process.arch}\n`;
}

function isPresent(folder, state) {
    const stamp = join(folder, "node_modules", ".state");
    return existsSync(stamp) && readFileSync(stamp, "utf8") === state;
}

/** npm's own words, and a failure that names what to do about it. */
function runNpm(scratch) {
    // No script of a package runs: esbuild finds its program without one.
    const npm = spawnSync("npm", ["ci", "--ignore-scripts", "--loglevel=error"], { cwd: scratch, encoding: "utf8" });
    if (npm.error) throw new Error(`npm cannot be started (${npm.error.message}); scripts/deps.sh build installs it`);
    if (npm.status !== 0) {
        throw new Error(`npm ci ended with ${npm.status}; the first build of the pages needs a package registry\n` +
            `${npm.stdout}${npm.stderr}`);
    }
}

/**
 * Installs into a folder beside node_modules and renames it into place, so that an interrupted or a second, simultaneous
 * build never sees half of it. Without a network it succeeds when the modules are there.
 */
export function ensureModules(folder) {
    const state = wantedState(folder);
    if (isPresent(folder, state)) return;
    const scratch = mkdtempSync(join(folder, ".node_modules-"));
    try {
        for (const file of manifest) copyFileSync(join(folder, file), join(scratch, file));
        runNpm(scratch);
        const made = join(scratch, "node_modules");
        writeFileSync(join(made, ".state"), state);
        const modules = join(folder, "node_modules");
        if (isPresent(folder, state)) return;
        if (existsSync(modules)) renameSync(modules, join(scratch, "replaced"));
        try {
            renameSync(made, modules);
        } catch (error) {
            // Another build was faster: its modules are as good.
            if (!isPresent(folder, state)) throw error;
        }
    } finally {
        rmSync(scratch, { recursive: true, force: true });
    }
}
