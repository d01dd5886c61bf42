/** True faces of bodies: their text in a project, and the nodes of a project's mesh on them. */
import { beforeAll, expect, test } from "vitest";
import { deviationWarnings } from "../../../wasm/dist/api/inspection.js";
import { createMesher, type Mesh, type Mesher, readSurface } from "../../../wasm/dist/index.js";
import { createBodies, readProject, writeProject, type Project } from "../../../wasm/dist/project.js";
import { textOfTrueFaces, trueFacesOfText } from "../../../wasm/dist/project/true-faces-text.js";
import { drilledSolid, stepFile } from "../../support/step-files.js";

const RADIUS = 3;
const plate = stepFile([drilledSolid("Plate", [0, 0, 0], [20, 10, 8], [8, 5], RADIUS)]);

let mesher: Mesher;
let surface: Mesh;
let project: Project;
beforeAll(async () => {
  mesher = await createMesher();
  const read = await readSurface(plate, { fileName: "plate.step" });
  if (!read.success) throw new Error("the plate cannot be read");
  surface = read.value;
  const bodies = createBodies(read.value, { id: 1, firstPatchId: 1, name: "plate" });
  const empty = { points: [], lines: [], patches: [], background: { nodes: [], tetrahedra: [] } };
  project = { format: "tetrafront-project", version: 2, name: "plate", ...empty, bodies };
});

const copyOf = (given: Project): Project => {
  const read = readProject(writeProject(given));
  if (!read.success) throw new Error(JSON.stringify(read.errors));
  return read.value;
};

/** Returns the largest distance from the cylinder of the hole, of the nodes of its patch, about an axis along z. */
async function largestGap(
  given: Project,
  [x, y]: readonly [number, number],
  radius: number,
): Promise<number> {
  const { mesh } = await mesher.meshProject(given);
  const nodes = new Set<number>();
  mesh.trianglePatch.forEach((patch, t) => {
    if (mesh.patches[patch]?.name !== "face 7") return;
    for (const node of mesh.triangles.subarray(3 * t, 3 * t + 3)) nodes.add(node);
  });
  expect(nodes.size).toBeGreaterThan(50);
  const gaps = [...nodes].map((node) =>
    Math.abs(Math.hypot((mesh.points[3 * node] ?? 0) - x, (mesh.points[3 * node + 1] ?? 0) - y) - radius),
  );
  return Math.max(...gaps);
}

test("the nodes of a project's mesh lie on the faces of the CAD file, also after it was saved", async () => {
  expect(await largestGap(copyOf(project), [8, 5], RADIUS)).toBeLessThan(1e-9);
});

test("a body that is moved, turned and scaled takes its faces along", async () => {
  const [body] = project.bodies ?? [];
  if (!body) throw new Error("there is no body");
  // A quarter turn about z, then a move.
  const rotation = [0, 0, Math.SQRT1_2, Math.SQRT1_2] as const;
  const placement = { position: [100, 20, 5], rotation, scale: 0.5 } as const;
  const moved = { ...project, bodies: [{ ...body, placement }] };
  expect(await largestGap(moved, [100 - 2.5, 20 + 4], RADIUS / 2)).toBeLessThan(1e-9);
});

test("faces are triangulated on their own surfaces, unless they were moved", async () => {
  const withPlacement = (scale: number) => ({
    ...surface,
    trueFaces: surface.trueFaces?.map((faces) => ({ ...faces, placement: { scale } })),
  });
  for (const given of [surface, withPlacement(1)]) {
    const made = await mesher.remeshSurface(given);
    expect(made.onFaces).toBe(true);
    // Of chords of the hole, whose edges span at most a sixth of it.
    expect(made.deviation).toBeGreaterThan(0);
    expect(made.deviation).toBeLessThan(RADIUS * (1 - Math.cos(Math.PI / 6)));
  }
  expect((await mesher.remeshSurface(withPlacement(2))).onFaces).toBe(false);
});

test("what flat triangles add or leave out is a note on true faces, and a warning else", async () => {
  const coarse = { size: 4, tolerance: 2 };
  const onFaces = await mesher.remeshSurface(surface, coarse);
  expect(onFaces.onFaces).toBe(true);
  // A hole with few sides is narrower.
  expect(onFaces.volume / onFaces.givenVolume).toBeGreaterThan(1.01);
  const found = (made: typeof onFaces) =>
    made.diagnostics.filter(({ code }) => code === "changed-volume").map(({ severity }) => severity);
  expect(found(onFaces)).toEqual(["information"]);
  const { trueFaces: _, ...facets } = surface;
  const plain = await mesher.remeshSurface(facets, coarse);
  expect(plain.onFaces).toBe(false);
  expect(plain.volume / plain.givenVolume).toBeGreaterThan(1.01);
  expect(found(plain)).toEqual(["warning"]);
});

test("a deviation beyond the tolerance is a warning; beyond an automatic one, if it is far beyond", () => {
  const codes = (deviation: number, isGiven: boolean) =>
    deviationWarnings({ deviation, tolerance: 0.1, mergedDetails: [] }, isGiven).map(({ code }) => code);
  const warned = ["deviation-above-tolerance"];
  expect([codes(0.1, true), codes(0.12, true), codes(0.2, true)]).toEqual([[], warned, warned]);
  expect([codes(0.1, false), codes(0.12, false), codes(0.2, false)]).toEqual([[], [], warned]);
});

test("a damaged text is refused, with the name of its field", () => {
  const [body] = project.bodies ?? [];
  const text = body?.trueFaces ?? "";
  expect(text.length).toBeGreaterThan(1000);
  for (const damaged of [
    "",
    "no base64!",
    text.slice(0, text.length / 2),
    text.slice(8),
    "AAAA".repeat(40),
  ]) {
    expect(trueFacesOfText(damaged)).toBeUndefined();
    const file = JSON.stringify({ ...project, bodies: [{ ...body, trueFaces: damaged }] });
    const read = readProject(file);
    expect(read.success).toBe(false);
    expect(read.success ? "" : JSON.stringify(read.errors)).toContain("trueFaces");
  }
});

test("the text keeps what it was made of, apart from the digits of triangles near the faces", () => {
  const text = project.bodies?.[0]?.trueFaces ?? "";
  const solids = trueFacesOfText(text) ?? [];
  expect(solids).toHaveLength(1);
  expect(solids[0]?.faceCount).toBe(7);
  expect(textOfTrueFaces([...solids, ...solids])).toHaveLength(2 * text.length);
  expect(textOfTrueFaces(solids)).toBe(text);
});
