/** The note on bodies so thin that a single layer of good elements needs very many of them. */
import type { Mesher } from "tetrafront";
import { expect, test } from "vitest";

import { completeSurface } from "../../../wasm/src/api/carried-mesh.js";
import { emptyResult } from "../../../wasm/src/api/report.js";
import { filledSurface } from "../../../wasm/src/api/surface-meshing.js";
import { expectedThinNotes, thinBodyNotes } from "../../../wasm/src/api/thin-bodies.js";
import { withoutPause } from "../../../wasm/src/base/steps.js";
import { boxSurface } from "../../support/surfaces.js";

/** A plate of 120,000 triangles, 100 long and wide. */
const plate = (thickness: number) => {
  const { points, triangles } = boxSurface(100, [0, 0, 0], [100, 100, thickness]);
  return { mesh: completeSurface({ points, triangles }), volume: 1e4 * thickness };
};

test("a body that is far thinner than large, with very many triangles, is named with both lengths", () => {
  const [note] = withoutPause(thinBodyNotes(plate(0.1), {}));
  expect(note).toMatchObject({ code: "thin-body", severity: "information" });
  expect(note?.message).toContain("is about 0.1 thick and 140 large");
  expect(note?.message).toContain("takes 120000 triangles");
});

test("thicker bodies, and those whose sizes or layers are chosen, have no note", () => {
  expect(withoutPause(thinBodyNotes(plate(2), {}))).toEqual([]);
  for (const options of [{ size: 1 }, { layers: 1 }]) {
    expect(withoutPause(thinBodyNotes(plate(0.1), options))).toEqual([]);
  }
});

test("before the remeshing, the triangles of one layer are estimated from the thickness", () => {
  // Far from the origin, and of few triangles.
  const { points, triangles } = boxSurface(2, [5e3, 0, 0], [5.1e3, 100, 0.1]);
  const given = completeSurface({ points, triangles });
  const [note] = withoutPause(expectedThinNotes(given, {}));
  expect(note?.message).toContain("is about 0.1 thick and 140 large");
  // Two sides of 1e4, in triangles whose edges are about 4 times the thickness.
  const count = Number(/takes about (\d+) triangles/.exec(note?.message ?? "")?.[1]);
  expect(count).toBeGreaterThan(1.5e5);
  expect(count).toBeLessThan(4e5);
  expect(withoutPause(expectedThinNotes(given, { layers: 0 }))).toEqual([]);
  const thick = boxSurface(2, [0, 0, 0], [100, 100, 2]);
  expect(withoutPause(expectedThinNotes(completeSurface(thick), {}))).toEqual([]);
});

test("the note comes before the body is remeshed and filled, which takes long", async () => {
  const told: string[] = [];
  const { mesh, volume } = plate(0.1);
  const diagnostics = withoutPause(thinBodyNotes({ mesh, volume }, {}));
  const mesher = {
    remeshSurface: () => {
      told.push("remeshed");
      return Promise.resolve({ mesh, smallestAngle: 30, meanRadiusRatio: 1, diagnostics });
    },
    fillSurface: () => {
      told.push("filled");
      return Promise.resolve(emptyResult("cancelled"));
    },
  } as unknown as Mesher;
  const ready = { surface: mesh, treatment: { kind: "remesh" }, diagnostics: [] } as const;
  await filledSurface(mesher, mesh, ready, {
    options: {},
    controlOf: () => ({}),
    onTreated: (found) => told.push(...found.map(({ code }) => code)),
  });
  expect(told).toEqual(["thin-body", "remeshed", "thin-body", "filled"]);
});
