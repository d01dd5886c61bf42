import { createMesher, LIMITS, type Mesher } from "tetrafront";
import { type LineType, parseProject, type Project } from "tetrafront/project";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { emptyProject } from "../../../web/document/create";
import { drawLine, placeAt, placeOnLines } from "../../../web/document/draw";
import { keepingExpression } from "../../../web/document/expression-edits";
import { linePaths, type LinePath } from "../../../web/document/line-paths";
import { firstLoop } from "../../../web/document/loop-hits";
import { addParameter, setParameter } from "../../../web/document/parameters";
import type { Position } from "../../../web/document/position";
import { quickFixOf } from "../../../web/document/quick-fixes";
import { cutsAtCrossings } from "../../../web/document/splits/line-crossings";
import { lineCurve, nearestParameter } from "../../../web/document/splits/line-curve";
import { fillableLoops, offerFill } from "../../../web/document/splits/loops-across";
import { offerLineSplit, splitLine } from "../../../web/document/splits/split-line";
import type { Problem } from "../../../web/document/validate";
import { distance } from "../../../web/document/vectors";
import { DocumentStore } from "../../../web/session/document-store";
import { cubeProject } from "../../support/projects";

let mesher: Mesher;
beforeAll(async () => void (mesher = await createMesher()));
afterAll(() => mesher.dispose());

/** A project with lines through points: each line lists indices of positions. */
function projectWith(
  positions: readonly Position[],
  lines: readonly (readonly [LineType, readonly number[]])[],
): Project {
  return {
    ...emptyProject(),
    meshing: { size: 0.5 },
    points: positions.map(([x, y, z], i) => ({ id: i + 1, position: [x, y, z] })),
    lines: lines.map(([type, points], i) => ({ id: i + 1, type, points: points.map((index) => index + 1) })),
  };
}

/** The courses of all lines, as the engine samples them. */
async function pathsOf(project: Project): Promise<readonly LinePath[]> {
  return linePaths(project, { project, samples: await mesher.previewProject(project) });
}

/** Largest distance of positions from a polyline. */
function deviation(positions: readonly Position[], course: readonly Position[]): number {
  const fromSide = (p: Position, a: Position, b: Position): number => {
    const [ux, uy, uz] = [b[0] - a[0], b[1] - a[1], b[2] - a[2]];
    const along = (p[0] - a[0]) * ux + (p[1] - a[1]) * uy + (p[2] - a[2]) * uz;
    const square = ux * ux + uy * uy + uz * uz;
    const share = square === 0 ? 0 : Math.min(1, Math.max(0, along / square));
    return distance(p, [a[0] + share * ux, a[1] + share * uy, a[2] + share * uz]);
  };
  return Math.max(
    ...positions.map((p) => Math.min(...course.slice(1).map((b, i) => fromSide(p, course[i] ?? b, b)))),
  );
}

const wave: readonly Position[] = [
  [0, 0, 0],
  [1, 1, 0.2],
  [2, -0.5, 0],
  [3, 0.3, 1],
  [4, 0, 0],
];

const kinds: readonly (readonly [string, LineType, readonly Position[], readonly number[], number])[] = [
  ["straight line", "straight", [[0, 0, 0], [1, 2, 3]], [0, 1], 1e-14],
  ["arc", "arc", [[1, 0, 0], [0, 1, 0], [-1, 0, 0]], [0, 1, 2], 1e-13],
  ["circle", "circle", [[1, 0, 2], [0, 1, 2], [-1, 0, 2]], [0, 1, 2, 0], 1e-13],
  ["parabola", "parabolic", [[0, 0, 0], [1, 1, 0], [3, 0, 1]], [0, 1, 2], 1e-13],
  ["spline", "spline", wave, [0, 1, 2, 3, 4], 3e-3],
  ["closed spline", "spline", wave, [0, 1, 2, 3, 4, 0], 5e-3],
]; // prettier-ignore

