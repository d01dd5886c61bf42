/**
 * meshio and Gmsh read the files we write, and we read the files meshio writes, if Python has these programs.
 */
import { spawn, spawnSync } from "node:child_process";
import { readFileSync, writeFileSync } from "node:fs";
import path from "node:path";
import { createInterface } from "node:readline";
import { fileURLToPath } from "node:url";

import { readMesh, writeMesh, type Mesh } from "tetrafront";
import { afterAll, describe, expect, test } from "vitest";

import { inSteps } from "../../../wasm/src/calls/yielder.js";
import { boundaryOf } from "../../../wasm/src/formats/boundary.js";
import { blockMesh, taggedElements } from "../../support/block-mesh.js";
import { temporaryFolder } from "../../support/temporary-folder.js";

const python = process.env["TETRAFRONT_PYTHON"] ?? "python3";
const script = fileURLToPath(new URL("../../support/read_mesh.py", import.meta.url));

const which = spawnSync(python, [script, "which"], { encoding: "utf8" });
const programs = which.status === 0 ? (JSON.parse(which.stdout) as string[]) : [];

/** One process answers all questions, because its imports take longer than its work. */
function startProcess() {
  const { stdin, stdout } = spawn(python, [script, "answer"], { stdio: ["pipe", "pipe", "ignore"] });
  const lines: AsyncIterator<string, undefined> = createInterface(stdout)[Symbol.asyncIterator]();
  return { stdin, lines };
}
let answering: ReturnType<typeof startProcess> | undefined;
afterAll(() => answering?.stdin.end());

/** Asks read_mesh.py; throws the text of a failure. */
async function ask(...question: readonly string[]): Promise<unknown> {
  answering ??= startProcess();
  answering.stdin.write(`${question.join("\t")}\n`);
  const { value: line } = await answering.lines.next();
  if (line === undefined) throw new Error(`read_mesh.py ended at: ${question.join(" ")}`);
  const answer = JSON.parse(line) as unknown;
  if (typeof answer === "string") throw new Error(answer);
  return answer;
}

interface ReadMesh {
  readonly points: readonly (readonly number[])[];
  readonly cells: readonly (readonly [string, readonly (readonly number[])[]])[];
  readonly tags: Readonly<Record<string, readonly (readonly number[])[]>>;
  readonly names: Readonly<Record<string, readonly [number, number]>>;
  readonly cellSets: Readonly<Record<string, readonly number[]>>;
  readonly pointSets: Readonly<Record<string, number>>;
}

const mesh = blockMesh();
const folder = temporaryFolder("all tests");

async function save(fileName: string, given: Mesh = mesh, elementOrder: 1 | 2 = 1): Promise<string> {
  for (const file of await writeMesh(given, path.join(folder.path, fileName), { elementOrder }))
    writeFileSync(file.fileName, file.bytes);
  return path.join(folder.path, fileName);
}

async function readByMeshio(fileName: string, format: string, given: Mesh = mesh): Promise<ReadMesh> {
  return (await ask("read", "meshio", format, await save(fileName, given))) as ReadMesh;
}

/** The mesh with a whole number on each tetrahedron, which its triangles have too. */
const powered: Mesh = {
  ...mesh,
  elementData: new Map([
    [
      "power",
      {
        components: 1,
        values: Float64Array.from({ length: mesh.tetrahedra.length / 4 }, (_, t) => 10 * t + 3),
      },
    ],
  ]),
};
const powerOf = new Map(
  Array.from({ length: mesh.tetrahedra.length / 4 }, (_, t) => [
    [...mesh.tetrahedra.subarray(4 * t, 4 * t + 4)].sort((a, b) => a - b).join(" "),
    10 * t + 3,
  ]),
);
/** Returns the numbers on the tetrahedra that have all given nodes. */
const powersAt = (nodes: readonly number[]) =>
  [...powerOf]
    .filter(([key]) => nodes.every((node) => key.split(" ").includes(String(node))))
    .map(([, p]) => p);

