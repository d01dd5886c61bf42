import type { ProjectPreview } from "tetrafront/project";
import { describe, expect, it } from "vitest";
import { emptyProject } from "../../../web/document/create";
import { areAlike, Bounds, boundsOf, shownBounds } from "../../../web/viewer/bounds";

const cube = boundsOf([0, 0, 0, 1, 1, 1]);

describe("areAlike", () => {
  it("holds for a body and the points that its curved lines leave a little", () => {
    expect(areAlike(cube, boundsOf([-0.05, 0, 0, 1, 1.05, 1]))).toBe(true);
  });

  it.each([
    ["moved", [1, 0, 0, 2, 1, 1]],
    ["larger", [0, 0, 0, 1.5, 1, 1]],
    ["smaller", [0.4, 0.4, 0.4, 0.6, 0.6, 0.6]],
  ])("does not hold for a box that is %s, in either order", (_, corners) => {
    const other = boundsOf(corners);
    expect(areAlike(cube, other)).toBe(false);
    expect(areAlike(other, cube)).toBe(false);
  });

  it("holds for an empty box and another empty one only", () => {
    expect(areAlike(new Bounds(), new Bounds())).toBe(true);
    expect(areAlike(new Bounds(), cube)).toBe(false);
    expect(areAlike(cube, new Bounds())).toBe(false);
  });
});

describe("shownBounds", () => {
  const points = [0, 1].map((id) => ({ id: id + 1, position: [id, 0, 0] as const }));
  const nodes = [
    { id: 1, position: [0, 9, 0] as const, size: 1, stretching: 1, direction: [1, 0, 0] as const },
  ];
  const empty = emptyProject();
  const project = { ...empty, points, background: { ...empty.background, nodes } };
  const samples = {
    linePoints: Float64Array.of(0, -2, 0),
    patchPoints: Float64Array.of(0, 0, 3),
  } as unknown as ProjectPreview;
  const shown = { project, preview: { samples, project }, bodies: [], layers: { background: false } };

  it("include sampled lines and patches, and the background grid if it is shown", () => {
    expect(shownBounds(shown)).toEqual(boundsOf([0, -2, 0, 1, 0, 3]));
    expect(shownBounds({ ...shown, layers: { background: true } }).high).toEqual([1, 9, 3]);
  });

  it("do not include samples of another state", () => {
    const other = { ...project, points: points.slice() };
    expect(shownBounds({ ...shown, project: other }).low).toEqual([0, 0, 0]);
  });
});
