import { describe, expect, it } from "vitest";
import type { ProjectLine } from "tetrafront/project";
import type { LinePath } from "../../../web/document/line-paths";
import type { Position } from "../../../web/document/position";
import { crossingOf, middleOf, nearestToRay, snapToModel } from "../../../web/tools/drawing/snapping";
import type { PointerView } from "../../../web/viewer/pointer-view";
import {
  onPlane,
  planeThrough,
  planeOfSelection,
  principalPlane,
  roundStep,
  roundTo,
} from "../../../web/document/work-plane";
import { cubeProject } from "../../support/projects";

/** A view from above without perspective: 100 pixels per unit. */
function fromAbove(x: number, y: number): PointerView {
  return {
    pointer: { x: 100 * x, y: 100 * y },
    ray: { origin: [x, y, 10], direction: [0, 0, -1] },
    toScreen: ([px, py]) => ({ x: 100 * px, y: 100 * py }),
  };
}

const path = (id: number, ...positions: Position[]): LinePath => {
  const line: ProjectLine = { id, type: "straight", points: [2 * id, 2 * id + 1] };
  return { line, positions };
};

const points = [{ id: 7, position: [0, 0, 0] as Position }];
const lines = [
  path(1, [0, 0, 0], [4, 0, 1]),
  path(2, [1, -1, 0.25], [1, 1, 0.25]),
  path(3, [3, -1, 5], [3, 1, 5]),
];
const snap = (x: number, y: number) => snapToModel({ points, lines }, fromAbove(x, y));

describe("snapToModel", () => {
  it("prefers points, then intersections, middles and the nearest place on a line", () => {
    expect(snap(0.05, 0.05)).toEqual({ kind: "point", position: [0, 0, 0], id: 7 });
    expect(snap(1.05, 0.04)).toMatchObject({ kind: "intersection" });
    expect(snap(1.05, 0.04)?.position[2]).toBeCloseTo(0.25, 12);
    expect(snap(2.04, 0.05)).toEqual({ kind: "middle", position: [2, 0, 0.5], id: 1, lines: [1] });
    const on = snap(1.5, 0.04);
    expect(on).toMatchObject({ kind: "line", id: 1 });
    expect(on?.position[0]).toBeCloseTo(1.5, 12);
    expect(on?.position[2]).toBeCloseTo(0.375, 12);
  });

  it("finds no intersection where one line passes above another", () => {
    expect(snap(3.02, 0.6)?.kind).toBe("line");
    expect(snap(3.02, 0.02)?.kind).toBe("middle");
  });

  it("returns null away from everything", () => {
    expect(snap(2, 0.5)).toBeNull();
    expect(snapToModel({ points: [], lines: [] }, fromAbove(0, 0))).toBeNull();
  });

  it("projects each of many positions once", () => {
    const manyPoints = Array.from({ length: 2000 }, (_, id) => ({ id, position: [id, 1, 0] as Position }));
    const manyLines = manyPoints.map(({ id }) =>
      path(id, ...Array.from({ length: 40 }, (_, i): Position => [id + i / 40, 2, 0])),
    );
    const view = fromAbove(3.3, 1.5);
    let visited = 0;
    const counting = { ...view, toScreen: (position: Position) => (++visited, view.toScreen(position)) };
    snapToModel({ points: manyPoints, lines: manyLines }, counting);
    // Each position is projected once: no pair of lines is visited that is not near the pointer.
    expect(visited).toBeLessThanOrEqual(2000 + 2000 * 41);
  });
});

describe("places on lines", () => {
  it("crossingOf returns where segments cross in space", () => {
    expect(crossingOf([0, 0, 0], [2, 2, 2], [0, 2, 0], [2, 0, 2])).toEqual([1, 1, 1]);
    expect(crossingOf([0, 0, 0], [2, 0, 0], [0, 1, 0], [2, 1, 0])).toBeNull();
    expect(crossingOf([0, 0, 0], [1, 0, 0], [2, -1, 0], [2, 1, 0])).toBeNull();
  });

  it("middleOf halves the length, not the number of samples", () => {
    expect(middleOf([[0, 0, 0], [1, 0, 0], [4, 0, 0]])).toEqual([2, 0, 0]); // prettier-ignore
  });

  it("nearestToRay ends at the ends of the segment", () => {
    const ray = { origin: [5, 1, 10] as Position, direction: [0, 0, -1] as Position };
    expect(nearestToRay(ray, [0, 0, 0], [2, 0, 0])).toEqual([2, 0, 0]);
  });
});

describe("work planes", () => {
  it("are met by rays that are not parallel to them", () => {
    const ray = { origin: [1, 2, 10] as Position, direction: [0, 0, -2] as Position };
    expect(onPlane(ray, principalPlane("xy", [0, 0, 3]).frame)).toEqual([1, 2, 3]);
    expect(onPlane(ray, principalPlane("xz").frame)).toBeNull();
    expect(onPlane(ray, principalPlane("xy", [0, 0, 11]).frame)).toBeNull();
  });

  it("of three positions are parallel to the axes if possible, and have round coordinates then", () => {
    const plane = planeThrough([1.3, 0.7, 2], [2, 0, 2], [0, 5, 2]);
    expect(plane?.kind).toBe("xy");
    expect(plane?.frame.origin).toEqual([0, 0, 2]);
    expect(planeThrough([0, 0, 0], [1, 1, 1], [2, 2, 2])).toBeNull();
    expect(planeThrough([1, 0, 0], [0, 1, 0], [0, 0, 1])?.kind).toBe("free");
  });

  it("come from a point, three points or a planar patch", () => {
    const project = cubeProject();
    const plane = principalPlane("xy");
    const point = (id: number) => ({ kind: "point", id }) as const;
    const [a, b, c] = project.points;
    if (!a || !b || !c) throw new Error("The cube has no points");
    expect(planeOfSelection(project, [point(a.id)], plane)?.frame.origin).toEqual(a.position);
    expect(planeOfSelection(project, [point(a.id), point(b.id), point(c.id)], plane)).not.toBeNull();
    expect(planeOfSelection(project, [point(a.id), point(b.id)], plane)).toBeNull();
    const [patch] = project.patches;
    expect(planeOfSelection(project, [{ kind: "patch", id: patch?.id ?? 0 }], plane)?.kind).not.toBe("free");
  });

  it("have grids with round steps and coordinates", () => {
    expect([0.11, 0.2, 3, 70].map(roundStep)).toEqual([0.2, 0.2, 5, 100]);
    expect(roundTo(0.29999, 0.1)).toBe(0.3);
    expect(roundTo(-0.01, 0.05)).toBe(0);
    expect(roundTo(1234.4, 5)).toBe(1235);
  });
});
