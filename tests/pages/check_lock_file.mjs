// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The lock file pins every package by version and digest, and names no host to take it from.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";

const folder = join(dirname(fileURLToPath(import.meta.url)), "../../pages");
const lock = readFileSync(join(folder, "package-lock.json"), "utf8");
assert.doesNotMatch(lock, /"resolved"|:\/\//);
const packages = Object.entries(JSON.parse(lock).packages).filter(([name]) => name !== "");
assert.ok(packages.length >= 5, "the lock file lists packages");
for (const [name, entry] of packages) assert.match(entry.integrity ?? "", /^sha512-/, `${name} has a digest`);
const wanted = JSON.parse(readFileSync(join(folder, "package.json"), "utf8")).devDependencies;
for (const [name, version] of Object.entries(wanted)) assert.match(version, /^\d/, `${name} is pinned to one version`);
