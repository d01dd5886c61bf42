/** Texts of the command line whose numbers must agree with each other. */
import type { RepairChange } from "tetrafront";
import { describe, expect, test } from "vitest";

import { patchShapes } from "../../../wasm/src/cli/patch-shapes.js";
import { remeshText } from "../../../wasm/src/api/treatment-texts.js";
import { printChanges } from "../../../wasm/src/cli/repair.js";
import { angleText, anglesText, boxText } from "../../../wasm/src/cli/tables.js";

describe("angles as text", () => {
  test.each([
    [29.96, 135.04, "29.9° to 135.1°"],
    [30, 135, "30.0° to 135.0°"],
    [30.04, 134.96, "30.0° to 135.0°"],
  ])("never hide that %f or %f is out of range", (min, max, text) => {
    expect(anglesText({ min, max }, 1)).toBe(text);
  });

  test("have the digits asked for", () => {
    expect(angleText(12.3456, 2, Math.floor)).toBe("12.34°");
    expect(angleText(12, 2, Math.ceil)).toBe("12.00°");
  });
});

describe("boxes as text", () => {
  const whole = { low: [0, 0, 400], high: [30, 40, 404] };

  test("print rounding errors as 0", () => {
    const box = { low: [-3e-14, 8.9e-15, 0], high: [254, 254, 6.35] };
    expect(boxText(box)).toBe("box (0, 0, 0) to (254, 254, 6.35)");
    expect(boxText({ low: [0, 0, 0], high: [1e-14, 2e-14, 3e-14] })).toBe(
      "box (0, 0, 0) to (1e-14, 2e-14, 3e-14)",
    );
  });

  test("do not have more digits for a flat patch than for the mesh around it needs", () => {
    const box = { low: [1, 2, 400.066924817], high: [3, 4, 400.067017289] };
    expect(boxText(box, whole)).toBe("box (1, 2, 400.06692) to (3, 4, 400.06702)");
    expect(boxText(box)).toContain("400.066924817");
  });
});

describe("shapes of patches", () => {
  test("have their area, and a normal if they are flat", () => {
    const points = Float64Array.of(0, 0, 0, 2, 0, 0, 2, 2, 0, 0, 2, 0, 0, 0, 2);
    const group = (tag: number) => ({ name: `patch ${tag}`, tag });
    const shapes = patchShapes({
      points,
      // A square that faces down, and a bent patch of two triangles.
      triangles: Uint32Array.of(0, 2, 1, 0, 3, 2, 0, 1, 4, 0, 4, 3),
      trianglePatch: Uint32Array.of(0, 0, 1, 1),
      patches: [group(1), group(2), group(3)],
    });
    expect(shapes).toEqual([
      { area: 4, normal: [0, 0, -1] },
      { area: 4, normal: null },
      { area: 0, normal: null },
    ]);
  });
});

describe("a remeshing as text", () => {
  const textOf = (
    details: number,
    whole: string,
    failedFaces: readonly number[] = [],
    onFaces = false,
  ): string =>
    remeshText(
      {
        ...{ given: 12, triangles: 40, size: 1, minSize: 0.1, tolerance: 0.01, deviation: 0.02 },
        ...{ givenVolume: 1, volume: 1 },
        ...{ patches: 6, featureLines: 12, smallestAngle: 30, meanRadiusRatio: 0.9 },
        ...{ onFaces, failedFaces, isPartial: false },
        mergedDetails: Array.from({ length: details }, (_, i) => ({ from: [i, 0, 0], onto: [i, 0.5, 0] })),
      },
      whole,
    );

  test("names both positions of the first dropped details, and the option that lists all", () => {
    const text = textOf(7, "--json");
    expect(text).toContain("7 details dropped: (0, 0, 0) onto (0, 0.5, 0), (1, 0, 0) onto (1, 0.5, 0)");
    expect(text).toContain("(4, 0, 0) onto (4, 0.5, 0), and 2 more (--json lists all 7)");
    expect(text).not.toContain("(5, 0, 0)");
    expect(textOf(6, "--report FILE")).toContain(", and 1 more (--report FILE lists all 6)");
  });

  test("names the faces that cannot be triangulated", () => {
    const reasonFor = (failedFaces: readonly number[]) => textOf(0, "", failedFaces).split("; ")[0];
    const before = "remeshed: 12 triangles before, 40 after, by changing the given triangles, because ";
    expect(reasonFor([3])).toBe(`${before}face 4 cannot be triangulated on its surface`);
    expect(reasonFor([3, 6])).toBe(`${before}face 4 and face 7 cannot be triangulated on their surfaces`);
    expect(reasonFor([0, 1, 2, 3, 4])).toContain("face 1, face 2, face 3, face 4 and face 5 cannot");
    expect(reasonFor([0, 1, 2, 3, 4, 5, 6])).toContain("face 4, face 5 and 2 more cannot");
    expect(textOf(0, "", [3], true).split("; ")[0]).toBe(
      "remeshed: 12 triangles before, 40 after, on the surfaces of the faces, except face 4, which cannot be triangulated on its surface: there, the given triangles were changed",
    );
  });

  test("names all of a few dropped details", () => {
    const text = textOf(5, "--json");
    expect(text).toContain("(4, 0, 0) onto (4, 0.5, 0)");
    expect(text).not.toContain("more");
    expect(textOf(0, "--json")).not.toContain("dropped");
  });
});

test("changes of a repair are one line per kind, with a count and a few examples", () => {
  const cut = (triangle: number, parts: number): RepairChange => ({
    kind: "resolved-intersection",
    triangle,
    parts,
    position: [triangle, 0, 0],
  });
  const changes: RepairChange[] = [
    ...[4, 5, 6, 7].map((triangle) => cut(triangle, 3)),
    cut(9, 0),
    { kind: "welded-node", node: 3, into: 1, position: [1, 2, 3] },
  ];
  const lines: string[] = [];
  printChanges("a.stl", { changes, repairDeviation: 0.5 }, (line) => lines.push(line));
  expect(lines).toEqual([
    "repair: a.stl: cut 4 triangles, which intersected others; 12 parts of them remain: triangle 4 at (4, 0, 0), triangle 5 at (5, 0, 0), triangle 6 at (6, 0, 0) and 1 more.",
    "repair: a.stl: removed 1 triangle, which intersected others and is inside, or encloses nothing: triangle 9 at (9, 0, 0).",
    "repair: a.stl: welded 1 node to another: node 3 to node 1 at (1, 2, 3).",
    "repair: a.stl: 6 changes; nodes were moved by at most 0.5.",
  ]);
});
