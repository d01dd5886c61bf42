/** Files are written beside their place first, whatever other runs have left there and however long their names are. */
import { mkdtempSync, readdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import path from "node:path";

import { afterEach, beforeEach, expect, test } from "vitest";

import { checkOutput, writeOutput } from "../../../wasm/src/cli-files.js";

let folder = "";
beforeEach(() => {
  folder = mkdtempSync(path.join(tmpdir(), "tetrafront-"));
});
afterEach(() => rmSync(folder, { recursive: true, force: true }));

test("what a run that was killed has left does not stop another of its number", async () => {
  // In a container every run has the same one.
  writeFileSync(path.join(folder, `.a.vtu.${process.pid}.part`), "half");
  const file = path.join(folder, "a.vtu");
  await checkOutput(file);
  await writeOutput(file, "whole");
  expect(readFileSync(file, "utf8")).toBe("whole");
});

test("a name as long as file systems have them can be written", async () => {
  const name = `${"n".repeat(251)}.vtu`;
  await checkOutput(path.join(folder, name));
  await writeOutput(path.join(folder, name), "whole");
  expect(readdirSync(folder)).toEqual([name]);
});
