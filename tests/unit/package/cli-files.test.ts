/**
 * Output goes to a temporary file first, whatever earlier runs left there and however long the file name is.
 */
import { chmodSync, readdirSync, readFileSync, statSync, writeFileSync } from "node:fs";
import type * as FileSystem from "node:fs/promises";
import path from "node:path";

import { afterEach, expect, test, vi } from "vitest";

import { checkOutput, writeOutput } from "../../../wasm/src/cli/files.js";
import { temporaryFolder } from "../../support/temporary-folder.js";

const folder = temporaryFolder();

/** Called after a file is written and before it is renamed. */
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

test("writeOutput succeeds despite the temporary file of a killed run with the same process id", async () => {
  // In containers, every run can have the same process id.
  writeFileSync(path.join(folder.path, `.a.vtu.${process.pid}.part`), "half");
  const file = path.join(folder.path, "a.vtu");
  await checkOutput(file);
  await writeOutput(file, "whole");
  expect(readFileSync(file, "utf8")).toBe("whole");
});

test("writeOutput accepts file names up to the limit of the file system", async () => {
  const name = `${"n".repeat(251)}.vtu`;
  await checkOutput(path.join(folder.path, name));
  await writeOutput(path.join(folder.path, name), "whole");
  expect(readdirSync(folder.path)).toEqual([name]);
});

test("writeOutput keeps the permissions of a file that it replaces", async () => {
  const file = path.join(folder.path, "a.vtu");
  writeFileSync(file, "old");
  chmodSync(file, 0o660);
  await writeOutput(file, "new");
  expect(statSync(file).mode & 0o777).toBe(0o660);
});

test("writeOutput removes its temporary file on a signal, and the signal ends the process as usual", async () => {
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
