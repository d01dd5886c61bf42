import { describe, expect, it } from "vitest";
import { parseProject, type Project } from "tetrafront/project";
import {
  addPoint,
  addSource,
  offerHole,
  offerLine,
  offerPatch,
  offerTetrahedron,
} from "../../../web/document/create";
import type { Entity } from "../../../web/document/entities";
import { orderLoops, rotateToSecond } from "../../../web/document/loops";
import { pointsForType } from "../../../web/document/line-types";
import { likelyPatchType, patchMisfit } from "../../../web/document/patch-rules";
import { DocumentStore } from "../../../web/session/document-store";
import { cubeProject } from "../../support/projects";

const lines = (...ids: number[]): Entity[] => ids.map((id) => ({ kind: "line", id }));

/** Returns whether the steps of a loop are connected and the loop is closed. */
function isClosed(project: Project, loop: readonly number[]): boolean {
  const ends = loop.map((step) => {
    const points = project.lines.find(({ id }) => id === Math.abs(step))?.points ?? [];
    const forward = [points.at(0), points.at(-1)];
    return step > 0 ? forward : forward.reverse();
  });
  return ends.every(([, end], i) => end === ends[(i + 1) % ends.length]?.[0]);
}

/**
 * Two square rims as lines 2 and 3, drawn in the positive (1) or negative (-1) direction, and line 1 between them.
 */
function tubeLines(rims: readonly [number, number], seam: readonly [number, number]): Project {
  const corners = [0, 1].flatMap(
    (z) =>
      [
        [1, 0, z],
        [0, 1, z],
        [-1, 0, z],
        [0, -1, z],
      ] as const,
  );
  const rim = (first: number, turn: number) => {
    const around = [first + 1, first + 2, first + 3];
    return [first, ...(turn > 0 ? around : around.reverse()), first];
  };
  return {
    ...cubeProject(),
    points: corners.map((position, i) => ({ id: i + 1, position: [...position] })),
    lines: [
      { id: 1, type: "straight", points: [...seam] },
      { id: 2, type: "spline", points: rim(1, rims[0]) },
      { id: 3, type: "spline", points: rim(5, rims[1]) },
    ],
    patches: [],
  };
}

describe("orderLoops", () => {
  const project = cubeProject();
  const loops = project.patches.map((patch) => patch.loops[0] ?? []);

  it("closes the lines of every face, in whatever order they are given", () => {
    for (const loop of loops) {
      for (let turn = 0; turn < loop.length; ++turn) {
        const mixed = [...loop.slice(turn), ...loop.slice(0, turn)].map(Math.abs).reverse();
        const found = orderLoops(project, mixed);
        if (!found.success) throw new Error(found.reason);
        expect(found.loops).toHaveLength(1);
        expect(found.loops[0]?.[0]).toBe(mixed[0]);
        expect(isClosed(project, found.loops[0] ?? [])).toBe(true);
        expect(found.loops[0]?.map(Math.abs).sort()).toEqual(mixed.toSorted());
      }
    }
  });

  it("finds several loops, and reports where lines do not close", () => {
    const [first = [], ...others] = loops;
    const opposite = others.find((loop) =>
      loop.every((step) => !first.map(Math.abs).includes(Math.abs(step))),
    );
    const both = orderLoops(project, [...first, ...(opposite ?? [])].map(Math.abs));
    expect(both.success && both.loops.map((loop) => loop.length)).toEqual([4, 4]);
    const open = orderLoops(project, first.slice(1).map(Math.abs));
    expect(!open.success && open.reason).toMatch(/ends at point \d/);
    const crowded = orderLoops(
      project,
      project.lines.map(({ id }) => id),
    );
    expect(!crowded.success && crowded.reason).toMatch(/^3 of the lines end at point \d/);
  });

  it("connects the rims of a tube and its seam to one loop, whatever their directions", () => {
    for (const [rims, seam] of [
      [
        [1, 1],
        [1, 5],
      ],
      [
        [1, -1],
        [5, 1],
      ],
      [
        [-1, 1],
        [1, 5],
      ],
    ] as const) {
      const tube = tubeLines(rims, seam);
      const found = orderLoops(tube, [2, 3, 1]);
      if (!found.success) throw new Error(found.reason);
      const [loop = []] = found.loops;
      expect(found.loops).toHaveLength(1);
      expect(isClosed(tube, loop)).toBe(true);
      expect(loop.filter((step) => Math.abs(step) === 3)).toHaveLength(1);
      expect(loop.filter((step) => Math.abs(step) === 2)).toHaveLength(1);
      expect(loop.filter((step) => Math.abs(step) === 1).sort()).toEqual([-1, 1]);
      // The loop follows the rims in opposite directions, whatever their own.
      const turns = loop
        .filter((step) => Math.abs(step) > 1)
        .map((step) => Math.sign(step) * (rims[Math.abs(step) - 2] ?? 0));
      expect(turns[0]).toBe(-(turns[1] ?? 0));
    }
  });

  it("rotates a loop so that any of its lines becomes the second", () => {
    const loop = [4, -7, 9];
    for (const position of [0, 1, 2]) {
      const turned = rotateToSecond(loop, position);
      expect(turned[1]).toBe(loop[position]);
      expect([...turned, ...turned].join()).toContain(loop.join());
    }
  });
});

