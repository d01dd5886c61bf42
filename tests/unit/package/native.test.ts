import { execFileSync, spawnSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import path from "node:path";

import { createMesher, readMesh, type Mesh, type Mesher, type SurfaceInput } from "tetrafront";
import { type Project, readProject, writeProject } from "tetrafront/project";
import { afterAll, beforeAll, expect, test } from "vitest";

import { cone } from "../../../web/document/pieces/cone.js";
import { cylinder } from "../../../web/document/pieces/cylinder.js";
import { sphere } from "../../../web/document/pieces/sphere.js";
import { torus } from "../../../web/document/pieces/torus.js";
import { placedIn } from "../../../web/document/shape.js";
import { frameAlong } from "../../../web/document/vectors.js";
import { fill, nativeFingerprint, nativeProgram } from "../../support/native.js";
import { projectOf } from "../../support/pieces.js";
import { offFile } from "../../support/surface-files.js";
import {
  boxSurface,
  cavitySurface,
  dividedSurface,
  needleGearSurface,
  screwThreadSurface,
  sphereSurface,
  torusSurface,
} from "../../support/surfaces.js";

const meshModel = nativeProgram("mesh_model");
const adaptMesh = nativeProgram("adapt_mesh");
let mesher: Mesher;
beforeAll(async () => {
  mesher = await createMesher();
});
afterAll(() => mesher.dispose());

/** Returns the fingerprint of the mesh that the native program makes from a drawn model, in a uniform size. */
function nativeModelFingerprint(project: Project, size: number): string | undefined {
  const folder = mkdtempSync(path.join(tmpdir(), "tetrafront-"));
  try {
    const file = path.join(folder, "model.json");
    writeFileSync(file, writeProject(project));
    return /fingerprint ([0-9a-f]{16})/.exec(
      execFileSync(meshModel, [file, String(size)], { encoding: "utf8" }),
    )?.[1];
  } finally {
    rmSync(folder, { recursive: true, force: true });
  }
}

/** Returns exit status and error message of the native program for a file with these contents. */
function nativeRefusal(
  contents: string | Uint8Array,
  ...options: string[]
): { status: number | null; message: string } {
  const folder = mkdtempSync(path.join(tmpdir(), "tetrafront-"));
  try {
    const file = path.join(folder, "surface.off");
    writeFileSync(file, contents);
    const { status, stderr } = spawnSync(fill, [file, ...options], { encoding: "utf8" });
    return { status, message: stderr };
  } finally {
    rmSync(folder, { recursive: true, force: true });
  }
}

test.each<[string, string]>([
  ["a word instead of a number", "OFF\n3 1 0\n0 0 0\n1 abc 0\n0 1 0\n3 0 1 2\n"],
  ["a number followed by other characters", "OFF\n3 1 0\n0 0 0\n1 0x 0\n0 1 0\n3 0 1 2\n"],
  ["a number beyond the range of doubles", "OFF\n3 1 0\n0 0 0\n1e999 0 0\n0 1 0\n3 0 1 2\n"],
  ["a count beyond any memory", "OFF\n999999999999999999 4 0\n0 0 0\n"],
  ["a truncated face", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1\n"],
])("the native program rejects %s", (_, text) => {
  const { status, message } = nativeRefusal(text);
  expect(status).toBe(2);
  expect(message).toContain("cannot be read as an OFF file of triangles");
});

test.each(["abc", "0.2x", "0", "-1", "inf", "nan", ""])(
  "the native program rejects the element size '%s'",
  (size) => {
    const { status, message } = nativeRefusal(offFile(boxSurface(2)), size);
    expect(status).toBe(2);
    expect(message).toContain("not an element size");
  },
);

test.each<[string, SurfaceInput]>([
  ["a sphere", sphereSurface(12)],
  ["a cube", boxSurface(9)],
  ["a torus", torusSurface(48, 20)],
  ["a cube with a cavity", cavitySurface(10)],
  ["a cube with an interface", dividedSurface(8)],
  ["a gear of needles", needleGearSurface(8)],
  ["a screw thread", screwThreadSurface(2, 12)],
  ["a torus of needles", torusSurface(120, 4)],
])("%s gets the same mesh bit for bit from the native program and from WebAssembly", async (_, surface) => {
  const { report } = await mesher.fillSurface(surface);
  expect(report.status).toBe("done");
  expect(nativeFingerprint(surface)?.toLowerCase()).toBe(report.fingerprint);
});

test.each<[string, SurfaceInput]>([
  ["a sphere", sphereSurface(20)],
  ["a cube with a cavity", cavitySurface(24)],
])("%s with lattices inside is the same bit for bit", async (_, surface) => {
  const { report } = await mesher.fillSurface(surface, { interior: "lattice" });
  expect(report.interior.lattice).toBeGreaterThan(0);
  expect(nativeFingerprint(surface, "--interior=lattice")?.toLowerCase()).toBe(report.fingerprint);
});

test.each<[string, SurfaceInput, number | undefined]>([
  ["a gear of needles", needleGearSurface(8, 0.2), undefined],
  ["a torus", torusSurface(24, 10), undefined],
  ["a sphere with a size", sphereSurface(8), 0.2],
])("%s is remeshed and meshed alike by the native program and by WebAssembly", async (_, surface, size) => {
  const remesh = await mesher.remeshSurface(surface, { size });
  const { report } = await mesher.fillSurface(remesh.mesh, { size });
  expect(report.status).toBe("done");
  const options = ["--remesh=on", ...(size === undefined ? [] : [String(size)])];
  expect(nativeFingerprint(surface, ...options)?.toLowerCase()).toBe(report.fingerprint);
});

test.each<[string, SurfaceInput, number]>([
  ["a sphere", sphereSurface(8), 1e-3],
  ["a cube of two triangles per side", boxSurface(1), 1e-4],
])("%s gets the same mesh within a largest volume from both", async (_, surface, maxVolume) => {
  const { report } = await mesher.fillSurface(surface, { maxVolume });
  expect(report.status).toBe("done");
  const fingerprint = nativeFingerprint(surface, `--max-volume=${maxVolume}`);
  expect(fingerprint?.toLowerCase()).toBe(report.fingerprint);
});

function sampleModel(id: string): Project {
  const read = readProject(
    readFileSync(new URL(`../../../public/models/${id}.json`, import.meta.url), "utf8"),
  );
  if (!read.success) throw new Error(read.errors[0].message);
  return read.value;
}

/** Positions that are no round numbers, along no axis. */
const tilted = frameAlong([1, 2, 3], [0.1, -0.7, 1 / 3]);

test.each<[string, Project, number]>([
  ["a cylinder, of circles and tubes", projectOf([placedIn(cylinder(1, 0.7, 2), tilted)], 0.3), 0.3],
  ["a cone, of arcs", projectOf([placedIn(cone(1, 2), tilted)], 0.3), 0.3],
  ["a sphere, of arcs", projectOf([placedIn(sphere(1), tilted)], 0.3), 0.3],
  ["a sector of a ring, of arcs", projectOf([placedIn(torus(2, 0.7, 100), tilted)], 0.35), 0.35],
  ["the pipe flange of the gallery, of circles", sampleModel("pipe-flange"), 0.2],
])("%s, gets the same mesh bit for bit from both", async (_, project, size) => {
  const curved = project.lines.filter(({ type }) => type === "arc" || type === "circle");
  expect(curved.length).toBeGreaterThan(0);
  const { report } = await mesher.meshProject({ ...project, meshing: { size } });
  expect(report.status).toBe("done");
  expect(nativeModelFingerprint(project, size)).toBe(report.fingerprint);
});

/** Returns the text of a Medit file of a mesh, with digits that read back the same. */
function meditText({ points, triangles, tetrahedra }: Mesh): string {
  const rows = (values: ArrayLike<number>, perRow: number, first: number): string =>
    Array.from({ length: values.length / perRow }, (_, row) =>
      Array.from({ length: perRow }, (_, k) => (values[perRow * row + k] ?? 0) + first).join(" "),
    )
      .map((row) => `${row} 0\n`)
      .join("");
  return [
    `MeshVersionFormatted 2\nDimension 3\nVertices\n${points.length / 3}\n${rows(points, 3, 0)}`,
    `Triangles\n${triangles.length / 3}\n${rows(triangles, 3, 1)}`,
    `Tetrahedra\n${tetrahedra.length / 4}\n${rows(tetrahedra, 4, 1)}End\n`,
  ].join("");
}

/** Metrics of a layer across x = 0.4: xx xy xz yy yz zz per node. */
function layerMetrics(points: Float64Array): Float64Array {
  const metrics = new Float64Array(2 * points.length);
  for (let node = 0; node < points.length / 3; node++) {
    const across = 0.02 + 0.2 * Math.abs((points[3 * node] ?? 0) - 0.4);
    metrics.set([1 / across ** 2, 0, 0, 25, 0, 25], 6 * node);
  }
  return metrics;
}

test("an adaptation makes the same mesh natively and in WebAssembly", async () => {
  const { mesh } = await mesher.fillSurface(boxSurface(6));
  const metrics = layerMetrics(mesh.points);
  const sized: Mesh = { ...mesh, nodeData: new Map([["metric", { components: 6, values: metrics }]]) };
  const made = await mesher.adaptMesh(mesh, sized);
  const folder = mkdtempSync(path.join(tmpdir(), "tetrafront-"));
  try {
    const fileNames = ["given.mesh", "metric.sol", "made.mesh"].map((name) => path.join(folder, name));
    const [given = "", metric = "", out = ""] = fileNames;
    writeFileSync(given, meditText(mesh));
    // Medit's order is that of the lower triangle: xx xy yy xz yz zz.
    const lines = Array.from({ length: mesh.points.length / 3 }, (_, node) => {
      const [xx = 0, , , yy = 0, , zz = 0] = metrics.subarray(6 * node);
      return `${xx} 0 ${yy} 0 0 ${zz}\n`;
    });
    const head = `MeshVersionFormatted 2\nDimension 3\nSolAtVertices\n${lines.length}\n1 3\n`;
    writeFileSync(metric, `${head}${lines.join("")}End\n`);
    execFileSync(adaptMesh, [given, given, metric, out]);
    const read = await readMesh(readFileSync(out), { fileName: "made.mesh" });
    if (!read.success) throw new Error(read.errors[0].message);
    expect(made.mesh.tetrahedra.length).toBeGreaterThan(4 * 2000);
    expect(read.value.points).toEqual(made.mesh.points);
    expect(read.value.tetrahedra).toEqual(made.mesh.tetrahedra);
  } finally {
    rmSync(folder, { recursive: true, force: true });
  }
});