describe("splitting a line", () => {
  it.each(kinds)("the curve of a %s is that of the engine", async (_, type, positions, points) => {
    const project = projectWith(positions, [[type, points]]);
    const curve = lineCurve(
      type,
      points.map((index) => positions[index] ?? [0, 0, 0]),
    );
    if (!curve) throw new Error("no curve");
    const [path] = await pathsOf(project);
    for (const position of path?.positions ?? []) {
      expect(distance(curve.at(nearestParameter(curve, position)), position)).toBeLessThan(1e-9);
    }
  });

  it.each(kinds)("keeps the course of a %s", async (_, type, positions, points, tolerance) => {
    const project = projectWith(positions, [[type, points]]);
    const curve = lineCurve(
      type,
      points.map((index) => positions[index] ?? [0, 0, 0]),
    );
    if (!curve) throw new Error("no curve");
    for (const t of [0.07, 0.25, 0.5, 0.61, 0.9]) {
      const split = splitLine(project, { line: 1, position: curve.at(t) });
      if (!split.success) throw new Error(split.reason);
      expect(split.project.lines).toHaveLength(2);
      const used = new Set(split.project.lines.flatMap((line) => line.points));
      expect(split.project.points.filter(({ id }) => !used.has(id))).toEqual([]);
      const [first, second] = split.project.lines;
      expect([first?.points[0], second?.points.at(-1)]).toEqual([1, (points.at(-1) ?? 0) + 1]);
      expect([first?.points.at(-1), second?.points[0]]).toEqual([split.point, split.point]);
      for (const line of split.project.lines) {
        const byId = new Map(split.project.points.map((point) => [point.id, point.position]));
        const part = lineCurve(
          line.type,
          line.points.map((id) => byId.get(id) ?? [NaN, 0, 0]),
        );
        if (!part) throw new Error("no part");
        for (let k = 0; k <= 200; ++k) {
          const position = part.at(k / 200);
          const on = curve.at(nearestParameter(curve, position));
          expect(distance(on, position)).toBeLessThan(tolerance);
        }
      }
      const [whole, parts] = [await pathsOf(project), await pathsOf(split.project)];
      const missed = deviation(
        whole[0]?.positions ?? [],
        parts.flatMap(({ positions: course }) => course),
      );
      expect(missed).toBeLessThan(0.04);
    }
  });

  it("gives both parts to loops and groups, and is one step of undo", () => {
    const cube = {
      ...cubeProject(),
      groups: [{ id: 1, name: "edge", members: [{ kind: "line" as const, id: 1 }] }],
    };
    const offer = offerLineSplit(cube, [{ kind: "line", id: 1 }], null);
    if (!offer.possible) throw new Error(offer.reason);
    const documents = new DocumentStore(cube, () => 0);
    documents.edit(offer.creation.edit);
    const { project } = documents;
    const steps = project.patches
      .flatMap(({ loops }) => loops.flat())
      .filter((step) => [1, 13].includes(Math.abs(step)));
    expect(steps).toHaveLength(4);
    expect(project.patches.flatMap(({ loops }) => loops.map((loop) => loop.length)).toSorted()).toEqual([
      4, 4, 4, 4, 5, 5,
    ]);
    for (const { loops } of project.patches) {
      for (const loop of loops) {
        const ends = loop.map((step) => {
          const points = project.lines.find(({ id }) => id === Math.abs(step))?.points ?? [];
          return step > 0 ? points : points.toReversed();
        });
        ends.forEach((points, i) => expect(points.at(-1)).toBe(ends[(i + 1) % ends.length]?.[0]));
      }
    }
    expect(project.groups?.[0]?.members.map(({ id }) => id)).toEqual([1, 13]);
    documents.undo();
    expect(documents.project).toEqual(cube);
  });

  it("is refused at an end, for patches that need their lines, and beside the line", () => {
    const cube = cubeProject();
    const coons: Project = { ...cube, patches: cube.patches.map((patch) => ({ ...patch, type: "coons" })) };
    expect(splitLine(cube, { line: 1, position: [0, 0, 0] })).toMatchObject({ success: false });
    const refused = offerLineSplit(coons, [{ kind: "line", id: 1 }], null);
    expect(refused).toMatchObject({ possible: false });
    expect(!refused.possible && refused.reason).toContain("four lines");
    const away = [{ kind: "line", id: 1 }, { kind: "point", id: 8 }] as const; // prettier-ignore
    expect(offerLineSplit(cube, away, null)).toMatchObject({ possible: false });
    expect(offerLineSplit(cube, [], null)).toMatchObject({ possible: false });
  });

  it("keeps the new point on a line that follows a parameter", () => {
    const documents = new DocumentStore(projectWith([[0, 0, 0], [2, 0, 0]], [["straight", [0, 1]]]), () => 0); // prettier-ignore
    documents.edit(addParameter("r", "2"));
    const x = { kind: "point", id: 2, field: "position.0" } as const;
    documents.edit(keepingExpression({ label: "", change: () => undefined }, x, "r"));
    const offer = offerLineSplit(documents.project, [{ kind: "line", id: 1 }], [0.5, 0, 0]);
    if (!offer.possible) throw new Error(offer.reason);
    documents.edit(offer.creation.edit);
    documents.edit(setParameter("r", "4"));
    expect(documents.project.points.map(({ position }) => position[0])).toEqual([0, 4, 1]);
  });
});

