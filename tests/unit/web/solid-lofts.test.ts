/** Drawn loops and lines as lofts and sweeps, made by the kernel: which lines are meant, parameters, failures, undo. */
import { beforeAll, describe, expect, test } from "vitest";
import {
  createBody,
  readProject,
  type Project,
  type ProjectBody,
  type SolidFeature,
} from "tetrafront/project";
import { drawnSolid } from "../../../wasm/dist/cad/features/drawing.js";
import type { FeatureKernel } from "../../../wasm/dist/cad/features/session.js";
import { emptyProject } from "../../../web/document/create";
import { documentKey } from "../../../web/document/content-keys";
import type { Entity } from "../../../web/document/entities";
import { expressionsOfFeature } from "../../../web/document/operations/feature-numbers";
import type { FieldValues, SolidMaker } from "../../../web/document/operations/operation";
import { loftOperations } from "../../../web/document/operations/solid-lofts";
import { isSolid, type Solid } from "../../../web/document/operations/solids";
import { setParameter } from "../../../web/document/parameters";
import type { Position } from "../../../web/document/position";
import { DocumentStore } from "../../../web/session/document-store";
import { measured, UPRIGHT } from "../../support/features";
import { testKernel } from "../../support/kernel-shapes";

let kernel: FeatureKernel;
beforeAll(async () => {
  kernel = await testKernel();
});

const { points, triangles } = createBody(
  { points: Float64Array.of(0, 0, 0, 1, 0, 0, 0, 1, 1), triangles: Uint32Array.of(0, 1, 2) },
  { id: 1, firstPatchId: 1 },
);

/** Keeps the failures of the kernel; the triangles stand for any. */
const solids: SolidMaker = {
  bodyOf: (_, before, features) => {
    const { failures } = measured(kernel, features);
    const body: ProjectBody = {
      ...("id" in before ? before : { id: 1, name: before.name }),
      points,
      triangles,
      patches: [{ id: 1, origin: "1/start" }],
      features,
    };
    return Promise.resolve({ ...body, ...(failures.length > 0 && { failures }) });
  },
  edgesOf: () => Promise.resolve([]),
  samplesOf: () => Promise.reject(new Error("not sampled")),
  drawn: (features) => Promise.resolve(drawnSolid(kernel, features)),
};

const [loft, sweep] = loftOperations;
if (!loft || !sweep) throw new Error("no operations");

const patch: Entity = { kind: "patch", id: 1 };
const lines = (...ids: readonly number[]): Entity[] => ids.map((id) => ({ kind: "line", id }));

/** Returns corners of a square around the z axis, in either direction. */
const square = (half: number, z: number, isReversed = false): Position[] => {
  const corners: Position[] = [
    [-half, -half, z],
    [half, -half, z],
    [half, half, z],
    [-half, half, z],
  ];
  return isReversed ? corners.toReversed() : corners;
};

/**
 * Three squares of lines 1 to 4, 5 to 8 and 9 to 12, and the path of lines 13 and 14, which begins within the first square. The
 * height of the first corner of the second square, and those of its others, follow the parameter h.
 */
function drawn(): Project {
  const loops = [square(1, 0), square(2, 2, true), square(1, 4)];
  const path: Position[] = [
    [0, 0, 0],
    [0, 0, 3],
    [5, 0, 3],
  ];
  const loopLines = loops.flatMap((_, s) =>
    [0, 1, 2, 3].map((k) => [4 * s + 1 + k, 4 * s + 1 + ((k + 1) % 4)] as const),
  );
  const ends = [...loopLines, [14, 13] as const, [14, 15] as const];
  return {
    ...emptyProject(),
    parameters: [{ name: "h", expression: "2" }],
    points: [...loops.flat(), ...path].map((position, p) => ({ id: p + 1, position })),
    lines: ends.map((own, l) => ({ id: l + 1, type: "straight", points: own })),
    expressions: [
      ...[5, 6, 7, 8].map((id) => ({ kind: "point", id, field: "position.2", expression: "h" }) as const),
      ...[14, 15].map((id) => ({ kind: "point", id, field: "position.2", expression: "h+1" }) as const),
    ],
  };
}

const solidOf = ({ project }: DocumentStore): Solid => {
  const [solid] = project.bodies?.filter(isSolid) ?? [];
  if (!solid) throw new Error("no solid");
  return solid;
};

const volumeOf = (documents: DocumentStore): number => {
  const { volume, failures } = measured(kernel, solidOf(documents).features);
  expect(failures).toEqual([]);
  return volume;
};

