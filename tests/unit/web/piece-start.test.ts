import { expect, it } from "vitest";
import type { Project } from "tetrafront/project";
import { emptyProject } from "../../../web/document/create";
import { startOf } from "../../../web/document/operations/start";
import type { Position } from "../../../web/document/position";

/** A project with one triangular patch. */
const patchOf = (...corners: readonly Position[]): Project => ({
  ...emptyProject("Test"),
  points: corners.map(([x, y, z], i) => ({ id: i + 1, position: [x, y, z] })),
  lines: [
    { id: 1, type: "straight", points: [1, 2] },
    { id: 2, type: "straight", points: [2, 3] },
    { id: 3, type: "straight", points: [3, 1] },
  ],
  patches: [{ id: 1, type: "planar", loops: [[1, 2, 3]] }],
});
const axisOn = (project: Project): readonly number[] => startOf(project, [{ kind: "patch", id: 1 }]).axis;

it("a piece on a patch in a principal plane points exactly along an axis", () => {
  for (const scale of [0.1, 0.3, 0.6, 0.7, 1.1]) {
    const axis = axisOn(patchOf([0, 0, 0], [scale, 0, 0], [scale, scale, 0]));
    expect([axis[0], axis[1], Math.abs(axis[2] ?? 0)]).toEqual([0, 0, 1]);
  }
});

it("a piece on any other patch is perpendicular to it", () => {
  const axis = axisOn(patchOf([0, 0, 0], [1, 0, 1e-6], [0, 1, 0]));
  expect(Math.hypot(...axis)).toBeCloseTo(1, 14);
  expect(Math.abs(axis[0] ?? 0)).toBeCloseTo(1e-6, 12);
});