/** A project with a line from the origin to a point whose x is an expression in r, which is 2. */
function following(expression: string): DocumentStore {
  const documents = new DocumentStore(projectWith([[0, 0, 0], [2, 0, 0]], [["straight", [0, 1]]]), () => 0); // prettier-ignore
  documents.edit(addParameter("r", "2"));
  const x = { kind: "point", id: 2, field: "position.0" } as const;
  documents.edit(keepingExpression({ label: "", change: () => undefined }, x, expression));
  return documents;
}

/** Splits the last part of the line in its middle, again and again. */
function splitOften(documents: DocumentStore, times: number): void {
  for (let count = 0; count < times; ++count) {
    const id = documents.project.lines.at(-1)?.id ?? 0;
    const offer = offerLineSplit(documents.project, [{ kind: "line", id }], null);
    if (!offer.possible) throw new Error(offer.reason);
    documents.edit(offer.creation.edit);
  }
}

describe("expressions of the points of a line that is split", () => {
  it("follow the parameter after many splits, and the file can be read", () => {
    const documents = following("r");
    splitOften(documents, 10);
    expect(parseProject(documents.project).success).toBe(true);
    documents.edit(setParameter("r", "4"));
    const xs = documents.project.points.map(({ position }) => position[0]);
    expect(xs).toHaveLength(12);
    xs.slice(2).forEach((x, i) => expect(x).toBeCloseTo(4 * (1 - 0.5 ** (i + 1)), 12));
  });

  it("are none if they would be too long for the file", () => {
    const documents = following(`r${"+0".repeat(LIMITS.expression / 2 - 1)}`);
    splitOften(documents, 2);
    expect(parseProject(documents.project).success).toBe(true);
    expect(documents.project.expressions).toHaveLength(1);
  });

  it("give some to the end of a line that is drawn onto it", () => {
    const documents = following("r");
    const { project } = documents;
    const { creation } = drawLine(project, "straight", [placeOnLines(project, [1], [1, 0, 0]), placeAt(project, [1, 1, 0])]); // prettier-ignore
    if (!creation) throw new Error("no line");
    documents.edit(creation.edit);
    documents.edit(setParameter("r", "4"));
    expect(documents.project.points.map(({ position }) => position)).toEqual([[0, 0, 0], [4, 0, 0], [2, 0, 0], [1, 1, 0]]); // prettier-ignore
  });
});

const square: readonly Position[] = [[0, 0, 0], [2, 0, 0], [2, 2, 0], [0, 2, 0]]; // prettier-ignore
const sides = [[0, 1], [1, 2], [2, 3], [3, 0]].map((ends) => ["straight", ends] as const); // prettier-ignore

/** Fills the loop under a vertical ray. */
async function filledAt(project: Project, x: number, y: number): Promise<Project> {
  const loops = fillableLoops(project, await pathsOf(project));
  const found = firstLoop(loops.uses.map(({ loop }) => loop), { origin: [x, y, 5], direction: [0, 0, -1] }); // prettier-ignore
  const use = loops.uses.find(({ loop }) => loop === found);
  if (!use) throw new Error("no loop");
  const offer = offerFill(project, loops, use);
  if (!offer.possible) throw new Error(offer.reason);
  const documents = new DocumentStore(project, () => 0);
  documents.edit(offer.creation.edit);
  const filled = documents.project;
  documents.undo();
  expect(documents.project).toEqual(project);
  return filled;
}

it("the course of a line begins at its first point, whichever way the engine samples it", async () => {
  const arc: readonly Position[] = [[0, 0, 0], [1, 1, 0], [2, 0, 0]]; // prettier-ignore
  for (const points of [
    [0, 1, 2],
    [2, 1, 0],
  ]) {
    const [path] = await pathsOf(projectWith(arc, [["arc", points]]));
    expect(path?.positions.length).toBeGreaterThan(3);
    expect(path?.positions[0]).toEqual(arc[points[0] ?? 0]);
    expect(path?.positions.at(-1)).toEqual(arc[points[2] ?? 0]);
  }
});

