import { createMesher, type Mesher } from "tetrafront";
import type { Project } from "tetrafront/project";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { emptyProject } from "../../../web/document/create";
import { imprinted, type Imprint } from "../../../web/document/imprint/imprint";
import { insertion, withInsertion } from "../../../web/document/insert-shape";
import { box } from "../../../web/document/pieces/box";
import { cylinder } from "../../../web/document/pieces/cylinder";
import { prism } from "../../../web/document/pieces/prism";
import { wing } from "../../../web/document/pieces/wing";
import { placedIn, type Shape } from "../../../web/document/shape";
import { frameAlong } from "../../../web/document/vectors";
import { regionVolumes } from "../../support/check-mesh";
import { expectValid } from "../../support/expect-valid";
import { moved } from "../../support/pieces";

let mesher: Mesher;
beforeAll(async () => void (mesher = await createMesher()));
afterAll(() => mesher.dispose());

/** Adds shapes one after the other, each imprinted on those before. Returns the project and the last imprint. */
function stacked(shapes: readonly Shape[], size = 0.4): { project: Project; last: Imprint } {
  let project: Project = { ...emptyProject("Stacked"), meshing: { size } };
  let last: Imprint | null = null;
  for (const shape of shapes) {
    const made = insertion(project, shape, { join: true });
    const together = { ...project, ...withInsertion(project, made) };
    last = imprinted(together, new Set(made.patches.map(({ id }) => id)));
    project = { ...together, ...last.drawn };
  }
  if (!last) throw new Error("there are no shapes");
  return { project, last };
}

/** Meshes a project without problems, and returns the volumes of its regions, the smallest first. */
async function volumesOf(project: Project): Promise<number[]> {
  const { diagnostics } = await mesher.previewProject(project);
  expect(diagnostics.filter(({ severity }) => severity !== "information")).toEqual([]);
  const result = await mesher.meshProject(project);
  expectValid(result);
  return regionVolumes(result.mesh).toSorted((a, b) => a - b);
}

const cube = box(1, 1, 1);
/** A direction along no axis. */
const tilted = (shape: Shape): Shape => placedIn(shape, frameAlong([1, 2, -3], [7, -2, 0.3]));