const plus = (values: ArrayLike<number>) => Array.from(values, (value) => value + 0);
const expected = {
  tetra: taggedElements(mesh.tetrahedra, 4, mesh.tetrahedronRegion, mesh.regions),
  triangle: taggedElements(mesh.triangles, 3, mesh.trianglePatch, mesh.patches),
};

/** Returns the elements of a type with their tags from the named array; untagged if there is no name. */
function elements(read: ReadMesh, kind: "tetra" | "triangle", tags: string | undefined): string[] {
  return read.cells
    .flatMap(([type, cells], b) =>
      type === kind
        ? cells.map(
            (nodes, e) => `${tags === undefined ? "" : `${read.tags[tags]?.[b]?.[e]}: `}${nodes.join(" ")}`,
          )
        : [],
    )
    .sort();
}

const untagged = (lines: readonly string[]) => lines.map((line) => line.replace(/^.*: /, "")).sort();

/** Returns the expected elements if tags count up from the given numbers, or are all equal (step 0). */
function renumbered(region: number, patch: number, step: 0 | 1 = 1): typeof expected {
  const from = (first: number) => (_: unknown, g: number) => ({ tag: first + step * g });
  return {
    tetra: taggedElements(mesh.tetrahedra, 4, mesh.tetrahedronRegion, mesh.regions.map(from(region))),
    triangle: taggedElements(mesh.triangles, 3, mesh.trianglePatch, mesh.patches.map(from(patch))),
  };
}
/** meshio numbers markers, which have only names. */
const asMarkers = { ...renumbered(0, 1), tetra: renumbered(0, 0, 0).tetra };

if (programs.length === 0) {
  test("is skipped without meshio and Gmsh", () => {
    expect(programs).toEqual([]);
  });
}

interface Measured {
  readonly volume: number;
  readonly smallest: number;
}
/** Volume of each tetrahedron. */
const volumes = Array.from({ length: mesh.tetrahedra.length / 4 }, (_, t) => {
  const [a = [], ...others] = [...mesh.tetrahedra.subarray(4 * t, 4 * t + 4)].map((node) => [
    ...mesh.points.subarray(3 * node, 3 * node + 3),
  ]);
  const [u = [], v = [], w = []] = others.map((p) => p.map((x, axis) => x - (a[axis] ?? 0)));
  const cross = [0, 1, 2].map(
    (i) => (u[(i + 1) % 3] ?? 0) * (v[(i + 2) % 3] ?? 0) - (u[(i + 2) % 3] ?? 0) * (v[(i + 1) % 3] ?? 0),
  );
  return cross.reduce((sum, x, axis) => sum + x * (w[axis] ?? 0), 0) / 6;
});
const totalVolume = volumes.reduce((sum, volume) => sum + volume, 0);
/** Number of different edges of the elements. */
const edgeCount = new Set(
  Array.from({ length: mesh.tetrahedra.length / 4 }, (_, t) => [
    ...mesh.tetrahedra.subarray(4 * t, 4 * t + 4),
  ])
    .flatMap((nodes) => nodes.flatMap((a, i) => nodes.slice(i + 1).map((b) => [a, b])))
    .map((ends) => ends.sort((a, b) => a - b).join()),
).size;

const SECOND_ORDER_FILES = [
  ["second.vtu", "vtu", 1e-12],
  ["second.vtk", "vtk", 1e-12],
  ["second.msh", "gmsh", 1e-12],
  ["second.msh2", "gmsh", 1e-12],
  ["second.inp", "abaqus", 1e-12],
  ["second.bdf", "nastran", 1e-9],
] as const;