describe("lines that end on others or cross them", () => {
  it("a line across a square bounds two loops", async () => {
    const project = projectWith([...square, [1, 0, 0], [1, 2, 0]], [...sides, ["straight", [4, 5]]]);
    const left = await filledAt(project, 0.5, 1);
    expect(left.lines).toHaveLength(7);
    expect(left.patches.map(({ type, loops }) => [type, loops[0]?.length])).toEqual([["planar", 4]]);
    const both = await filledAt(left, 1.5, 1);
    expect(both.lines).toHaveLength(7);
    expect(both.patches).toHaveLength(2);
    expect(
      (await mesher.previewProject(both)).diagnostics.filter(({ code }) => code !== "open-edge"),
    ).toEqual([]);
  });

  it("two diagonals and a circle divide each other", async () => {
    const project = projectWith(
      [...square, [1.5, 1, 0], [1, 1.5, 0], [0.5, 1, 0]],
      [...sides, ["straight", [0, 2]], ["straight", [1, 3]], ["circle", [4, 5, 6, 4]]],
    );
    const inside = await filledAt(project, 1, 1.2);
    expect(inside.patches.map(({ loops }) => loops.map((loop) => loop.length))).toEqual([[3]]);
    const outside = await filledAt(inside, 1, 1.8);
    expect(outside.patches.map(({ loops }) => loops[0]?.length)).toEqual([3, 4]);
    const { diagnostics } = await mesher.previewProject(outside);
    expect(diagnostics.filter(({ severity, code }) => severity === "error" && code !== "open-edge")).toEqual(
      [],
    );
    // Lines that bound none of the filled loops stay whole.
    expect(outside.lines.filter(({ id }) => id <= 4).every(({ points }) => points.length === 2)).toBe(true);
  });

  it("a line through the seam of a circle bounds half a disc", async () => {
    const project = projectWith(
      [[-2, 0, 0], [2, 0, 0], [1, 0, 0], [0, 1, 0], [-0.6, -0.8, 0]],
      [["straight", [0, 1]], ["circle", [2, 3, 4, 2]]],
    ); // prettier-ignore
    const half = await filledAt(project, 0, 0.5);
    const both = await filledAt(half, 0, -0.5);
    const typeOf = (step: number) => both.lines.find(({ id }) => id === Math.abs(step))?.type;
    expect(both.patches.map(({ loops }) => loops.map((loop) => loop.map(typeOf).toSorted()))).toEqual([
      [["arc", "straight"]],
      [["arc", "straight"]],
    ]);
    expect(both.lines).toHaveLength(5);
  });

  it("where two lines only nearly meet, a line is drawn onto one of them", () => {
    const project = projectWith([[0, 0, 0], [2, 0, 0], [1, -1, 1e-7], [1, 1, 1e-7]], [["straight", [0, 1]], ["straight", [2, 3]]]); // prettier-ignore
    expect(placeOnLines(project, [1, 2], [1, 0, 0]).lines).toEqual([1]);
    const meeting = { ...project, points: project.points.map(({ id, position: [x, y] }) => ({ id, position: [x, y, 0] as const })) }; // prettier-ignore
    expect(placeOnLines(meeting, [1, 2], [1, 0, 0]).lines).toEqual([1, 2]);
  });

  it("meeting at ends, they need no split", async () => {
    const cube = cubeProject();
    expect(cutsAtCrossings(cube, await pathsOf(cube))).toEqual([]);
  });

  it("a line drawn to the middle of another one splits it, in the same step of undo", () => {
    const project = projectWith(square, sides);
    const documents = new DocumentStore(project, () => 0);
    const places = [placeOnLines(project, [1], [1.0001, 1e-5, 0]), placeAt(project, [1, 1, 0])];
    const { creation, points } = drawLine(project, "straight", places);
    if (!creation) throw new Error("no line");
    documents.edit(creation.edit);
    expect(documents.project.lines.map(({ id, points: ends }) => [id, ...ends])).toEqual([
      [1, 1, points[0]],
      [6, points[0], 2],
      [2, 2, 3],
      [3, 3, 4],
      [4, 4, 1],
      [5, ...points],
    ]); // prettier-ignore
    expect(documents.project.points[4]?.position).toEqual([1.0001, 0, 0]);
    documents.undo();
    expect(documents.project).toEqual(project);
  });

  it("an open line is split by a quick fix where another one ends on it", () => {
    const project = projectWith([...square, [1, 0, 0], [1, 2, 0]], [...sides, ["straight", [4, 5]]]);
    const problems = [1, 2, 3, 4, 5].map((id) => ({
      code: "open-edge",
      body: null,
      entities: [{ kind: "line", id }],
    })) as unknown as readonly Problem[];
    const [first, second] = problems;
    if (!first || !second) throw new Error("no problem");
    const fix = quickFixOf(first, { project, problems });
    expect(fix?.label).toBe("Split the line");
    expect(fix?.effect).toContain("point 5");
    expect(fix?.apply(project).lines).toHaveLength(6);
    expect(quickFixOf(second, { project, problems })?.label).not.toBe("Split the line");
  });
});
