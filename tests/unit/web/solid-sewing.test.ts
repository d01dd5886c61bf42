/** Drawn patches of all kinds sewn to solids by the kernel: volumes and areas of formulas, names, features afterwards. */
import { readFileSync } from "node:fs";
import { createMesher, type Mesher } from "tetrafront";
import { readProject, type Project, type SolidFeature } from "tetrafront/project";
import { afterAll, beforeAll, expect, test } from "vitest";
import { emptyProject } from "../../../web/document/create";
import type { Entity } from "../../../web/document/entities";
import { DocumentStore } from "../../../web/session/document-store";
import { sew } from "../../../web/document/operations/solid-sewing";
import { measured } from "../../support/features";
import { kernelSolids } from "../../support/kernel-solids";
import { testKernel } from "../../support/kernel-shapes";

type Position = readonly [number, number, number];
type Line = Omit<Project["lines"][number], "id">;
type Patch = Omit<Project["patches"][number], "id">;

let mesher: Mesher;
beforeAll(async () => void (mesher = await createMesher()));
afterAll(() => mesher.dispose());

const solids = () => kernelSolids(testKernel, Promise.resolve(mesher));

const drawing = (
  points: readonly Position[],
  lines: readonly Line[],
  patches: readonly Patch[],
): Project => ({
  ...emptyProject(),
  points: points.map((position, p) => ({ id: p + 1, position })),
  lines: lines.map((line, l) => ({ ...line, id: l + 1 })),
  patches: patches.map((patch, p) => ({ ...patch, id: p + 1 })),
});

const straight = (from: number, to: number): Line => ({ type: "straight", points: [from, to] });

async function sewnOf(project: Project, selection: readonly Entity[] = []) {
  const subject = { project, selection };
  const offer = await sew.makeLater?.(subject, sew.initial(subject), solids());
  if (offer?.possible !== true) throw new Error(offer?.reason);
  const documents = new DocumentStore(project);
  documents.edit(offer.creation.edit);
  const body = documents.project.bodies?.[0];
  if (!body?.features) throw new Error("no solid");
  return { documents, body, features: body.features, note: offer.creation.note };
}

async function reasonOf(project: Project): Promise<string> {
  const subject = { project, selection: [] };
  try {
    const offer = await sew.makeLater?.(subject, sew.initial(subject), solids());
    return offer?.possible === false ? offer.reason : "";
  } catch (failure) {
    return String(failure);
  }
}

const measuredOf = async (features: readonly SolidFeature[]) => measured(await testKernel(), features);

/** A cylinder of radius 2 and height 3 between two circles that begin at different angles. */
const cylinder = (): Project =>
  drawing(
    [
      [2, 0, 0], [0, 2, 0], [-2, 0, 0],
      [0, 2, 3], [2, 0, 3], [0, -2, 3],
    ],
    [
      { type: "circle", points: [1, 2, 3, 1] },
      { type: "circle", points: [4, 5, 6, 4] },
    ],
    [
      { type: "planar", loops: [[1]] },
      { type: "planar", loops: [[2]], name: "lid" },
      { type: "tube", loops: [[1], [2]], name: "wall" },
    ],
  ); // prettier-ignore

test("a drawn cylinder is exact, and keeps the names of its patches", async () => {
  const groups = [{ id: 1, name: "outlet", members: [{ kind: "patch" as const, id: 2 }] }];
  const { documents, body, features } = await sewnOf({ ...cylinder(), groups });
  const { volume, area, faces } = await measuredOf(features);
  expect(volume / (12 * Math.PI)).toBeCloseTo(1, 12);
  expect(area / (20 * Math.PI)).toBeCloseTo(1, 12);
  expect(faces).toHaveLength(3);
  expect(body.patches.map(({ name }) => name).sort()).toEqual(["lid", "patch 1", "wall"]);
  // A group of the lid still has it.
  expect(body.patches.find(({ name }) => name === "lid")?.id).toBe(2);
  expect(documents.project.groups).toEqual(groups);
});