if (programs.includes("meshio")) {
  describe("second-order elements measure the same in meshio, with each node at the middle of its edge:", () => {
    test.each(SECOND_ORDER_FILES)("%s", async (fileName, format, tolerance) => {
      const found = (await ask("second", "meshio", format, await save(fileName, mesh, 2))) as Measured & {
        readonly distance: number;
        readonly nodes: number;
        readonly elements: Readonly<Record<string, number>>;
      };
      expect(Math.abs(found.volume - totalVolume)).toBeLessThan(tolerance * totalVolume);
      expect(Math.abs(found.smallest - Math.min(...volumes))).toBeLessThan(tolerance * totalVolume);
      expect(found.distance).toBeLessThan(tolerance);
      expect(found.nodes).toBe(mesh.points.length / 3 + edgeCount);
      const triangles = format === "abaqus" ? {} : { triangle6: mesh.triangles.length / 3 };
      expect(found.elements).toEqual({ tetra10: mesh.tetrahedra.length / 4, ...triangles });
    });
  });
  describe("meshio reads the same points, elements and tags from", () => {
    test.each<[string, string, string | undefined, string, typeof expected]>([
      ["part.vtu", "vtu", "region", "patch", expected],
      ["part.vtk", "vtk", "region", "patch", expected],
      ["part.msh", "gmsh", "gmsh:physical", "gmsh:physical", expected],
      ["part.msh2", "gmsh", "gmsh:physical", "gmsh:physical", expected],
      ["part.mesh", "medit", "medit:ref", "medit:ref", expected],
      ["part.su2", "su2", "su2:tag", "su2:tag", asMarkers],
      ["part.bdf", "nastran", "nastran:ref", "nastran:ref", expected],
      ["part.ugrid", "ugrid", undefined, "ugrid:ref", expected],
      ["part.b8.ugrid", "ugrid", undefined, "ugrid:ref", expected],
    ])("%s", async (fileName, format, regions, patches, expected) => {
      const read = await readByMeshio(fileName, format);
      const points = read.points.flat();
      // Nastran fields have 16 characters; UGRID text is read as float32.
      const digits = format === "nastran" ? 12 : fileName === "part.ugrid" ? 6 : undefined;
      if (digits !== undefined) {
        points.forEach((value, i) => expect(value).toBeCloseTo(mesh.points[i] ?? NaN, digits));
      } else expect(plus(points)).toEqual(plus(mesh.points));
      expect(elements(read, "tetra", regions)).toEqual(
        regions === undefined ? untagged(expected.tetra) : expected.tetra,
      );
      expect(elements(read, "triangle", patches)).toEqual(expected.triangle);
    });

    test.each<[string, string]>([
      ["power.vtu", "vtu"],
      ["power.vtk", "vtk"],
      ["power.msh", "gmsh"],
    ])("%s with values of elements", async (fileName, format) => {
      const { cells, tags } = await readByMeshio(fileName, format, powered);
      const rows = cells.flatMap(([, elements], b) =>
        elements.map((nodes, e) => ({ nodes, power: tags["power"]?.[b]?.[e] ?? NaN })),
      );
      expect(rows).toHaveLength(mesh.tetrahedra.length / 4 + mesh.triangles.length / 3);
      for (const { nodes, power } of rows) expect(powersAt(nodes)).toContain(power);
    });

    test("part.node with part.ele", async () => {
      const read = await readByMeshio("part.node", "tetgen");
      expect(plus(read.points.flat())).toEqual(plus(mesh.points));
      expect(elements(read, "tetra", "tetgen:ref")).toEqual(expected.tetra);
    });

    test("part.inp with its sets", async () => {
      const read = await readByMeshio("part.inp", "abaqus");
      expect(plus(read.points.flat())).toEqual(plus(mesh.points));
      expect(elements(read, "tetra", undefined)).toEqual(untagged(expected.tetra));
      expect(Object.keys(read.cellSets).sort()).toEqual(["steel", "water_20_C_"]);
      expect(Object.values(read.pointSets)).toEqual([9, 9, 9, 9, 9, 9]);
    });

    test("the names in part.msh", async () => {
      const { names } = await readByMeshio("part.msh", "gmsh");
      expect(names).toMatchObject({ steel: [5, 3], "in let": [7, 2], "outlet (patch 4)": [4, 2] });
    });

    test.each(["stl", "obj", "off", "ply"])("the boundary as .%s", async (format) => {
      const read = await readByMeshio(`part.${format}`, format);
      const cells = read.cells.flatMap(([type, rows]) => (type === "triangle" ? rows : []));
      const at = (node: number) => (read.points[node] ?? []).map(Math.fround).join(" ");
      const soup = cells.map((nodes) => nodes.map(at).join(" | ")).sort();
      const position = (node: number) =>
        plus(mesh.points.subarray(3 * node, 3 * node + 3))
          .map(Math.fround)
          .join(" ");
      const given = Array.from({ length: mesh.triangles.length / 3 }, (_, t) =>
        [...mesh.triangles.subarray(3 * t, 3 * t + 3)].map(position).join(" | "),
      ).sort();
      expect(soup).toEqual(given);
    });

    test("the patches in part.ply", async () => {
      const read = await readByMeshio("part.ply", "ply");
      const boundary = await inSteps(boundaryOf(mesh));
      const triangles = taggedElements(boundary.triangles, 3, boundary.trianglePatch, boundary.patches);
      expect(elements(read, "triangle", "patch")).toEqual(triangles);
      expect(plus(read.points.flat())).toEqual(plus(boundary.points));
    });
  });

  describe("files written by meshio are read:", () => {
    test.each<[string, string]>([
      ["again.vtu", "dict(binary=False)"],
      ["again.vtu", "dict(compression=None)"],
      ["again.vtu", "dict(compression='zlib')"],
      ["again.vtk", "dict(file_format='vtk42', binary=False)"],
      ["again.vtk", "dict(file_format='vtk42', binary=True)"],
      ["again.vtk", "dict(file_format='vtk51', binary=False)"],
      ["again.vtk", "dict(file_format='vtk51', binary=True)"],
      ["again.msh", "dict(file_format='gmsh', binary=False)"],
      ["again.msh", "dict(file_format='gmsh', binary=True)"],
      ["again.msh", "dict(file_format='gmsh22', binary=False)"],
      ["again.msh", "dict(file_format='gmsh22', binary=True)"],
      ["again.mesh", "dict()"],
    ])("%s with %s", async (fileName, options) => {
      // meshio stores the tags of a format under names of that format.
      const source = fileName.endsWith("mesh")
        ? "from.mesh"
        : fileName.endsWith("msh")
          ? "from.msh"
          : "from.vtu";
      const target = path.join(folder.path, fileName);
      await ask("write", await save(source), target, options);
      const read = await readMesh(readFileSync(target), { fileName });
      if (!read.success) throw new Error(read.errors[0].message);
      const found: Mesh = read.value;
      // meshio writes twelve digits in text.
      found.points.forEach((value, i) => expect(value).toBeCloseTo(mesh.points[i] ?? NaN, 11));
      const tags = (of: "tetra" | "triangle") =>
        of === "tetra"
          ? taggedElements(found.tetrahedra, 4, found.tetrahedronRegion, found.regions)
          : taggedElements(found.triangles, 3, found.trianglePatch, found.patches);
      expect(tags("tetra")).toEqual(expected.tetra);
      expect(tags("triangle")).toEqual(expected.triangle);
    });

    test.each<[string, string]>([
      ["powers.vtk", "dict(file_format='vtk42', binary=True)"],
      ["powers.msh", "dict(file_format='gmsh', binary=True)"],
      ["powers.msh", "dict(file_format='gmsh22', binary=True)"],
    ])("%s with %s, with values of elements", async (fileName, options) => {
      const target = path.join(folder.path, fileName);
      const source = fileName.endsWith("msh") ? "power.msh" : "power.vtu";
      await ask("write", await save(source, powered), target, options);
      const read = await readMesh(readFileSync(target), { fileName });
      if (!read.success) throw new Error(read.errors[0].message);
      const { tetrahedra, elementData } = read.value;
      const values = elementData?.get("power")?.values ?? new Float64Array();
      expect(values).toHaveLength(tetrahedra.length / 4);
      values.forEach((value, t) =>
        expect(powersAt([...tetrahedra.subarray(4 * t, 4 * t + 4)])).toEqual([value]),
      );
    });
  });
}