async function accepted(
  operation: typeof loft,
  documents: DocumentStore,
  selection: readonly Entity[],
  values: FieldValues = {},
): Promise<void> {
  const subject = { project: documents.project, selection };
  const given = { ...operation?.initial(subject), ...values };
  const offer = await operation?.makeLater?.(subject, given, solids);
  if (offer?.possible !== true) throw new Error(`refused: ${offer?.reason}`);
  documents.edit(offer.creation.edit);
}

/** Volume of a frustum of squares. */
const frustum = (height: number, ...[a, b]: readonly [number, number]): number =>
  (height / 3) * 4 * (a * a + a * b + b * b);

describe("a loft", () => {
  test("goes through connected lines in the order of selection, and follows the expressions of their points", async () => {
    const documents = new DocumentStore(drawn());
    const before = documentKey(documents.project);
    const selection = lines(1, 3, 2, 4, 6, 5, 8, 7, 9, 10, 11, 12);
    await accepted(loft, documents, selection, { isRuled: true });
    expect(volumeOf(documents)).toBeCloseTo(2 * frustum(2, 1, 2), 9);
    expect(documents.project.lines.map(({ id }) => id)).toEqual([13, 14]);
    documents.edit(setParameter("h", "1"));
    expect(solidOf(documents).isOutdated).toBe(true);
    expect(volumeOf(documents)).toBeCloseTo(frustum(1, 1, 2) + frustum(3, 2, 1), 9);
    const after = documentKey(documents.project);
    const read = readProject(JSON.stringify(documents.project));
    expect(read.success ? documentKey(read.value) : read.errors).toEqual(after);
    documents.undo();
    documents.undo();
    expect(documentKey(documents.project)).toBe(before);
    documents.redo();
    documents.redo();
    expect(documentKey(documents.project)).toBe(after);
  });

  test("can go to the nearest loop each time, of patches too, and says its order", async () => {
    const project: Project = {
      ...drawn(),
      patches: [{ id: 1, type: "planar", loops: [[9, 10, 11, 12]], name: "lid" }],
    };
    const selection: Entity[] = [...lines(1, 2, 3, 4), patch, ...lines(5, 6, 7, 8)];
    const subject = { project, selection };
    const values = { ...loft.initial(subject), isRuled: true } as const;
    expect(loft.note?.(values, subject)).toContain("Line 1, lid, Line 5");
    const nearest = { ...values, order: "nearest" };
    expect(loft.note?.(nearest, subject)).toContain("Line 1, Line 5, lid");
    const documents = new DocumentStore(project);
    await accepted(loft, documents, selection, nearest);
    expect(volumeOf(documents)).toBeCloseTo(2 * frustum(2, 1, 2), 9);
    expect(documents.project.patches).toEqual([]);
  });

  test("joins a solid or is cut from it, and its panel changes both later", async () => {
    const cylinder: SolidFeature = {
      id: 3,
      type: "cylinder",
      operation: "new",
      ...UPRIGHT,
      radius: 5,
      height: 4,
    };
    const solid: Solid = { id: 9, points, triangles, patches: [{ id: 1 }], features: [cylinder] };
    const documents = new DocumentStore({ ...drawn(), bodies: [solid] });
    const selection = lines(1, 2, 3, 4, 5, 6, 7, 8);
    await accepted(loft, documents, selection, { isRuled: true, makes: "cut", keepProfile: true });
    const full = 100 * Math.PI;
    expect(volumeOf(documents)).toBeCloseTo(full - frustum(2, 1, 2), 9);
    expect(documents.project.lines).toHaveLength(14);
    const [, feature] = solidOf(documents).features;
    if (!feature) throw new Error("no feature");
    const texts = expressionsOfFeature(documents.project, 9, feature.id);
    expect(Object.values(texts)).toContain("h");
    const edit = loft.edit(solidOf(documents), feature, texts);
    const subject = { project: documents.project, selection: [] };
    const offer = await edit?.makeLater?.(subject, { ...edit.initial(subject), makes: "intersect" }, solids);
    if (offer?.possible !== true) throw new Error("refused");
    documents.edit(offer.creation.edit);
    expect(volumeOf(documents)).toBeCloseTo(frustum(2, 1, 2), 9);
    expect(expressionsOfFeature(documents.project, 9, feature.id)).toEqual(texts);
    expect(sweep.edit(solidOf(documents), feature)).toBeNull();
  });

  test.each([
    ["nothing", [], "two or more"],
    ["one loop", lines(1, 2, 3, 4), "two or more"],
    ["an open loop", lines(1, 2, 3, 4, 5, 6), "connected to Line 5"],
  ])("of %s is refused", (_, selection, reason) => {
    const subject = { project: drawn(), selection };
    expect(loft.makeLater?.(subject, loft.initial(subject), solids)).toBeNull();
    expect(loft.make(subject, loft.initial(subject))).toMatchObject({
      possible: false,
      reason: expect.stringContaining(reason) as string,
    });
  });

  test("whose loops come to coincide fails by itself, and the solid before it stays", async () => {
    const documents = new DocumentStore(drawn());
    const box: SolidFeature = { id: 1, type: "box", operation: "new", ...UPRIGHT, size: [1, 1, 1] };
    const solid: Solid = { id: 1, points, triangles, patches: [{ id: 1 }], features: [box] };
    documents.edit({ label: "", replace: { bodies: [solid] } });
    await accepted(loft, documents, lines(1, 2, 3, 4, 5, 6, 7, 8), { isRuled: true });
    documents.edit(setParameter("h", "0"));
    const { failures, volume } = measured(kernel, solidOf(documents).features);
    expect(failures.map(({ feature }) => feature)).toEqual([2]);
    expect(failures[0]?.remedy).toContain("loops are apart");
    expect(volume).toBeCloseTo(1, 9);
  });
});

