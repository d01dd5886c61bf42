import { readFileSync } from "node:fs";

import { ENGINE_CODES, type Diagnostic, type DiagnosticCode, type DiagnosticOf } from "tetrafront";
import { describe, expect, expectTypeOf, test } from "vitest";

import { ENGINE_DATA } from "../../../wasm/src/diagnostics/data.js";
import {
  describeAll,
  describeDiagnostic,
  describeInSteps,
  ENTITY_KINDS,
} from "../../../wasm/src/diagnostics/describe.js";
import { nameByIndex } from "../../../wasm/src/diagnostics/entity-names.js";
import type { DiagnosticArrays } from "../../../wasm/src/engine/loader.js";
import { projectNamer } from "../../../wasm/src/project/names.js";
import { cubeProject } from "../../support/projects.js";

/** About everything at once: two of each kind, a place, and three values. */
const rich = {
  severity: 2,
  entities: Uint32Array.from(ENTITY_KINDS.flatMap((_, kind) => [kind, 1, kind, 2])),
  place: Float64Array.of(0.125, 1 / 3, -2),
  values: Float64Array.of(7.123456789, 3, 2),
};
const bare = {
  severity: 2,
  entities: new Uint32Array(),
  place: new Float64Array(),
  values: new Float64Array(),
};

/** The names of a code's numbers; those with a `?` may be missing. */
const numbersOf = (name: string): readonly string[] => ENGINE_DATA[name as keyof typeof ENGINE_DATA] ?? [];

/** About everything, with an option that there is where the first number names one. */
const richOf = (name: string) =>
  numbersOf(name)[0] === "option" ? { ...rich, values: Float64Array.of(1, 3, 2) } : rich;

/** As little as the engine may say. */
const leastOf = (name: string) => ({
  ...bare,
  values: new Float64Array(numbersOf(name).filter((entry) => !entry.endsWith("?")).length).fill(2),
});

describe.each(Object.entries(ENGINE_CODES))("code %s, %s,", (code, name) => {
  test("is told in whole sentences", () => {
    for (const raw of [richOf(name), leastOf(name)]) {
      const said = describeDiagnostic({ code: Number(code), ...raw }, nameByIndex);
      expect(said.code).toBe(name);
      expect(said.message).toMatch(/^[A-Z][^\n]*[^.\s]$/);
      expect(said.message).not.toMatch(/undefined|NaN|null|object/);
      expect(said.remedy).toMatch(
        ["reoriented-patch", "nested-regions"].includes(name) ? /^$/ : /^[A-Z].*\.$/,
      );
    }
  });

  test("carries entities, place and numbers along", () => {
    const said = describeDiagnostic({ code: Number(code), ...richOf(name) }, nameByIndex);
    expect(said.entities).toHaveLength(2 * ENTITY_KINDS.length);
    expect(said.position).toEqual([0.125, 1 / 3, -2]);
    expect(Object.keys(said.data)).toEqual(numbersOf(name).map((entry) => entry.replace("?", "")));
    const least = describeDiagnostic({ code: Number(code), ...leastOf(name) }, nameByIndex);
    expect(least.position).toBeUndefined();
    expect(Object.keys(least.data)).toEqual(numbersOf(name).filter((entry) => !entry.endsWith("?")));
  });

  test("is not told with fewer numbers than it has", () => {
    const { values, ...rest } = leastOf(name);
    if (values.length === 0) return;
    const raw = { code: Number(code), ...rest, values: values.subarray(1) };
    expect(() => describeDiagnostic(raw, nameByIndex)).toThrow(`with ${name}`);
  });
});

