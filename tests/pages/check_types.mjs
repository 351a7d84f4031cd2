// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The TypeScript of the pages under the strict compiler, which bundling alone does not ask.
import { spawnSync } from "node:child_process";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";

const pages = join(dirname(fileURLToPath(import.meta.url)), "../../pages");
const compiler = join(pages, "node_modules/typescript/bin/tsc");
process.exit(spawnSync(process.execPath, [compiler, "--noEmit", "-p", pages], { stdio: "inherit" }).status ?? 1);