describe("a sweep", () => {
  test.each([
    ["a patch", [patch, ...lines(13, 14)]],
    ["lines of a loop in any order", lines(14, 3, 1, 13, 2, 4)],
  ])("of %s goes along the other lines, and follows their points", async (_, selection) => {
    const patches = [{ id: 1, type: "planar", loops: [[1, 2, 3, 4]] }] as const;
    const documents = new DocumentStore({ ...drawn(), patches: selection.length === 3 ? patches : [] });
    await accepted(sweep, documents, selection);
    expect(volumeOf(documents)).toBeCloseTo(4 * (3 + 5), 9);
    expect(documents.project.lines.map(({ id }) => id)).toEqual([5, 6, 7, 8, 9, 10, 11, 12]);
    documents.edit(setParameter("h", "3"));
    expect(volumeOf(documents)).toBeCloseTo(4 * (4 + 5), 9);
  });

  test("begins with a path that is connected to the loop", async () => {
    const project = drawn();
    const start = { id: 16, type: "straight", points: [14, 1] } as const;
    const documents = new DocumentStore({ ...project, lines: [...project.lines.slice(0, 12), start] });
    await accepted(sweep, documents, lines(16, 1, 2, 3, 4));
    // The square runs along the line from its corner, to the height 3.
    expect(volumeOf(documents)).toBeCloseTo(4 * 3, 9);
  });

  test.each([
    ["no path", lines(1, 2, 3, 4), "a path"],
    ["no loop", lines(13, 14), "one closed loop"],
    ["two loops", lines(1, 2, 3, 4, 5, 6, 7, 8, 13), "one closed loop"],
    ["two paths", lines(1, 2, 3, 4, 5, 13), "one chain"],
  ])("with %s is refused", (_, selection, reason) => {
    const subject = { project: drawn(), selection };
    expect(sweep.makeLater?.(subject, sweep.initial(subject), solids)).toBeNull();
    expect(sweep.make(subject, sweep.initial(subject))).toMatchObject({
      possible: false,
      reason: expect.stringContaining(reason) as string,
    });
  });
});

test("a circle whose points have expressions keeps them", async () => {
  const [first] = lines(15);
  const base = drawn();
  const ring = [
    [1, 0, 5],
    [0, 1, 5],
    [-1, 0, 5],
  ] as const;
  const project: Project = {
    ...base,
    points: [...base.points, ...ring.map((position, k) => ({ id: 20 + k, position }))],
    lines: [...base.lines, { id: 15, type: "circle", points: [20, 21, 22, 20] }],
    expressions: [
      { kind: "point", id: 20, field: "position.0", expression: "h/2" },
      { kind: "point", id: 21, field: "position.1", expression: "h/2" },
      { kind: "point", id: 22, field: "position.0", expression: "-h/2" },
    ],
  };
  const documents = new DocumentStore(project);
  const path = { ...project.lines[12], id: 30, type: "straight", points: [13, 14] } as const;
  documents.edit({ label: "", replace: { lines: [...project.lines, path] } });
  await accepted(sweep, documents, [...(first ? [first] : []), ...lines(30)]);
  expect(volumeOf(documents)).toBeCloseTo(Math.PI * 3, 9);
  documents.edit(setParameter("h", "4"));
  expect(volumeOf(documents)).toBeCloseTo(4 * Math.PI * 3, 9);
});