test("a fillet and a hole follow, and the drawing comes back by undo", async () => {
  const { documents, features } = await sewnOf(cylinder());
  expect(documents.project.patches).toEqual([]);
  documents.undo();
  expect(documents.project).toEqual(cylinder());
  const fillet: SolidFeature = { id: 2, type: "fillet", edges: ["1/face 2|1/face 3"], radius: 0.5 };
  const hole: SolidFeature = { id: 3, type: "hole", position: [0, 0, 3], axis: [0, 0, -1], diameter: 1 };
  const { volume, failures } = await measuredOf([...features, fillet, hole]);
  expect(failures).toEqual([]);
  // What the fillet takes turns around at its centroid (Pappus): the corner of a square of side r beyond a quarter circle.
  const [radius, r] = [2, 0.5];
  const centroid = radius - r + (2 * r) / (3 * (4 - Math.PI));
  const taken = 2 * Math.PI * centroid * (1 - Math.PI / 4) * r * r;
  expect(volume).toBeCloseTo(12 * Math.PI - (3 * Math.PI) / 4 - taken, 6);
});

/** A quarter of a cylinder of radius 1 and height 2: a Coons patch between two arcs, and planar ones. */
const quarter = (): Project => {
  const middle = Math.SQRT1_2;
  return drawing(
    [
      [0, 0, 0], [1, 0, 0], [0, 1, 0], [middle, middle, 0],
      [0, 0, 2], [1, 0, 2], [0, 1, 2], [middle, middle, 2],
    ],
    [
      straight(1, 2), { type: "arc", points: [2, 4, 3] }, straight(3, 1),
      straight(5, 6), { type: "arc", points: [6, 8, 7] }, straight(7, 5),
      straight(1, 5), straight(2, 6), straight(3, 7),
    ],
    [
      { type: "planar", loops: [[1, 2, 3]] },
      { type: "planar", loops: [[4, 5, 6]] },
      { type: "planar", loops: [[1, 8, -4, -7]] },
      { type: "planar", loops: [[3, 7, -6, -9]] },
      { type: "coons", loops: [[2, 9, -5, -8]] },
    ],
  ); // prettier-ignore
};

test("a Coons patch between arcs about one axis is a piece of a cylinder, exactly", async () => {
  const { volume, area } = await measuredOf((await sewnOf(quarter())).features);
  expect(volume / (Math.PI / 2)).toBeCloseTo(1, 12);
  expect(area / (Math.PI / 2 + Math.PI + 4)).toBeCloseTo(1, 12);
});

/** A box of 1 x 1 x 1 whose top is a Coons patch between parabolas of height h: z = 1 + 4 h (x - x² + y - y²). */
const vault = (h: number): Project =>
  drawing(
    [
      [0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0],
      [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1],
      [0.5, 0, 1 + h], [1, 0.5, 1 + h], [0.5, 1, 1 + h], [0, 0.5, 1 + h],
    ],
    [
      straight(1, 2), straight(2, 3), straight(3, 4), straight(4, 1),
      straight(1, 5), straight(2, 6), straight(3, 7), straight(4, 8),
      { type: "parabolic", points: [5, 9, 6] }, { type: "parabolic", points: [6, 10, 7] },
      { type: "parabolic", points: [7, 11, 8] }, { type: "parabolic", points: [8, 12, 5] },
    ],
    [
      { type: "planar", loops: [[1, 2, 3, 4]] },
      ...[0, 1, 2, 3].map((k) => ({ type: "planar" as const, loops: [[k + 1, 6 + k - (k === 3 ? 4 : 0), -(9 + k), -(5 + k)]] })),
      { type: "coons", loops: [[9, 10, 11, 12]], name: "roof" },
    ],
  ); // prettier-ignore

