/** Files are written beside their place first, whatever other runs have left there and however long their names are. */
import { readdirSync, readFileSync, writeFileSync } from "node:fs";
import path from "node:path";

import { expect, test } from "vitest";

import { checkOutput, writeOutput } from "../../../wasm/src/cli-files.js";
import { temporaryFolder } from "../../support/temporary-folder.js";

const folder = temporaryFolder();

test("what a run that was killed has left does not stop another of its number", async () => {
  // In a container every run has the same one.
  writeFileSync(path.join(folder.path, `.a.vtu.${process.pid}.part`), "half");
  const file = path.join(folder.path, "a.vtu");
  await checkOutput(file);
  await writeOutput(file, "whole");
  expect(readFileSync(file, "utf8")).toBe("whole");
});

test("a name as long as file systems have them can be written", async () => {
  const name = `${"n".repeat(251)}.vtu`;
  await checkOutput(path.join(folder.path, name));
  await writeOutput(path.join(folder.path, name), "whole");
  expect(readdirSync(folder.path)).toEqual([name]);
});