test("what the engine has numbers for has names for all of them", () => {
  const header = new URL("../../../cpp/include/tetrafront/status.h", import.meta.url);
  const text = readFileSync(header, "utf8").replace(/\n\s*\/\/\//g, "");
  const withNumbers = [...text.matchAll(/= (\d+),\s*\/\/\/<[^\n]*values:([^\n]*)/g)];
  expect(withNumbers.length).toBeGreaterThan(15);
  const named = (code: string | undefined) =>
    Object.entries(ENGINE_DATA).find(
      ([name]) => ENGINE_CODES[Number(code) as keyof typeof ENGINE_CODES] === name,
    );
  expect(withNumbers.filter(([, code]) => named(code) === undefined).map(([line]) => line)).toEqual([]);
});

describe("the data of a diagnostic", () => {
  const told = (code: number, ...values: number[]) =>
    describeDiagnostic({ ...bare, code, values: Float64Array.from(values) }, nameByIndex).data;

  test("are the engine's numbers by their names, as far as it gave them", () => {
    expect(told(25, 3e7, 2e7)).toEqual({ expected: 3e7, limit: 2e7 });
    expect(told(43, 12)).toEqual({ count: 12 });
    expect(told(43, 12, 1)).toEqual({ count: 12, isLowerBound: true });
    expect(told(50, 0, 3)).toEqual({ isBetweenRegions: false, count: 3 });
    expect(told(15, 1, -2)).toEqual({ option: "growth", given: -2 });
    expect(told(12)).toEqual({});
  });

  test("are told apart by the code", () => {
    expectTypeOf<Diagnostic["code"]>().toEqualTypeOf<DiagnosticCode>();
    expectTypeOf<DiagnosticOf<"invalid-option">["data"]["option"]>().toBeString();
    const optionOf = (found: Diagnostic) => {
      switch (found.code) {
        case "option-out-of-range":
          return found.data.option;
        case "invalid-option":
          return found.data.option;
        case "too-many-elements":
          return found.data.expected / found.data.limit;
        case "malformed-file":
          return found.data.line;
        default:
          return undefined;
      }
    };
    expectTypeOf(optionOf).returns.toEqualTypeOf<string | number | undefined>();
  });
});

test("diagnostics come out of the engine's arrays as they were put in, at once or in steps", () => {
  const arrays = {
    heads: Uint32Array.of(40, 2, 1, 1, 1, 12, 2, 0, 0, 0, 43, 2, 2, 1, 2, 44, 1, 2, 0, 0),
    entities: Uint32Array.of(5, 7, 5, 1, 5, 2, 5, 3, 5, 4),
    positions: Float64Array.of(1, 2, 3, 4, 5, 6),
    values: Float64Array.of(9, 100, 1),
  };
  const told = describeAll(arrays, nameByIndex);
  const indices = told.map(({ entities }) => entities.map(({ index }) => index));
  expect(told.map(({ code }) => code)).toEqual([
    "open-edge",
    "empty-model",
    "self-intersection",
    "duplicate-triangle",
  ]);
  expect(indices).toEqual([[7], [], [1, 2], [3, 4]]);
  expect(told.map(({ position }) => position)).toEqual([[1, 2, 3], undefined, [4, 5, 6], undefined]);
  expect(told.map(({ data }) => data)).toEqual([{ count: 9 }, {}, { count: 100, isLowerBound: true }, {}]);
  expect(told.map(({ severity }) => severity)).toEqual(["error", "error", "error", "warning"]);
  expect(stepsOf(arrays)).toEqual([1, told]);
});

test("of many diagnostics none takes long between two steps", () => {
  const count = 20_000;
  const heads = Uint32Array.from({ length: 5 * count }, (_, i) => [12, 2, 0, 0, 0][i % 5] ?? 0);
  const [steps, told] = stepsOf({ ...NO_ENTITIES, heads });
  expect(told).toHaveLength(count);
  expect(steps).toBeGreaterThan(40);
});

const NO_ENTITIES = {
  entities: new Uint32Array(),
  positions: new Float64Array(),
  values: new Float64Array(),
};

/** In how many steps they are described, and as what. */
function stepsOf(arrays: DiagnosticArrays): [number, Diagnostic[]] {
  const work = describeInSteps(arrays, nameByIndex);
  for (let steps = 1; ; steps++) {
    const step = work.next();
    if (step.done === true) return [steps, step.value];
  }
}

test("labels of callers are words, whatever signs are in them", () => {
  const raw = { ...leastOf("open-edge"), code: 40, entities: Uint32Array.of(5, 0) };
  const name = () => ({ kind: "triangle", index: 0, label: "part (1" }) as const;
  expect(describeDiagnostic(raw, name).message).toContain("part (1 (counted from 0)");
});

describe("of one thing it is said in the singular:", () => {
  test.each(Object.entries(ENGINE_CODES))("code %s, %s", (code) => {
    const values = Float64Array.of(1, 1, 1);
    for (const entities of [new Uint32Array(), rich.entities.slice(0, 2), Uint32Array.of(5, 1)]) {
      const said = describeDiagnostic({ ...bare, code: Number(code), entities, values }, nameByIndex);
      const singular =
        /\b1 (points|lines|sides|triangles|faces|tetrahedra|places|regions|cavities|nodes|edges)\b/;
      expect(said.message).not.toMatch(singular);
      expect(said.remedy).not.toMatch(singular);
    }
  });
});

test("the remedy of turned triangles tells of regions where these would take them", () => {
  const remedy = (isBetweenRegions: number) =>
    describeDiagnostic(
      { ...bare, code: 50, entities: Uint32Array.of(5, 1), values: Float64Array.of(isBetweenRegions, 3) },
      nameByIndex,
    ).remedy;
  expect(remedy(1)).toMatch(/--repair.*--inner-shells regions/);
  expect(remedy(0)).toMatch(/--repair/);
  expect(remedy(0)).not.toMatch(/regions/);
});

test("a coordinate too large to compute with is not said to be no number", () => {
  const said = (value: number) =>
    describeDiagnostic(
      { ...bare, code: 0, entities: Uint32Array.of(0, 0), values: Float64Array.of(value) },
      nameByIndex,
    ).message;
  expect(said(-1e200)).toMatch(/has the coordinate -1e\+200, whose magnitude/);
  expect(said(NaN)).toMatch(/not a finite number$/);
});

test("pairs of triangles that meet are counted, and said to be more where the count was ended", () => {
  const told = (...values: number[]) =>
    describeDiagnostic(
      { ...bare, code: 43, entities: Uint32Array.of(5, 3, 5, 8), values: Float64Array.from(values) },
      nameByIndex,
    ).message;
  expect(told(1)).toMatch(/triangle 3 .*and triangle 8 intersect$/);
  expect(told(1600)).toMatch(/intersect \(1600 pairs of triangles in all\)$/);
  expect(told(100000, 1)).toMatch(/intersect \(at least 100000 pairs of triangles in all\)$/);
});

test("an estimate beyond counting is told as such, and gives no factor", () => {
  const told = (estimate: number) =>
    describeDiagnostic({ ...bare, code: 25, values: Float64Array.of(estimate, 2e7) }, nameByIndex);
  expect(told(1.6e8).remedy).toBe("Use elements at least 2.0 times as large.");
  expect(told(1.6e8).message).toMatch(/require about 160000000 /);
  expect(told(1e15).remedy).toBe("Use far larger elements.");
  expect(told(1e15).message).toMatch(/require more than 1000000000000000 /);
});

test("entities have the names the user gave them, else their ids", () => {
  const cube = cubeProject();
  const lines = cube.lines.map((line) => (line.id === 3 ? { ...line, name: "lip" } : line));
  const said = describeDiagnostic(
    { ...bare, code: 7, entities: Uint32Array.of(2, 5, 1, 2), place: Float64Array.of(1, 0.5, 1 / 3) },
    projectNamer({ ...cube, lines }),
  );
  expect(said.message).toBe(
    'A loop of patch "right" is not closed: the next line does not begin where line "lip" ends at (1, 0.5, 0.333333)',
  );
  expect(said.entities).toEqual([
    { kind: "patch", index: 5, id: 6, label: 'patch "right"' },
    { kind: "line", index: 2, id: 3, label: 'line "lip"' },
  ]);
  expect(projectNamer(cube)("line", 2).label).toBe("line 3");
});

test("an edge of a given surface asks for other repairs than one of a drawing", () => {
  const about = (kind: number) =>
    describeDiagnostic({ ...leastOf("open-edge"), code: 40, entities: Uint32Array.of(kind, 0) }, nameByIndex)
      .remedy;
  expect(about(ENTITY_KINDS.indexOf("triangle"))).toMatch(/triangles/);
  expect(about(ENTITY_KINDS.indexOf("line"))).toMatch(/patch/);
});

test("what is named by its position says once how positions are counted", () => {
  const said = (code: number, entities: number[], name = nameByIndex) =>
    describeDiagnostic({ ...bare, code, entities: Uint32Array.from(entities) }, name).message;
  const triangle = ENTITY_KINDS.indexOf("triangle");
  expect(said(44, [triangle, 1, triangle, 12])).toBe(
    "Triangle 1 (counted from 0) and triangle 12 are duplicates",
  );
  const line = ENTITY_KINDS.indexOf("line");
  expect(said(4, [line, 2], projectNamer(cubeProject()))).toBe("Line 3 has no length");
});