test("a box with a bulged patch has the volume of the integral, and takes a Boolean", async () => {
  const h = 0.2;
  const { features, note } = await sewnOf(vault(h));
  expect(note).toContain("kept as they are drawn");
  const { volume, faces } = await measuredOf(features);
  expect(volume).toBeCloseTo(1 + (4 * h) / 3, 7);
  expect(faces).toHaveLength(6);
  const cut: SolidFeature = {
    id: 2, type: "box", operation: "cut", position: [0, 0.5, -1], axis: [0, 0, 1], size: [1, 2, 4],
  }; // prettier-ignore
  const half = await measuredOf([...features, cut]);
  expect(half.failures).toEqual([]);
  // The box takes x < 0.5, and the shape is symmetric.
  expect(half.volume).toBeCloseTo((1 + (4 * h) / 3) / 2, 7);
});

/** A tube between two closed splines, each through four points of a circle of radius 1, with lids: not a circle. */
const splineTube = (): Project => {
  const rim = (z: number): Position[] => [[1, 0, z], [0, 1, z], [-1, 0, z], [0, -1, z]]; // prettier-ignore
  return drawing(
    [...rim(0), ...rim(2)],
    [
      { type: "spline", points: [1, 2, 3, 4, 1] },
      { type: "spline", points: [5, 6, 7, 8, 5] },
    ],
    [
      { type: "planar", loops: [[1]], name: "floor" },
      { type: "planar", loops: [[2]], name: "roof" },
      { type: "tube", loops: [[1], [2]], name: "wall" },
    ],
  );
};

test("all faces of a tube have the conditions and groups of their patch", async () => {
  const project = {
    ...splineTube(),
    groups: [{ id: 1, name: "skin", members: [{ kind: "patch" as const, id: 3 }] }],
    problem: { kind: "heat" as const, conditions: [{ patch: 3, kind: "value" as const, value: 20 }] },
  };
  const { documents, body, features } = await sewnOf(project);
  const { volume, failures } = await measuredOf(features);
  expect(failures).toEqual([]);
  const walls = body.patches.flatMap(({ id, name }) => (name?.startsWith("wall") === true ? [id] : []));
  expect(walls.length).toBeGreaterThan(1);
  const { groups, problem } = documents.project;
  expect(groups?.[0]?.members.map(({ id }) => id).sort()).toEqual(walls.toSorted());
  expect(problem?.conditions.map(({ patch }) => patch).sort()).toEqual(walls.toSorted());
  expect(problem?.conditions.every(({ value }) => value === 20)).toBe(true);
  const meshed = await mesher.meshProject({ ...splineTube(), meshing: { size: 0.1 } });
  expect(Math.abs(volume / meshed.report.volume - 1)).toBeLessThan(5e-3);
});

/** A slab of 2 x 2 whose top is a loft through a bulged section; the sides below its splines are plane. */
const lofted = (): Project =>
  drawing(
    [
      [0, 0, 0], [2, 0, 0], [2, 2, 0], [0, 2, 0],
      [0, 0, 1], [2, 0, 1], [2, 2, 1], [0, 2, 1],
      [1, 0, 1.3], [1, 2, 1.2], [0, 1, 1], [2, 1, 1], [1, 1, 1.6],
    ],
    [
      straight(1, 2), straight(2, 3), straight(3, 4), straight(4, 1),
      straight(1, 5), straight(2, 6), straight(3, 7), straight(4, 8),
      { type: "spline", points: [5, 9, 6] }, { type: "spline", points: [6, 12, 7] },
      { type: "spline", points: [7, 10, 8] }, { type: "spline", points: [8, 11, 5] },
      { type: "spline", points: [11, 13, 12] },
    ],
    [
      { type: "planar", loops: [[1, 2, 3, 4]] },
      ...[0, 1, 2, 3].map((k) => ({ type: "planar" as const, loops: [[k + 1, 6 + k - (k === 3 ? 4 : 0), -(9 + k), -(5 + k)]] })),
      { type: "loft", loops: [[9, 10, 11, 12], [13]], name: "roof" },
    ],
  ); // prettier-ignore

