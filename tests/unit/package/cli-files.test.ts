/** Files are written beside their place first, whatever other runs have left there and however long their names are. */
import { chmodSync, readdirSync, readFileSync, statSync, writeFileSync } from "node:fs";
import type * as FileSystem from "node:fs/promises";
import path from "node:path";

import { afterEach, expect, test, vi } from "vitest";

import { checkOutput, writeOutput } from "../../../wasm/src/cli/files.js";
import { temporaryFolder } from "../../support/temporary-folder.js";

const folder = temporaryFolder();

/** Called between writing a file and renaming it. */
let beforeRename: () => void = () => undefined;
vi.mock("node:fs/promises", async (original) => {
  const module = await original<typeof FileSystem>();
  return {
    ...module,
    rename: (from: string, to: string) => {
      beforeRename();
      return module.rename(from, to);
    },
  };
});
afterEach(() => (beforeRename = () => undefined));

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

test("a file that is replaced keeps its permissions", async () => {
  const file = path.join(folder.path, "a.vtu");
  writeFileSync(file, "old");
  chmodSync(file, 0o660);
  await writeOutput(file, "new");
  expect(statSync(file).mode & 0o777).toBe(0o660);
});

test("a signal while a file is written ends the program as usual, and leaves nothing of the file", async () => {
  const kill = vi.spyOn(process, "kill").mockReturnValue(true);
  const isLeft = () => readdirSync(folder.path).some((name) => name.endsWith(".part"));
  beforeRename = () => {
    expect(isLeft()).toBe(true);
    process.emit("SIGINT", "SIGINT");
    expect(isLeft()).toBe(false);
  };
  await expect(writeOutput(path.join(folder.path, "a.bin"), "whole")).rejects.toThrow("cannot be written");
  expect(kill).toHaveBeenCalledExactlyOnceWith(process.pid, "SIGINT");
  expect(readdirSync(folder.path)).toEqual([]);
  expect(process.listenerCount("SIGTERM")).toBe(0);
  kill.mockRestore();
});
