/**
 * Tests the dependency rule of the package and of the app: modules import lower modules only, and files do not import
 * each other in cycles.
 */
import { mkdirSync, mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import path from "node:path";
import { afterEach, beforeEach, expect, test } from "vitest";

import { wrongImports } from "../../../scripts/lib/dependencies.mjs";

const LEVELS = [["base"], ["formats", "project"], ["api"]];
let folder = "";

beforeEach(() => {
  folder = mkdtempSync(path.join(tmpdir(), "dependencies-"));
});
afterEach(() => rmSync(folder, { recursive: true }));

function write(files: Readonly<Record<string, string>>): void {
  for (const [name, text] of Object.entries(files)) {
    mkdirSync(path.join(folder, path.dirname(name)), { recursive: true });
    writeFileSync(path.join(folder, name), text);
  }
}

test("imports of lower modules and of the same module are allowed, and the entry file may import all", () => {
  write({
    "base/a.ts": "",
    "base/b.ts": 'import "./a.js";',
    "api/c.ts": 'export { x } from "../base/a.js";',
    "index.ts": 'export * from "./api/c.js";',
  });
  expect(wrongImports({ folder, modules: LEVELS })).toEqual([]);
});

test.each([
  ["import of a value", 'import { x } from "../api/c.js";'],
  ["import of a type", 'import type { X } from "../api/c.js";'],
  ["export from", 'export type { X } from "../api/c.js";'],
  ["dynamic import", 'void import("../api/c.js");'],
])("%s from a higher module is an error", (_, text) => {
  write({ "base/a.ts": text, "api/c.ts": "" });
  expect(wrongImports({ folder, modules: LEVELS })).toEqual([
    expect.stringContaining("base/a.ts imports api/c.ts, which is not below base/"),
  ]);
});

test("modules of one level must not import each other, nor may a module import the entry file", () => {
  write({
    "formats/a.ts": 'import "../project/b.js";',
    "project/b.ts": "",
    "api/c.ts": 'import "../index.js";',
    "index.ts": "",
  });
  expect(wrongImports({ folder, modules: LEVELS })).toHaveLength(2);
});

test("a cycle of files is an error, although they are in one module and import types only", () => {
  write({
    "base/a.ts": 'import type { B } from "./b.js";',
    "base/b.ts": 'import type { C } from "./c.js";',
    "base/c.ts": 'import type { A } from "./a.js";',
  });
  expect(wrongImports({ folder, modules: LEVELS })).toEqual([
    "these files import each other: base/a.ts → base/b.ts → base/c.ts → base/a.ts",
  ]);
});

test("imports of the app leave out the ending and the name of an index file", () => {
  write({
    "base/a.ts": 'import { X } from "../api/x"; import { y } from "../api";',
    "base/b.tsx": 'export { X } from "../api/x"; void import("../api/z");',
    "api/x.tsx": "",
    "api/z.ts": "",
    "api/index.ts": "",
  });
  expect(wrongImports({ folder, modules: LEVELS })).toEqual([
    expect.stringContaining("base/a.ts imports api/x.tsx, which is not below base/"),
    expect.stringContaining("base/a.ts imports api/index.ts, which is not below base/"),
    expect.stringContaining("base/b.tsx imports api/x.tsx, which is not below base/"),
    expect.stringContaining("base/b.tsx imports api/z.ts, which is not below base/"),
  ]);
});