test("plane patches have the curves of a loft with sections", async () => {
  const { volume, failures } = await measuredOf((await sewnOf(lofted())).features);
  expect(failures).toEqual([]);
  const meshed = await mesher.meshProject({ ...lofted(), meshing: { size: 0.1 } });
  expect(Math.abs(volume / meshed.report.volume - 1)).toBeLessThan(2e-3);
});

test("rounded coordinates of plane patches are sewn beside exact ones, and alone", async () => {
  const rounding = (project: Project): Project => ({
    ...project,
    points: project.points.map(({ id, position: [x, y, z] }, p) => ({
      id,
      position: [x, y, z + 1e-6 * ((p % 3) - 1)] as const,
    })),
  });
  const arcs = await measuredOf((await sewnOf(rounding(quarter()))).features);
  expect(arcs.failures).toEqual([]);
  expect(arcs.volume).toBeCloseTo(Math.PI / 2, 4);
  const { patches, lines, ...rest } = vault(0);
  // Straight lines instead of parabolas: a box.
  const box = { ...rest, lines: lines.map((line) => ({ ...line, type: "straight" as const, points: [line.points[0] ?? 0, line.points.at(-1) ?? 0] })), patches: patches.map((patch) => ({ ...patch, type: "planar" as const })) }; // prettier-ignore
  const plane = await measuredOf((await sewnOf(rounding(box))).features);
  expect(plane.failures).toEqual([]);
  expect(plane.volume).toBeCloseTo(1, 4);
});

/** A sphere of eight triangles between quarter circles. */
function ball(): Project {
  const corners: Position[] = [
    [1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1],
  ]; // prettier-ignore
  const points = [...corners];
  const lines: Line[] = [];
  const edge = (from: number, to: number): number => {
    const known = lines.findIndex(
      ({ points: [a, , b] }) => (a === from && b === to) || (a === to && b === from),
    );
    if (known >= 0) return lines[known]?.points[0] === from ? known + 1 : -known - 1;
    const [a, b] = [corners[from - 1], corners[to - 1]] as [Position, Position];
    const middle = [0, 1, 2].map((k) => ((a[k] ?? 0) + (b[k] ?? 0)) * Math.SQRT1_2) as unknown as Position;
    return lines.push({ type: "arc", points: [from, points.push(middle), to] });
  };
  const patches = [1, 2].flatMap((x) =>
    [3, 4].flatMap((y) =>
      [5, 6].map((z) => ({ type: "nielson" as const, loops: [[edge(x, y), edge(y, z), edge(z, x)]] })),
    ),
  );
  return drawing(points, lines, patches);
}

test("a sphere of smooth triangles becomes the solid that its mesh approaches, and is drilled", async () => {
  const project = ball();
  const { features } = await sewnOf(project);
  const { volume } = await measuredOf(features);
  const volumes = await Promise.all(
    [0.3, 0.15].map(
      async (size) => (await mesher.meshProject({ ...project, meshing: { size } })).report.volume,
    ),
  );
  const [coarse = 0, fine = 0] = volumes;
  // The error of plane triangles is that of the square of their size.
  expect(Math.abs(volume - (fine + (fine - coarse) / 3)) / volume).toBeLessThan(4e-3);
  const hole: SolidFeature = { id: 2, type: "hole", position: [0, 0, 2], axis: [0, 0, -1], diameter: 0.2 };
  const drilled = await measuredOf([...features, hole]);
  expect(drilled.failures).toEqual([]);
  expect(volume - drilled.volume).toBeGreaterThan(0.98 * Math.PI * 0.01 * 1.99);
  expect(volume - drilled.volume).toBeLessThan(Math.PI * 0.01 * 2);
});