describe("creations", () => {
  const project = cubeProject();

  it("use new ids, leave a valid project, and can be undone", () => {
    const point = addPoint(project, [5, 6, 7]);
    const ids = project.points.map(({ id }) => id);
    const documents = new DocumentStore(project, () => 0);
    documents.edit(point.edit);
    expect(ids).not.toContain(point.entities[0]?.id);
    for (const type of ["point", "segment", "triangle"] as const) {
      documents.edit(addSource(documents.project, [], type).edit);
    }
    expect(parseProject(documents.project).success).toBe(true);
    expect(documents.project.background.sources?.map(({ id, positions }) => [id, positions.length])).toEqual([
      [1, 1],
      [2, 2],
      [3, 3],
    ]);
    for (let i = 0; i < 4; ++i) documents.undo();
    expect(documents.project).toEqual(project);
  });

  it("use the points in the order of the selection", () => {
    const points: Entity[] = [5, 2, 7, 1].map((id) => ({ kind: "point", id }));
    const chain = offerLine(project, points, "straight");
    const spline = offerLine(project, points, "spline");
    if (!chain.possible || !spline.possible) throw new Error("refused");
    const documents = new DocumentStore(project, () => 0);
    documents.edit(chain.creation.edit);
    expect(documents.project.lines.slice(-3).map((line) => line.points)).toEqual([[5, 2], [2, 7], [7, 1]]); // prettier-ignore
    documents.undo();
    documents.edit(spline.creation.edit);
    expect(documents.project.lines.at(-1)).toMatchObject({ type: "spline", points: [5, 2, 7, 1] });
    expect(offerLine(project, points, "parabolic").possible).toBe(false);
  });

  it("make a spline through three points, and through more", () => {
    for (const ids of [
      [5, 2, 7],
      [5, 2, 7, 1, 3],
    ]) {
      const points = ids.map((id): Entity => ({ kind: "point", id }));
      const offered = offerLine(project, points, "spline");
      if (!offered.possible) throw new Error(offered.reason);
      const documents = new DocumentStore(project, () => 0);
      documents.edit(offered.creation.edit);
      expect(documents.project.lines.at(-1)).toMatchObject({ type: "spline", points: ids });
    }
    expect(offerLine(project, [5, 2].map((id): Entity => ({ kind: "point", id })), "spline").possible).toBe(false); // prettier-ignore
  });

  it("make arcs and circles through three points", () => {
    const points: Entity[] = [5, 2, 7].map((id) => ({ kind: "point", id }));
    const documents = new DocumentStore(project, () => 0);
    for (const type of ["arc", "circle"] as const) {
      const found = offerLine(project, points, type);
      if (!found.possible) throw new Error(found.reason);
      documents.edit(found.creation.edit);
      expect(offerLine(project, points.slice(1), type).possible).toBe(false);
    }
    expect(documents.project.lines.slice(-2).map(({ type, points: ids }) => [type, ids])).toEqual([
      ["arc", [5, 2, 7]],
      ["circle", [5, 2, 7, 5]],
    ]);
  });

  it("join two loops that are not in one plane by a tube, without a line between them", () => {
    const tube = tubeLines([1, -1], [1, 5]);
    const found = offerPatch(tube, lines(2, 3), null);
    if (!found.possible) throw new Error(found.reason);
    const documents = new DocumentStore(tube, () => 0);
    documents.edit(found.creation.edit);
    expect(documents.project.patches).toEqual([{ id: 1, type: "tube", loops: [[2], [3]] }]);
    const single = offerPatch(tube, lines(2), "tube");
    expect(!single.possible && single.reason).toBe("Needs two loops; found 1 loop.");
    const hole = offerHole(documents.project, [...lines(2), { kind: "patch", id: 1 }]);
    expect(!hole.possible && hole.reason).toBe("Needs two loops; found 3 loops.");
  });

  it("keep a valid number of points when the type of a line changes", () => {
    const ring = [4, 2, 6];
    expect(pointsForType(ring, "arc", "circle")).toEqual([4, 2, 6, 4]);
    expect(pointsForType([4, 2, 6, 4], "circle", "arc")).toEqual(ring);
    expect(pointsForType([4, 2, 6, 4], "circle", "spline")).toEqual([4, 2, 6, 4]);
    expect(pointsForType([4, 2, 6, 4], "spline", "circle")).toEqual([4, 2, 6, 4]);
    expect(pointsForType([4, 2], "straight", "circle")).toEqual([4, 2]);
    // A line has at least two points.
    expect(pointsForType([4, 4], "circle", "arc")).toEqual([4, 4]);
  });

  it("state why they are impossible", () => {
    const face = project.patches[0]?.loops[0]?.map(Math.abs) ?? [];
    const triangle = offerPatch(project, lines(...face), "barnhill-gregory-nielson");
    expect(!triangle.possible && triangle.reason).toBe("Needs three lines; found 4 lines.");
    const curved = offerPatch(project, lines(...face), "serendipity");
    expect(!curved.possible && curved.reason).toMatch(/^Needs parabolic lines; line \d+ has another type\.$/);
    expect(offerPatch(project, lines(...face), null).possible).toBe(true);
    expect(offerHole(project, lines(...face)).possible).toBe(false);
    const nodes: Entity[] = project.background.nodes
      .slice(0, 4)
      .map(({ id }) => ({ kind: "background-node", id }));
    expect(offerTetrahedron(project, nodes.slice(1)).possible).toBe(false);
  });

  it("choose the type of a patch by its shape", () => {
    const [loop = []] = project.patches[0]?.loops ?? [];
    expect(likelyPatchType(project, [loop])).toBe("planar");
    const bent = {
      ...project,
      points: project.points.map((point, i) =>
        i === 0 ? { ...point, position: [-0.3, -0.2, -0.1] as const } : point,
      ),
    };
    const corner = project.points[0]?.id ?? 0;
    const touching = bent.patches.find(({ loops }) =>
      loops
        .flat()
        .some((step) => bent.lines.find(({ id }) => id === Math.abs(step))?.points.includes(corner)),
    );
    const moved: Project = {
      ...bent,
      points: bent.points.map((p) => ({ ...p, position: [p.position[0], p.position[1], p.position[2]] })),
    };
    expect(likelyPatchType(moved, touching?.loops ?? [])).toBe("coons");
    expect(patchMisfit(moved, "coons", touching?.loops ?? [])).toBeNull();
  });
});
