/**
 * Tests the dependency rule. Package and app: modules import lower modules only, and files do not import each other in
 * cycles. Engine: modules and public headers include lower ones only.
 */
import { mkdirSync, mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import path from "node:path";
import { afterEach, beforeEach, describe, expect, test } from "vitest";

import { engineLayers, wrongImports, wrongIncludes } from "../../../scripts/lib/dependencies.mjs";

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

describe("includes of the engine:", () => {
  /** Returns the violations of an engine in the folder; its public headers are `ids.h`, `shape.h` and `all.h`. */
  const violations = (files: Readonly<Record<string, string>>) => {
    write({ "public/ids.h": "", "public/shape.h": "", "public/all.h": "", "src/base/a.h": "", ...files });
    return wrongIncludes({
      sources: path.join(folder, "src"),
      modules: [["base"], ["field", "model"], ["quality"]],
      publicHeaders: path.join(folder, "public"),
      moduleOfHeader: { "ids.h": "base", "shape.h": "model", "all.h": undefined },
    });
  };

  test("those of lower modules and of the same module are allowed, and the files above all modules may include all", () => {
    const found = violations({
      "public/shape.h": '#include "tetrafront/ids.h"',
      "public/all.h": '#include "tetrafront/shape.h"',
      "src/model/b.cpp": '#include "tetrafront/shape.h"\n#include "tetrafront/ids.h"\n#include "base/a.h"',
      "src/quality/c.h": '#include "tetrafront/shape.h"\n#include "model/b.h"\n#include <vector>',
      "src/mesher.cpp": '#include "tetrafront/all.h"\n#include "quality/c.h"',
    });
    expect(found).toEqual([]);
  });

  test.each([
    ["of a higher module", "base/b.h", '#include "model/a.h"', "model/a.h, which is not below base/"],
    [
      "of another module of the level",
      "field/b.h",
      '#include "model/a.h"',
      "model/a.h, which is not below field/",
    ],
    [
      "of the public header of a higher module",
      "base/b.cpp",
      '#include "tetrafront/shape.h"',
      "tetrafront/shape.h, which is not below base/",
    ],
    [
      "of the public header of another module of the level",
      "field/b.cpp",
      '#  include "tetrafront/shape.h"',
      "tetrafront/shape.h, which is not below field/",
    ],
    [
      "of the public header above all modules",
      "quality/b.h",
      '#include "tetrafront/all.h"',
      "tetrafront/all.h, which is not below quality/",
    ],
  ])("one %s is an error", (_, file, text, message) => {
    expect(violations({ [`src/${file}`]: text })).toEqual([
      expect.stringContaining(`${file} includes ${message}`),
    ]);
  });

  test("a public header must not include one of a higher module", () => {
    expect(violations({ "public/ids.h": '#include "tetrafront/shape.h"' })).toEqual([
      expect.stringContaining("ids.h includes tetrafront/shape.h, which is not below base/"),
    ]);
  });

  test("a public header must not include a private one", () => {
    expect(violations({ "public/shape.h": '#include "base/a.h"' })).toEqual([
      expect.stringContaining("shape.h includes base/a.h, which is not public"),
    ]);
  });

  test("each public header has a module, and each entry of the table a header", () => {
    expect(violations({ "public/new.h": "" })).toEqual([expect.stringContaining("new.h has no module")]);
    expect(wrongIncludes({ ...engineLayers, publicHeaders: path.join(folder, "public") })).toContain(
      "PUBLIC_HEADERS lists mesher.h, which does not exist",
    );
  });
});