const gallery = (name: string): Project => {
  const read = readProject(readFileSync(`public/models/${name}.json`, "utf8"));
  if (!read.success) throw new Error(name);
  return read.value;
};

test("an inner sphere of Gregory patches becomes a cavity", async () => {
  const { volume, failures } = await measuredOf((await sewnOf(gallery("sphere-in-a-box"))).features);
  expect(failures).toEqual([]);
  const meshed = await mesher.meshProject(gallery("sphere-in-a-box"));
  expect(Math.abs(volume / meshed.report.volume - 1)).toBeLessThan(2e-3);
});

test("plane patches with rounded coordinates are sewn", async () => {
  const { volume, failures } = await measuredOf((await sewnOf(gallery("y-pipe"))).features);
  expect(failures).toEqual([]);
  const drawn = { ...gallery("y-pipe"), background: { nodes: [], tetrahedra: [] } };
  const meshed = async (size: number): Promise<number> =>
    (await mesher.meshProject({ ...drawn, meshing: { size } })).report.volume;
  const [coarse, fine] = [await meshed(0.2), await meshed(0.1)];
  expect(Math.abs(volume / (fine + (fine - coarse) / 3) - 1)).toBeLessThan(2e-3);
}, 60_000);

/** A drawing with a square of 1e5 x 1e5 beside it, far above. */
function besideLarge({ points, lines, patches, ...rest }: Project): Project {
  const [firstPoint, firstLine, id] = [points, lines, patches].map(
    (list) => 1 + Math.max(...list.map((one) => one.id)),
  ) as [number, number, number];
  const at = (k: number): number => firstPoint + (k % 4);
  return {
    ...rest,
    points: [...points, ...[0, 1, 3, 2].map((k, p) => ({ id: at(p), position: [1e5 * (k % 2), 1e5 * (k >> 1), 99] as const }))],
    lines: [...lines, ...[0, 1, 2, 3].map((k) => ({ id: firstLine + k, ...straight(at(k), at(k + 1)) }))],
    patches: [...patches, { id, type: "planar", loops: [[0, 1, 2, 3].map((k) => firstLine + k)] }],
  }; // prettier-ignore
}

test("the smooth intake follows Hermite lines with more positions, also beside a large drawing", async () => {
  const drawn = gallery("smooth-intake");
  const [patch] = drawn.patches;
  const selection = [{ kind: "patch" as const, id: patch?.id ?? 0 }];
  const { features, body } = await sewnOf(besideLarge(drawn), selection);
  const [feature] = features;
  const grids =
    feature?.type === "sew" ? feature.faces.flatMap((face) => ("grid" in face ? [face] : [])) : [];
  // Base64 of 49 x 49 positions.
  expect(Math.max(...grids.map(({ positions }) => positions.length))).toBe(32 * 49 * 49);
  const { volume } = await measuredOf(features);
  const meshed = await mesher.meshProject(gallery("smooth-intake"));
  expect(Math.abs(volume / meshed.report.volume - 1)).toBeLessThan(5e-3);
  expect(body.patches.map(({ name }) => name)).toContain("nose below");
}, 60_000);

test("open patches, holes in curved ones, and patches inside are refused by name", async () => {
  const { patches, ...rest } = vault(0.2);
  expect(await reasonOf({ ...rest, patches: patches.slice(1) })).toMatch(
    /open at patch 2, patch 3, patch 4, patch 5/,
  );
  const [bottom] = patches;
  expect(
    await reasonOf({ ...rest, patches: [...patches, { ...bottom, id: 9 } as Project["patches"][number]] }),
  ).toContain("More than two patches meet at Line 1");
  const roof = patches.map((patch) =>
    patch.name === "roof" ? { ...patch, loops: [...patch.loops, [1]] } : patch,
  );
  expect(await reasonOf({ ...rest, patches: roof.slice(1) })).toContain("roof is curved and has holes");
});
