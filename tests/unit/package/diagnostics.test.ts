import type { Diagnostic, DiagnosticCode } from "tetrafront";
import { ENGINE_CODES } from "tetrafront/internal";
import { describe, expect, expectTypeOf, test } from "vitest";

import {
  describeAll,
  describeDiagnostic,
  describeInSteps,
  type EngineEntity,
} from "../../../wasm/src/diagnostics/describe.js";
import { nameByIndex } from "../../../wasm/src/diagnostics/entity-names.js";
import {
  type DiagnosticArrays,
  ENGINE_VALUES,
  type EngineCode,
  type EngineNumbers,
  type EngineValue,
  ENTITY_KINDS,
} from "../../../wasm/src/generated/constants.js";
import { projectNamer } from "../../../wasm/src/project/names.js";
import { cubeProject } from "../../support/projects.js";
import type { NoData } from "../../../wasm/src/diagnostics/data.js";
import type { DiagnosticOf } from "../../../wasm/src/diagnostics/diagnostic.js";

/** Returns entities from pairs of a kind and an index. */
function entitiesOf(...numbers: readonly number[]): EngineEntity[] {
  return numbers.flatMap((kind, i) => (i % 2 === 0 ? [{ kind, index: numbers[i + 1] ?? 0 }] : []));
}

/** A diagnostic with everything: two entities of each kind, a position and three values. */
const complete = {
  severity: 2,
  entities: ENTITY_KINDS.flatMap((_, kind) => entitiesOf(kind, 1, kind, 2)),
  position: [0.125, 1 / 3, -2] as const,
  values: Float64Array.of(7.123456789, 3, 2),
};
const empty = {
  severity: 2,
  entities: [],
  position: undefined,
  values: new Float64Array(),
};

const valuesOf = (name: string): readonly EngineValue[] => ENGINE_VALUES[name as keyof typeof ENGINE_VALUES];

/** Returns a diagnostic with everything; if the first value is an option, with a valid one. */
const completeOf = (name: string) =>
  valuesOf(name)[0]?.type === "option" ? { ...complete, values: Float64Array.of(1, 3, 2) } : complete;

/** Returns the minimal diagnostic that the engine can report. */
const minimalOf = (name: string) => ({
  ...empty,
  values: new Float64Array(valuesOf(name).filter(({ isOptional }) => !isOptional).length).fill(2),
});

describe.each(Object.entries(ENGINE_CODES))("code %s, %s,", (code, name) => {
  test("has a message and a remedy in complete sentences", () => {
    for (const raw of [completeOf(name), minimalOf(name)]) {
      const diagnostic = describeDiagnostic({ code: Number(code), ...raw }, nameByIndex);
      expect(diagnostic.code).toBe(name);
      expect(diagnostic.message).toMatch(/^[A-Z][^\n]*[^.\s]$/);
      expect(diagnostic.message).not.toMatch(/undefined|NaN|null|object/);
      expect(diagnostic.remedy).toMatch(
        ["reoriented-patch", "nested-regions"].includes(name) ? /^$/ : /^[A-Z].*\.$/,
      );
    }
  });

  test("keeps entities, position and values", () => {
    const diagnostic = describeDiagnostic({ code: Number(code), ...completeOf(name) }, nameByIndex);
    expect(diagnostic.entities).toHaveLength(2 * ENTITY_KINDS.length);
    expect(diagnostic.position).toEqual([0.125, 1 / 3, -2]);
    expect(Object.keys(diagnostic.data)).toEqual(valuesOf(name).map((value) => value.name));
    const minimal = describeDiagnostic({ code: Number(code), ...minimalOf(name) }, nameByIndex);
    expect(minimal.position).toBeUndefined();
    expect(Object.keys(minimal.data)).toEqual(
      valuesOf(name)
        .filter(({ isOptional }) => !isOptional)
        .map((value) => value.name),
    );
  });

  test("is rejected if a required value is missing", () => {
    const { values, ...rest } = minimalOf(name);
    if (values.length === 0) return;
    const raw = { code: Number(code), ...rest, values: values.subarray(1) };
    expect(() => describeDiagnostic(raw, nameByIndex)).toThrow(`with ${name}`);
  });
});