describe("a piece that touches faces shares them", () => {
  const cases: readonly (readonly [
    what: string,
    shapes: readonly Shape[],
    shared: number,
    volumes: number[],
  ])[] = [
    ["within a larger face", [cube, moved(box(0.4, 0.4, 0.5), [0.1, 0, 1])], 1, [0.08, 1]],
    ["around a smaller face", [moved(box(0.4, 0.4, 0.5), [0, 0, 1]), cube], 1, [0.08, 1]],
    ["that it overlaps by half", [cube, moved(cube, [0.5, 0.25, 1])], 1, [1, 1]],
    ["that it overlaps by half, with common edges", [cube, moved(cube, [0.5, 0, 1])], 1, [1, 1]],
    [
      "of two neighbours",
      [cube, moved(cube, [1, 0, 0]), moved(box(1, 0.5, 0.5), [0.5, 0, 1])],
      2,
      [0.25, 1, 1],
    ],
    ["beside a higher piece on the same ground", [cube, moved(box(1, 0.6, 1.7), [1, 0, 0])], 1, [1, 1.02]],
    ["from inside, at a corner", [box(2, 2, 2), moved(box(1, 1, 1), [0.5, 0.5, 0])], 3, [1, 7]],
    ["with six corners", [box(2, 2, 1), moved(prism(6, 0.5, 1), [0, 0, 1])], 1, [0.375 * Math.sqrt(3), 4]],
  ];
  it.each(cases)("%s", async (_, shapes, shared, volumes) => {
    for (const place of [(shape: Shape) => shape, tilted]) {
      const { project, last } = stacked(shapes.map(place), 0.5);
      expect(last).toMatchObject({ shared, isIncomplete: false });
      const found = await volumesOf(project);
      expect(found).toHaveLength(volumes.length);
      volumes.forEach((volume, i) => expect(found[i]).toBeCloseTo(volume, 8));
      expect(new Set(project.patches.map(({ id }) => id)).size).toBe(project.patches.length);
      // Every line is of use, and no two straight lines join the same points.
      const used = new Set(project.patches.flatMap(({ loops }) => loops.flat().map(Math.abs)));
      expect(project.lines.filter(({ id }) => !used.has(id))).toEqual([]);
      const ends = project.lines.map(({ points }) => points.toSorted((a, b) => a - b).join());
      expect(new Set(ends).size).toBe(ends.length);
    }
  });

  it("also round ones, which become holes of the face", async () => {
    const { project, last } = stacked([cube, moved(cylinder(0.3, 0.3, 0.5), [0, 0, 1])], 0.1);
    expect(last.shared).toBe(1);
    const [pin = 0, block = 0] = await volumesOf(project);
    expect(block).toBeCloseTo(1, 9);
    expect(pin / (Math.PI * 0.09 * 0.5)).toBeGreaterThan(0.95);
    expect(pin / (Math.PI * 0.09 * 0.5)).toBeLessThan(1);
    const holes = project.patches.filter(({ loops }) => loops.length === 2);
    expect(holes.map(({ type }) => type).sort()).toEqual(["planar", "tube"]);
  });

  it.each([
    ["the border of a face", [cube, moved(cylinder(0.3, 0.3, 0.5), [0.4, 0, 1])], [Math.PI * 0.045, 1]],
    ["a corner of a face", [cube, moved(cylinder(0.3, 0.3, 0.5), [0.4, 0.45, 1])], [Math.PI * 0.045, 1]],
    [
      "another circle",
      [cylinder(0.4, 0.4, 1), moved(cylinder(0.4, 0.4, 0.5), [0.3, 0.2, 1])],
      [Math.PI * 0.08, Math.PI * 0.16],
    ],
  ] as const)("also round ones whose circle crosses %s", async (_, shapes, volumes) => {
    for (const place of [(shape: Shape) => shape, tilted]) {
      const { project, last } = stacked(shapes.map(place), 0.1);
      expect(last).toMatchObject({ shared: 1, isIncomplete: false });
      const found = await volumesOf(project);
      expect(found).toHaveLength(2);
      volumes.forEach((volume, i) => expect((found[i] ?? 0) / volume).toBeGreaterThan(0.95));
      volumes.forEach((volume, i) => expect((found[i] ?? 0) / volume).toBeLessThan(1 + 1e-9));
      const lines = new Set(project.patches.flatMap(({ loops }) => loops.flat().map(Math.abs)));
      expect(project.lines.filter(({ id }) => !lines.has(id))).toEqual([]);
      const points = new Set(project.lines.flatMap((line) => line.points));
      expect(project.points.filter(({ id }) => !points.has(id))).toEqual([]);
    }
  });

  it("and says where its patches are then", () => {
    const { project, last } = stacked([moved(box(0.4, 0.4, 0.5), [0, 0, 1]), cube]);
    const ids = [...last.patches.values()].flat();
    expect(new Set(ids).size).toBe(7);
    for (const id of ids) expect(project.patches.map((patch) => patch.id)).toContain(id);
    // The patch that was there before stays, with its name.
    expect(project.patches.find(({ id }) => id === 1)).toBeDefined();
  });
});

describe("a piece leaves the model as it is", () => {
  it.each([
    ["if it only touches edges in common planes", [cube, moved(box(1, 0.5, 1), [2, 0, 0])]],
    ["if it lies beside a circle in the same plane", [cylinder(0.3, 0.3, 1), moved(cube, [2, 0, 0])]],
    ["if the face is common as a whole", [cube, moved(cube, [0, 0, 1])]],
  ])("%s", (_, shapes) => {
    const { last, project } = stacked(shapes);
    expect(last).toMatchObject({ shared: 0, isIncomplete: false });
    const lists = shapes.reduce<Project>(
      (before, shape) => ({ ...before, ...withInsertion(before, insertion(before, shape, { join: true })) }),
      emptyProject("Plain"),
    );
    expect(project.lines).toEqual(lists.lines);
    expect(project.patches).toEqual(lists.patches);
  });

  it.each([
    ["if a circle touches the border of a face", [cube, moved(cylinder(0.5, 0.5, 1), [0, 0, 1])]],
    [
      "if a section crosses a face",
      [cube, moved(wing({ digits: 12, chord: 1, tipChord: 1, span: 1, sweep: 0, twist: 0 }), [0.1, 0, 1])],
    ],
  ])("and is reported as incomplete %s", (_, shapes) => {
    const { last } = stacked(shapes);
    expect(last).toMatchObject({ shared: 0, isIncomplete: true });
  });
});
