/** Temporary folders for tests that read and write files; they are removed after the tests. */
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import path from "node:path";

import { afterAll, afterEach, beforeAll, beforeEach } from "vitest";

import { tetrafront, type CommandResult } from "./command-line.js";

export interface TemporaryFolder {
  /** Path of the folder. There is a new folder for each test, or one for the whole file. */
  readonly path: string;
  /** Returns the path of a file in the folder. */
  readonly inFolder: (name: string) => string;
  /** Writes a file in the folder. */
  readonly save: (name: string, content: string | Uint8Array) => void;
  /** Runs `tetrafront` in the folder. */
  readonly run: (...args: readonly string[]) => Promise<CommandResult>;
}

const MADE_FOR = { "each test": [beforeEach, afterEach], "all tests": [beforeAll, afterAll] } as const;

/** Makes an empty folder before each test of this file, or before all of them, and removes it afterwards. */
export function temporaryFolder(madeFor: keyof typeof MADE_FOR = "each test"): TemporaryFolder {
  let folder = "";
  const [before, after] = MADE_FOR[madeFor];
  before(() => {
    folder = mkdtempSync(path.join(tmpdir(), "tetrafront-"));
  });
  after(() => rmSync(folder, { recursive: true, force: true }));
  const inFolder = (name: string) => path.join(folder, name);
  return {
    get path() {
      return folder;
    },
    inFolder,
    save: (name, content) => writeFileSync(inFolder(name), content),
    run: (...args) => tetrafront(folder, args),
  };
}