describe("the data of a diagnostic", () => {
  const dataOf = (code: number, ...values: number[]) =>
    describeDiagnostic({ ...empty, code, values: Float64Array.from(values) }, nameByIndex).data;

  test("hold the engine's values by name, without missing ones", () => {
    expect(dataOf(25, 3e7, 2e7)).toEqual({ expected: 3e7, limit: 2e7 });
    expect(dataOf(43, 12)).toEqual({ count: 12 });
    expect(dataOf(43, 12, 1)).toEqual({ count: 12, isLowerBound: true });
    expect(dataOf(50, 0, 3)).toEqual({ isBetweenRegions: false, count: 3 });
    expect(dataOf(15, 1, -2)).toEqual({ option: "growth", given: -2 });
    expect(dataOf(15, 6, 200)).toEqual({ option: "feature-angle", given: 200 });
    expect(dataOf(12)).toEqual({});
  });

  test("of the engine have the types of its table", () => {
    expectTypeOf<EngineNumbers["self-intersection"]>().toEqualTypeOf<{
      readonly count: number;
      readonly isLowerBound?: boolean;
    }>();
    expectTypeOf<DiagnosticOf<"flipped-triangle">["data"]["isBetweenRegions"]>().toBeBoolean();
    expectTypeOf<DiagnosticOf<"zero-length-line">["data"]>().toEqualTypeOf<NoData>();
    expectTypeOf<keyof EngineNumbers>().toExtend<EngineCode>();
  });

  test("have a type that depends on the code", () => {
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

test("the remedy for an option out of range is about that option", () => {
  const found = describeDiagnostic({ ...empty, code: 15, values: Float64Array.of(6, 200) }, nameByIndex);
  expect(found.message).toBe("The feature angle is 200, which is out of range");
  expect(found.remedy).toBe("Use an angle from 1 to 180 degrees.");
});

test("diagnostics are decoded from the engine's arrays, at once or in steps", () => {
  const arrays = {
    code: Uint16Array.of(40, 12, 43, 44),
    severity: Uint8Array.of(2, 2, 2, 1),
    entities: {
      lengths: Uint32Array.of(1, 0, 2, 2),
      items: { kind: Uint8Array.of(5, 5, 5, 5, 5), index: Uint32Array.of(7, 1, 2, 3, 4) },
    },
    hasPosition: Uint8Array.of(1, 0, 1, 0),
    position: Float64Array.of(1, 2, 3, 0, 0, 0, 4, 5, 6, 0, 0, 0),
    values: { lengths: Uint32Array.of(1, 0, 2, 0), items: Float64Array.of(9, 100, 1) },
  };
  const diagnostics = describeAll(arrays, nameByIndex);
  const indices = diagnostics.map(({ entities }) => entities.map(({ index }) => index));
  expect(diagnostics.map(({ code }) => code)).toEqual([
    "open-edge",
    "empty-model",
    "self-intersection",
    "duplicate-triangle",
  ]);
  expect(indices).toEqual([[7], [], [1, 2], [3, 4]]);
  expect(diagnostics.map(({ position }) => position)).toEqual([[1, 2, 3], undefined, [4, 5, 6], undefined]);
  expect(diagnostics.map(({ data }) => data)).toEqual([
    { count: 9 },
    {},
    { count: 100, isLowerBound: true },
    {},
  ]);
  expect(diagnostics.map(({ severity }) => severity)).toEqual(["error", "error", "error", "warning"]);
  expect(stepsOf(arrays)).toEqual([1, diagnostics]);
});

test("many diagnostics are decoded in short steps", () => {
  const count = 20_000;
  const [steps, diagnostics] = stepsOf({
    code: new Uint16Array(count).fill(12),
    severity: new Uint8Array(count).fill(2),
    entities: {
      lengths: new Uint32Array(count),
      items: { kind: new Uint8Array(), index: new Uint32Array() },
    },
    hasPosition: new Uint8Array(count),
    position: new Float64Array(3 * count),
    values: { lengths: new Uint32Array(count), items: new Float64Array() },
  });
  expect(diagnostics).toHaveLength(count);
  expect(steps).toBeGreaterThan(40);
});

/** Returns the number of steps and the diagnostics decoded in them. */
function stepsOf(arrays: DiagnosticArrays): [number, Diagnostic[]] {
  const work = describeInSteps(arrays, nameByIndex);
  for (let steps = 1; ; steps++) {
    const step = work.next();
    if (step.done === true) return [steps, step.value];
  }
}

test("labels of callers are inserted literally, whatever characters they contain", () => {
  const raw = { ...minimalOf("open-edge"), code: 40, entities: entitiesOf(5, 0) };
  const name = () => ({ kind: "triangle", index: 0, label: "part (1" }) as const;
  expect(describeDiagnostic(raw, name).message).toContain("part (1 (counted from 0)");
});

describe("messages about one item use the singular:", () => {
  test.each(Object.entries(ENGINE_CODES))("code %s, %s", (code) => {
    const values = Float64Array.of(1, 1, 1);
    for (const entities of [[], complete.entities.slice(0, 1), entitiesOf(5, 1)]) {
      const diagnostic = describeDiagnostic({ ...empty, code: Number(code), entities, values }, nameByIndex);
      const singular =
        /\b1 (points|lines|sides|triangles|faces|tetrahedra|places|regions|cavities|nodes|edges)\b/;
      expect(diagnostic.message).not.toMatch(singular);
      expect(diagnostic.remedy).not.toMatch(singular);
    }
  });
});

test("the remedy of flipped triangles mentions inner shells only if they lie between regions", () => {
  const remedy = (isBetweenRegions: number) =>
    describeDiagnostic(
      { ...empty, code: 50, entities: entitiesOf(5, 1), values: Float64Array.of(isBetweenRegions, 3) },
      nameByIndex,
    ).remedy;
  expect(remedy(1)).toMatch(/`repair: true`.*`innerShells: "regions"`/);
  expect(remedy(0)).toMatch(/`repairSurface\(\)`/);
  expect(remedy(0)).not.toMatch(/regions/);
});

test("a coordinate too large to compute with is not reported as not finite", () => {
  const messageOf = (value: number) =>
    describeDiagnostic(
      { ...empty, code: 0, entities: entitiesOf(0, 0), values: Float64Array.of(value) },
      nameByIndex,
    ).message;
  expect(messageOf(-1e200)).toMatch(/has the coordinate -1e\+200, whose magnitude/);
  expect(messageOf(NaN)).toMatch(/not a finite number$/);
});

test('intersecting pairs of triangles are counted, with "at least" if the count was stopped', () => {
  const messageOf = (...values: number[]) =>
    describeDiagnostic(
      { ...empty, code: 43, entities: entitiesOf(5, 3, 5, 8), values: Float64Array.from(values) },
      nameByIndex,
    ).message;
  expect(messageOf(1)).toMatch(/triangle 3 .*and triangle 8 intersect$/);
  expect(messageOf(1600)).toMatch(/intersect \(1600 pairs of triangles in all\)$/);
  expect(messageOf(100000, 1)).toMatch(/intersect \(at least 100000 pairs of triangles in all\)$/);
});

test("an estimate above the countable range is reported as such, without a factor", () => {
  const estimated = (estimate: number) =>
    describeDiagnostic({ ...empty, code: 25, values: Float64Array.of(estimate, 2e7) }, nameByIndex);
  expect(estimated(1.6e8).remedy).toBe("Use elements at least 2.0 times as large.");
  expect(estimated(1.6e8).message).toMatch(/require about 160000000 /);
  expect(estimated(1e15).remedy).toBe("Use far larger elements.");
  expect(estimated(1e15).message).toMatch(/require more than 1000000000000000 /);
});

test("too many elements name the source or background node that requires the most", () => {
  const messageOf = (kind: number) =>
    describeDiagnostic(
      { ...empty, code: 25, entities: entitiesOf(kind, 4), values: Float64Array.of(1.6e8, 2e7) },
      nameByIndex,
    ).message;
  expect(messageOf(ENTITY_KINDS.indexOf("source"))).toMatch(/, especially at source 4 /);
  expect(messageOf(ENTITY_KINDS.indexOf("background-node"))).toMatch(/, especially at background node 4 /);
});

test("a failed verification names an example of each kind of defect", () => {
  const [node, tetrahedron] = [ENTITY_KINDS.indexOf("node"), ENTITY_KINDS.indexOf("tetrahedron")];
  const messageOf = (...entities: number[]) =>
    describeDiagnostic(
      { ...empty, code: 61, entities: entitiesOf(...entities), values: Float64Array.of(3) },
      nameByIndex,
    ).message;
  expect(messageOf(node, 4, tetrahedron, 7)).toMatch(
    /^The finished mesh failed 3 checks of its verification, for example at node 4 .*and tetrahedron 7$/,
  );
  expect(messageOf()).toBe("The finished mesh failed 3 checks of its verification");
});

test("entities are named by the user's names, or else by their ids", () => {
  const cube = cubeProject();
  const lines = cube.lines.map((line) => (line.id === 3 ? { ...line, name: "lip" } : line));
  const diagnostic = describeDiagnostic(
    { ...empty, code: 7, entities: entitiesOf(2, 5, 1, 2), position: [1, 0.5, 1 / 3] },
    projectNamer({ ...cube, lines }),
  );
  expect(diagnostic.message).toBe(
    'A loop of patch "right" is not closed: the next line does not begin where line "lip" ends at (1, 0.5, 0.333333)',
  );
  expect(diagnostic.entities).toEqual([
    { kind: "patch", index: 5, id: 6, label: 'patch "right"' },
    { kind: "line", index: 2, id: 3, label: 'line "lip"' },
  ]);
  expect(projectNamer(cube)("line", 2).label).toBe("line 3");
});

test("an open edge of a given surface has another remedy than one of a drawing", () => {
  const about = (kind: number) =>
    describeDiagnostic({ ...minimalOf("open-edge"), code: 40, entities: entitiesOf(kind, 0) }, nameByIndex)
      .remedy;
  expect(about(ENTITY_KINDS.indexOf("triangle"))).toMatch(/triangles/);
  expect(about(ENTITY_KINDS.indexOf("line"))).toMatch(/patch/);
});

test("messages mention once that indices count from 0, and only if they use indices", () => {
  const messageOf = (code: number, entities: number[], name = nameByIndex) =>
    describeDiagnostic({ ...empty, code, entities: entitiesOf(...entities) }, name).message;
  const triangle = ENTITY_KINDS.indexOf("triangle");
  expect(messageOf(44, [triangle, 1, triangle, 12])).toBe(
    "Triangle 1 (counted from 0) and triangle 12 are duplicates",
  );
  const line = ENTITY_KINDS.indexOf("line");
  expect(messageOf(4, [line, 2], projectNamer(cubeProject()))).toBe("Line 3 has no length");
});
