/** Tests the lock for work that only one process at a time may do. */
import { spawn, spawnSync } from "node:child_process";
import { readdirSync, readFileSync, writeFileSync } from "node:fs";
import { fileURLToPath } from "node:url";

import { expect, test } from "vitest";

import { temporaryFolder } from "../../support/temporary-folder.js";

const { inFolder } = temporaryFolder();
const lock = fileURLToPath(new URL("../../../scripts/lib/lock.mjs", import.meta.url));

const PROCESSES = 4;

/**
 * Logs its begin and its end. In between, it waits until all processes that have not begun wait for the lock: each
 * has a file with its id beside the lock.
 */
const WORKER = `
import { appendFileSync, readdirSync, readFileSync } from "node:fs";
import { setImmediate as pause } from "node:timers/promises";
const [module, folder] = process.argv.slice(1);
const { withLock } = await import(module);
const log = folder + "/log";
const begun = () => readFileSync(log, "utf8").split("begin").length - 1;
const waiting = () => readdirSync(folder).filter((name) => /^lock[.][0-9]+$/.test(name)).length;
await withLock(folder + "/lock", async () => {
  appendFileSync(log, "begin\\n");
  while (begun() + waiting() < ${PROCESSES}) await pause();
  appendFileSync(log, "end\\n");
});`;

function worker(): Promise<number | null> {
  const args = ["--input-type=module", "-e", WORKER, lock, inFolder(".")];
  return new Promise((resolve) => spawn(process.execPath, args, { stdio: "inherit" }).on("close", resolve));
}

test("processes take turns, even if a dead one has left its lock", async () => {
  writeFileSync(inFolder("lock"), String(spawnSync(process.execPath, ["-e", ""]).pid));
  expect(await Promise.all(Array.from({ length: PROCESSES }, worker))).toEqual([0, 0, 0, 0]);
  expect(readFileSync(inFolder("log"), "utf8")).toBe("begin\nend\n".repeat(PROCESSES));
  expect(readdirSync(inFolder("."))).toEqual(["log"]);
});
