/** Tests the lock for work that only one process at a time may do. */
import { spawn, spawnSync } from "node:child_process";
import { readdirSync, readFileSync, writeFileSync } from "node:fs";
import { fileURLToPath } from "node:url";

import { expect, test } from "vitest";

import { temporaryFolder } from "../../support/temporary-folder.js";

const { inFolder } = temporaryFolder();
const lock = fileURLToPath(new URL("../../../scripts/lib/lock.mjs", import.meta.url));

/** Logs its begin and its end, with a delay between them in which another process could run. */
const WORKER = `
import { appendFileSync } from "node:fs";
import { setTimeout as sleep } from "node:timers/promises";
const [module, lock, log] = process.argv.slice(1);
const { withLock } = await import(module);
await withLock(lock, async () => {
  appendFileSync(log, "begin\\n");
  await sleep(150);
  appendFileSync(log, "end\\n");
});`;

function worker(): Promise<number | null> {
  const args = ["--input-type=module", "-e", WORKER, lock, inFolder("lock"), inFolder("log")];
  return new Promise((resolve) => spawn(process.execPath, args, { stdio: "inherit" }).on("close", resolve));
}

test("processes take turns, even if a dead one has left its lock", async () => {
  writeFileSync(inFolder("lock"), String(spawnSync(process.execPath, ["-e", ""]).pid));
  expect(await Promise.all(Array.from({ length: 4 }, worker))).toEqual([0, 0, 0, 0]);
  expect(readFileSync(inFolder("log"), "utf8")).toBe("begin\nend\n".repeat(4));
  expect(readdirSync(inFolder("."))).toEqual(["log"]);
});