if (programs.includes("gmsh")) {
  test.each(["power.msh", "power.msh2"])(
    "Gmsh reads the values of elements in %s, and we read those that it writes as text",
    async (fileName) => {
      const target = path.join(folder.path, `text of ${fileName}.msh`);
      const rows = (await ask("values", await save(fileName, powered), target)) as [number[], number][];
      expect(rows).toHaveLength(mesh.tetrahedra.length / 4 + mesh.triangles.length / 3);
      for (const [nodes, power] of rows) expect(powersAt(nodes)).toContain(power);
      const bytes = readFileSync(target);
      expect(bytes.includes("$ElementData")).toBe(true);
      const read = await readMesh(bytes, { fileName: "text.msh" });
      if (!read.success) throw new Error(read.errors[0].message);
      const [values] = Array.from(read.value.elementData?.values() ?? [], (data) => [...data.values]);
      expect(values?.toSorted((a, b) => a - b)).toEqual([...powerOf.values()]);
    },
  );
  test.each(["second.msh", "second.msh2", "second.bdf", "second.vtk"])(
    "second-order elements measure the same in Gmsh: %s",
    async (fileName) => {
      const found = (await ask("second", "gmsh", "-", await save(fileName, mesh, 2))) as Measured & {
        readonly types: readonly number[];
      };
      expect([...found.types].sort()).toEqual([11, 9]);
      expect(found.volume).toBeCloseTo(totalVolume, 9);
      expect(found.smallest).toBeCloseTo(Math.min(...volumes), 9);
    },
  );
  test.each(["stl", "obj", "off", "ply"])("Gmsh reads the boundary from .%s", async (format) => {
    const answer = await ask("read", "gmsh", await save(`part.${format}`));
    const { points, triangles } = answer as { points: number[][]; triangles: number };
    // STL stores float32; Gmsh may parse decimals in OBJ with a different last digit.
    const rounded = (x: number) => (format === "stl" ? Math.fround(x) : Number(x.toPrecision(14))) + 0;
    const positions = (all: readonly number[][]) =>
      all.map((position) => position.map(rounded).join(" ")).sort();
    const { points: given } = await inSteps(boundaryOf(mesh));
    const rows = Array.from({ length: given.length / 3 }, (_, i) => [...given.subarray(3 * i, 3 * i + 3)]);
    expect(positions(points)).toEqual(positions(rows));
    expect(triangles).toBe(mesh.triangles.length / 3);
  });

  test.each(["part.msh", "part.msh2"])(
    "Gmsh reads the same points and named groups from %s",
    async (fileName) => {
      const read = (await ask("read", "gmsh", await save(fileName))) as {
        points: number[][];
        groups: [number, number, string, number[][]][];
      };
      expect(plus(read.points.flat())).toEqual(plus(mesh.points));
      const of = (dimension: number) =>
        read.groups
          .filter(([d]) => d === dimension)
          .flatMap(([, tag, , cells]) => cells.map((nodes) => `${tag}: ${nodes.join(" ")}`))
          .sort();
      expect(of(3)).toEqual(expected.tetra);
      expect(of(2)).toEqual(expected.triangle);
      expect(read.groups.map(([, , name]) => name)).toEqual(expect.arrayContaining(["in let", "steel"]));
    },
  );

  test.each<[string, typeof expected]>([
    // Gmsh ignores the cell data of VTK files.
    ["part.vtk", renumbered(1, 1, 0)],
    ["part.mesh", expected],
    ["part.bdf", expected],
  ])("Gmsh reads the same points and tagged elements from %s", async (fileName, expected) => {
    const read = (await ask("read", "gmsh", await save(fileName))) as {
      points: number[][];
      entities: [number, number, number[][]][];
    };
    const positions = read.points.flat();
    if (fileName === "part.bdf") {
      expect(positions).toHaveLength(mesh.points.length);
      positions.forEach((value, i) => expect(value).toBeCloseTo(mesh.points[i] ?? NaN, 12));
    } else expect(plus(positions)).toEqual(plus(mesh.points));
    const of = (dimension: number) =>
      read.entities
        .filter(([d]) => d === dimension)
        .flatMap(([, tag, cells]) => cells.map((nodes) => `${tag}: ${nodes.join(" ")}`))
        .sort();
    expect(of(3)).toEqual(expected.tetra);
    expect(of(2)).toEqual(expected.triangle);
  });
}
