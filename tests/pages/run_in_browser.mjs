// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// run_in_browser.mjs TEST.mjs: runs a page test, or says that it is skipped (exit 77) where there is no Chromium.
import { spawnSync } from "node:child_process";

if (spawnSync("chromium", ["--version"]).status !== 0) {
    console.log("skipped: chromium is not installed (scripts/deps.sh test)");
    process.exit(77);
}
process.exit(spawnSync(process.execPath, ["--test", process.argv[2]], { stdio: "inherit" }).status ?? 1);
