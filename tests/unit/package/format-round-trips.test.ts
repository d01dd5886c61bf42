/**
 * Round trips of every format: a written file is read back unchanged, or checked by the rules of its format.
 */
import { deflateSync } from "node:zlib";

import {
  createMesher,
  FILE_FORMATS,
  MesherError,
  readMesh,
  readSurface,
  writeMesh,
  type Mesh,
  type MeshResult,
  type SurfaceInput,
} from "tetrafront";
import { describe, expect, test } from "vitest";

import { blockMesh, outerFaces, sixfoldVolume, taggedElements } from "../../support/block-mesh.js";
import { polyMeshDefects, readPolyMesh } from "../../support/poly-mesh.js";
import { sphereSurface } from "../../support/surfaces.js";

const mesh = blockMesh();

async function files(fileName: string, given: Mesh = mesh): Promise<Map<string, Uint8Array<ArrayBuffer>>> {
  return new Map((await writeMesh(given, fileName)).map((file) => [file.fileName, file.bytes]));
}

async function only(fileName: string, given: Mesh = mesh): Promise<Uint8Array<ArrayBuffer>> {
  const written = await files(fileName, given);
  expect([...written.keys()]).toEqual([fileName]);
  return written.get(fileName) ?? new Uint8Array();
}

const text = async (fileName: string, given?: Mesh) => new TextDecoder().decode(await only(fileName, given));

async function readBack(fileName: string): Promise<Mesh> {
  const written = await files(fileName);
  const read = await readMesh(written.get(fileName) ?? new Uint8Array(), {
    fileName,
    openOther: (name) => Promise.resolve(written.get(name)),
  });
  if (!read.success) throw new Error(read.errors[0].message);
  return read.value;
}

const trianglesOf = (given: Mesh) => taggedElements(given.triangles, 3, given.trianglePatch, given.patches);
const tetrahedraOf = (given: Mesh) =>
  taggedElements(given.tetrahedra, 4, given.tetrahedronRegion, given.regions);

test("the test block has positive volumes and all boundary triangles", () => {
  const corners = Array.from({ length: mesh.tetrahedra.length / 4 }, (_, t) => [
    ...mesh.tetrahedra.subarray(4 * t, 4 * t + 4),
  ]);
  expect(corners.every((four) => sixfoldVolume(mesh.points, four) > 0)).toBe(true);
  expect(mesh.triangles.length / 3).toBe(6 * 8);
});

describe.each([".vtu", ".vtk", ".msh", ".msh2", ".mesh", ".node", ".ele"])("a volume in %s", (extension) => {
  test("is read back with exact coordinates, elements and tags", async () => {
    const read = await readBack(`part${extension}`);
    expect(read.points).toEqual(mesh.points);
    expect(tetrahedraOf(read)).toEqual(tetrahedraOf(mesh));
    expect(trianglesOf(read)).toEqual(trianglesOf(mesh));
  });
});

test.each([".vtu", ".vtk", ".msh", ".msh2", ".mesh"])(
  "readSurface takes only the triangles of a volume %s and their nodes",
  async (extension) => {
    const fileName = `part${extension}`;
    const read = await readSurface(await only(fileName), { fileName });
    if (!read.success) throw new Error(read.errors[0].message);
    expect(read.value.points.length / 3).toBe(26);
    const { status } = (await filled(read.value)).report;
    expect([read.value.triangles.length, status]).toEqual([mesh.triangles.length, "done"]);
  },
);

async function filled(surface: SurfaceInput): Promise<MeshResult> {
  const mesher = await createMesher();
  try {
    return await mesher.fillSurface(surface);
  } finally {
    mesher.dispose();
  }
}

test("a run gives each triangle of the mesh the patch of the given surface", async () => {
  const read = await readSurface(await only("part.msh"), { fileName: "part.msh" });
  if (!read.success) throw new Error(read.errors[0].message);
  // Reverse the triangles: the mesher flips them back and must keep their order.
  const given = {
    ...read.value,
    triangles: read.value.triangles.toReversed(),
    trianglePatch: read.value.trianglePatch.toReversed(),
  };
  const result = (await filled(given)).mesh;
  const trianglesByPosition = ({
    points,
    triangles,
    trianglePatch,
    patches,
  }: Pick<Mesh, "points" | "triangles" | "trianglePatch" | "patches">) =>
    Array.from(trianglePatch, (patch, t) => {
      const corners = [...triangles.subarray(3 * t, 3 * t + 3)].map((node) =>
        points.subarray(3 * node, 3 * node + 3).join(" "),
      );
      return `${patches[patch]?.tag}: ${corners.sort().join(" | ")}`;
    }).sort();
  expect(trianglesByPosition(result)).toEqual(trianglesByPosition(given));
});

test.each([".msh", ".msh2"])("names of patches and regions are kept by %s", async (extension) => {
  const read = await readBack(`part${extension}`);
  const names = (groups: Mesh["patches"]) => Object.fromEntries(groups.map(({ tag, name }) => [tag, name]));
  expect(names(read.regions)).toEqual({ 5: "steel", 9: "water (20 C)" });
  expect(names(read.patches)).toEqual({
    7: "in let",
    3: "outlet",
    11: "5th wall",
    4: "outlet (patch 4)",
    21: "floor, cold",
    2: "patch 6",
  });
});

describe("the boundary", () => {
  /** Triangles by the coordinates of their corners, with the group that identifies the patch. */
  const trianglesWithGroups = (
    given: Mesh,
    groupOf: (patch: number) => string,
    round: (value: number) => number,
  ) =>
    Array.from({ length: given.triangles.length / 3 }, (_, t) => {
      const corners = [...given.triangles.subarray(3 * t, 3 * t + 3)].map((node) =>
        [...given.points.subarray(3 * node, 3 * node + 3)].map(round).join(" "),
      );
      return `${groupOf(given.trianglePatch[t] ?? 0)}: ${corners.join(" | ")}`;
    }).sort();
  const exact = (value: number) => value + 0;

  test.each<[string, (given: Mesh, patch: number) => string, (value: number) => number]>([
    [".stl", (given, patch) => `${given.patches[patch]?.tag}`, Math.fround],
    [".ply", (given, patch) => `${given.patches[patch]?.tag}`, exact],
    [
      ".obj",
      (given, patch) => (given === mesh ? (objNames[patch] ?? "") : (given.patches[patch]?.name ?? "")),
      exact,
    ],
  ])("is kept by %s with its patches and only its nodes", async (extension, groupOf, round) => {
    const read = await readBack(`part${extension}`);
    expect(trianglesWithGroups(read, (patch) => groupOf(read, patch), exact)).toEqual(
      trianglesWithGroups(
        mesh,
        (patch) => groupOf(mesh, patch),
        (value) => round(value) + 0,
      ),
    );
    expect(read.points.length / 3).toBe(26);
    expect(read.patches).toHaveLength(6);
  });

  test("is kept by .off: lines stay plain for strict readers, and comments at the end store the patches", async () => {
    const lines = (await text("part.off")).trimEnd().split("\n");
    expect(lines.slice(0, 2)).toEqual(["OFF", "26 48 0"]);
    expect(lines.slice(28, 76).filter((line) => !/^3 \d+ \d+ \d+$/.test(line))).toEqual([]);
    expect(lines.slice(76).filter((line) => !line.startsWith("# "))).toEqual([]);
    const read = await readBack("part.off");
    const trianglesByPosition = (given: Mesh) => trianglesWithGroups(given, () => "", exact);
    expect(trianglesByPosition(read)).toEqual(trianglesByPosition(mesh));
    expect(read.patches).toHaveLength(6);
  });
  const objNames = ["in_let", "outlet", "5th_wall", "outlet_(patch_4)", "floor,_cold", "patch_6"];

  test("is valid as GLB: chunks, views, extents, one material per patch", async () => {
    const bytes = await only("part.glb");
    const view = new DataView(bytes.buffer);
    expect([view.getUint32(0, true), view.getUint32(4, true), view.getUint32(8, true)]).toEqual([
      0x46546c67,
      2,
      bytes.length,
    ]);
    const length = view.getUint32(12, true);
    interface Gltf {
      accessors: { bufferView: number; count: number; min?: number[]; max?: number[] }[];
      bufferViews: { byteOffset: number; byteLength: number }[];
      buffers: { byteLength: number }[];
      materials: { name: string }[];
      meshes: { primitives: { indices: number; attributes: { POSITION: number } }[] }[];
    }
    const gltf = JSON.parse(new TextDecoder().decode(bytes.subarray(20, 20 + length))) as Gltf;
    expect([length % 4, view.getUint32(24 + length, true)]).toEqual([0, 0x004e4942]);
    const binary = 28 + length;
    expect(view.getUint32(20 + length, true)).toBe(gltf.buffers[0]?.byteLength);
    expect(binary + (gltf.buffers[0]?.byteLength ?? 0)).toBe(bytes.length);
    const numbers = (accessor: number, get: (at: number) => number, width: number) => {
      const { bufferView = 0, count = 0 } = gltf.accessors[accessor] ?? {};
      const begin = binary + (gltf.bufferViews[bufferView]?.byteOffset ?? NaN);
      return Array.from({ length: width * count }, (_, i) => get(begin + 4 * i));
    };
    const positions = numbers(0, (at) => view.getFloat32(at, true), 3);
    for (const axis of [0, 1, 2]) {
      const values = positions.filter((_, i) => i % 3 === axis);
      expect(gltf.accessors[0]?.min?.[axis]).toBe(Math.min(...values));
      expect(gltf.accessors[0]?.max?.[axis]).toBe(Math.max(...values));
    }
    const read = (gltf.meshes[0]?.primitives ?? []).flatMap(({ indices }) =>
      numbers(indices, (at) => view.getUint32(at, true), 1),
    );
    expect(read).toHaveLength(mesh.triangles.length);
    expect(read.map((node) => positions.slice(3 * node, 3 * node + 3))).toEqual(
      [...mesh.triangles].map((node) => [...mesh.points.subarray(3 * node, 3 * node + 3)].map(Math.fround)),
    );
    expect(gltf.materials.map(({ name }) => name)[0]).toBe("in let");
  });
});

describe("OpenFOAM", () => {
  test("accepts the mesh: face order, owners, normals, closed cells, patches", async () => {
    const poly = readPolyMesh(await only("part.foam.zip"));
    expect(polyMeshDefects(poly)).toEqual([]);
    expect(poly.points).toEqual(
      Array.from({ length: mesh.points.length / 3 }, (_, i) =>
        [...mesh.points.subarray(3 * i, 3 * i + 3)].map((x) => x + 0),
      ),
    );
    expect(poly.patches.map(({ name, count }) => [name, count])).toEqual([
      ["in_let", 8],
      ["outlet", 8],
      ["_5th_wall", 8],
      ["outlet_patch_4_", 8],
      ["floor_cold", 8],
      ["patch_6", 8],
    ]);
    expect(poly.cellZones.map(({ name, cells }) => [name, cells.length])).toEqual([
      ["steel", 24],
      ["water_20_C_", 24],
    ]);
    // Each face belongs to the patch of its triangle.
    const patchOf = new Map(
      Array.from(mesh.trianglePatch, (patch, t) => [
        [...mesh.triangles.subarray(3 * t, 3 * t + 3)].sort((a, b) => a - b).join(" "),
        patch,
      ]),
    );
    poly.patches.forEach(({ begin, count }, patch) => {
      for (const face of poly.faces.slice(begin, begin + count)) {
        expect(patchOf.get([...face].sort((a, b) => a - b).join(" "))).toBe(patch);
      }
    });
  });

  test("gets an extra patch for faces without a patch, and face zones for patches between regions", async () => {
    const isBetween = (t: number) => mesh.trianglePatch[t] === 4;
    const kept = [...mesh.trianglePatch.keys()].filter((t) => !isBetween(t));
    // The plane between the regions: the faces that a tetrahedron of each region has.
    const half = (region: number) =>
      outerFaces(mesh.tetrahedra.filter((_, i) => mesh.tetrahedronRegion[i >> 2] === region));
    const upper = new Set(half(1).map((face) => [...face].sort((a, b) => a - b).join(" ")));
    const between = half(0).filter((face) => upper.has([...face].sort((a, b) => a - b).join(" ")));
    expect(between).toHaveLength(8);
    const poly = readPolyMesh(
      await only("part.foam.zip", {
        ...mesh,
        triangles: Uint32Array.from([
          ...kept.flatMap((t) => [...mesh.triangles.subarray(3 * t, 3 * t + 3)]),
          ...between.flat(),
        ]),
        trianglePatch: Uint32Array.from([
          ...kept.map((t) => mesh.trianglePatch[t] ?? 0),
          ...between.map(() => 4),
        ]),
      }),
    );
    expect(polyMeshDefects(poly)).toEqual([]);
    expect(poly.patches.at(-1)).toMatchObject({ name: "defaultFaces", count: 8 });
    const [zone] = poly.faceZones;
    expect(zone?.name).toBe("floor_cold");
    const zoneFaces =
      zone?.faces.map((f) => [...(poly.faces[f] ?? [])].sort((a, b) => a - b).join(" ")) ?? [];
    expect(zoneFaces.sort()).toEqual(between.map((face) => [...face].sort((a, b) => a - b).join(" ")).sort());
  });

  test("gets the right faces around a node shared by all elements", async () => {
    const sphere = sphereSurface(40);
    const count = sphere.triangles.length / 3;
    const star = {
      ...mesh,
      points: Float64Array.from([0, 0, 0, ...sphere.points]),
      triangles: sphere.triangles.map((node) => node + 1),
      trianglePatch: new Uint32Array(count),
      tetrahedra: Uint32Array.from({ length: 4 * count }, (_, i) =>
        i % 4 === 3 ? 0 : (sphere.triangles[3 * (i >> 2) + [0, 2, 1].indexOf(i % 4)] ?? 0) + 1,
      ),
      tetrahedronRegion: new Uint32Array(count),
    };
    const poly = readPolyMesh(await only("star.foam.zip", star));
    expect(polyMeshDefects(poly)).toEqual([]);
    expect([poly.neighbour.length, poly.faces.length]).toEqual([(3 * count) / 2, (5 * count) / 2]);
  });
});

test("SU2: markers hold each outer face once, and all indices are in range", async () => {
  const lines = (await text("part.su2")).split("\n");
  const section = (key: string, begin = 0) => {
    const at = lines.findIndex((line, i) => i >= begin && line.startsWith(`${key}=`));
    const count = Number(lines[at]?.split("=")[1]);
    return {
      at,
      count,
      rows: lines.slice(at + 1, at + 1 + count).map((line) => line.split(" ").map(Number)),
    };
  };
  expect(lines[0]).toBe("NDIME= 3");
  const elements = section("NELEM").rows;
  expect(elements.map(([type, , , , , number]) => [type, number])).toEqual(elements.map((_, e) => [10, e]));
  const tetrahedra = elements.flatMap((row) => row.slice(1, 5));
  expect(tetrahedra).toEqual([...mesh.tetrahedra]);
  expect(section("NPOIN").rows.map((row) => row[3])).toEqual(Array.from({ length: 27 }, (_, i) => i));
  const { at, count } = section("NMARK");
  expect(count).toBe(6);
  const tags = lines.filter((line) => line.startsWith("MARKER_TAG=")).map((line) => line.slice(12));
  expect(tags.every((tag) => /^\S+$/.test(tag))).toBe(true);
  expect(new Set(tags).size).toBe(6);
  const faces: string[] = [];
  for (let marker = 0, begin = at; marker < count; marker++) {
    const found = section("MARKER_ELEMS", begin);
    faces.push(...found.rows.map(([type, ...nodes]) => `${type} ${nodes.sort((a, b) => a - b).join(" ")}`));
    begin = found.at + 1;
  }
  expect(faces.sort()).toEqual(
    outerFaces(tetrahedra)
      .map((face) => `5 ${[...face].sort((a, b) => a - b).join(" ")}`)
      .sort(),
  );
});

describe("Abaqus", () => {
  /** Returns the data lines after each keyword line that matches. */
  const blocks = (file: string, keyword: RegExp) =>
    file
      .split(/^(?=\*)/m)
      .filter((block) => keyword.test(block))
      .map((block) => {
        const [head = "", ...rows] = block.trimEnd().split("\n");
        return { head, rows: rows.map((row) => row.split(",").map((word) => word.trim())) };
      });
  /** Corners of the faces of C3D4, from 1, by the manual. Seen from outside, they run clockwise. */
  const sides: Readonly<Record<string, readonly number[]>> = {
    S1: [1, 2, 3],
    S2: [1, 4, 2],
    S3: [2, 4, 3],
    S4: [3, 4, 1],
  };

  test("holds regions as sections and patches as surfaces of outward element faces", async () => {
    const file = await text("part.inp");
    const [nodes] = blocks(file, /^\*NODE\n/);
    expect(nodes?.rows.flatMap((row) => row.slice(1).map(Number))).toEqual(
      Array.from(mesh.points, (x) => x + 0),
    );
    const elements = new Map<string, number[]>();
    const sets = blocks(file, /^\*ELEMENT,/);
    for (const { rows } of sets) for (const [id = "", ...row] of rows) elements.set(id, row.map(Number));
    expect(sets.map(({ head, rows }) => [head.split("ELSET=")[1], rows.length])).toEqual([
      ["steel", 24],
      ["water_20_C_", 24],
    ]);
    expect(elements.size).toBe(48);
    expect(file).toMatch(/\*SOLID SECTION, ELSET=steel, MATERIAL=steel\n/);
    const outer = new Set(outerFaces(mesh.tetrahedra).map((face) => lowestFirst(face).join(" ")));
    const surfaces = blocks(file, /^\*SURFACE,/);
    expect(surfaces).toHaveLength(6);
    for (const { rows } of surfaces) {
      for (const [id = "", side = ""] of rows) {
        const corners = (sides[side] ?? [])
          .toReversed()
          .map((corner) => (elements.get(id)?.[corner - 1] ?? 0) - 1);
        expect(outer.delete(lowestFirst(corners).join(" ")), `${id} ${side}`).toBe(true);
      }
    }
    expect(outer.size).toBe(0);
    const nodeSets = blocks(file, /^\*NSET,/);
    expect(nodeSets.map(({ rows }) => rows.flat().length)).toEqual([9, 9, 9, 9, 9, 9]);
  });

  /** Rotates the nodes so that the lowest comes first; keeps the orientation. */
  function lowestFirst(face: readonly number[]): number[] {
    const at = face.indexOf(Math.min(...face));
    return [...face.slice(at), ...face.slice(0, at)];
  }
});

test("Nastran: writes coordinates with at least eight significant digits in fields of fixed width", async () => {
  const awkward = {
    ...mesh,
    points: mesh.points.map((x, i) => (i % 2 === 0 ? -x : x) * 10 ** ((i % 9) * 3 - 12)),
  };
  const lines = (await text("part.bdf", awkward)).split("\n");
  expect(Math.max(...lines.filter((line) => !line.startsWith("$")).map((line) => line.length))).toBeLessThan(
    74,
  );
  const read: number[] = [];
  lines.forEach((line, i) => {
    if (!line.startsWith("GRID*")) return;
    const fields = [line.slice(40, 56), line.slice(56, 72), (lines[i + 1] ?? "").slice(8, 24)];
    for (const field of fields) expect(field).toMatch(/^-?\d*\.\d*(E[+-]?\d+)? *$/);
    read.push(...fields.map(Number));
  });
  expect(read).toHaveLength(mesh.points.length);
  read.forEach((value, i) => {
    const expected = awkward.points[i] ?? NaN;
    expect(Math.abs(value - expected)).toBeLessThanOrEqual(1e-8 * Math.abs(expected));
  });
  const solids = lines
    .filter((line) => line.startsWith("CTETRA"))
    .map((line) => line.match(/\d+/g)?.map(Number));
  expect(solids.map((row) => row?.slice(2).map((node) => node - 1))).toEqual(
    Array.from({ length: 48 }, (_, t) => [...mesh.tetrahedra.subarray(4 * t, 4 * t + 4)]),
  );
  expect(lines.filter((line) => line.startsWith("CTRIA3"))).toHaveLength(48);
});

test("UGRID: the text and the binary file hold the same numbers", async () => {
  const words = (await text("part.ugrid")).trim().split(/\s+/).map(Number);
  const bytes = await only("part.b8.ugrid");
  const view = new DataView(bytes.buffer);
  const numbers: number[] = [];
  for (let at = 0; at < bytes.length;) {
    const isDouble = numbers.length >= 7 && numbers.length < 7 + 81;
    numbers.push(isDouble ? view.getFloat64(at) : view.getInt32(at));
    at += isDouble ? 8 : 4;
  }
  expect(numbers.map((value) => value + 0)).toEqual(words.map((value) => value + 0));
  expect(words.slice(0, 7)).toEqual([27, 48, 0, 48, 0, 0, 0]);
  const triangles = words.slice(88, 88 + 144).map((node) => node - 1);
  expect(triangles).toEqual([...mesh.triangles]);
  expect(words.slice(232, 280)).toEqual(Array.from(mesh.trianglePatch, (patch) => mesh.patches[patch]?.tag));
  expect(words.slice(280).map((node) => node - 1)).toEqual([...mesh.tetrahedra]);
});

test("a zip file holds the same three TetGen files that are written separately", async () => {
  const { unzipSync } = await import("fflate");
  const zipped = unzipSync(await only("part.tetgen.zip"));
  const separate = await files("part.node");
  expect(Object.keys(zipped).sort()).toEqual([...separate.keys()].sort());
  for (const [name, bytes] of separate) expect(zipped[name]).toEqual(bytes);
});

test("every format writes the same bytes for the same mesh", async () => {
  for (const { extensions, writable } of FILE_FORMATS) {
    if (writable.length === 0) continue;
    expect(await files(`a${extensions[0]}`)).toEqual(await files(`a${extensions[0]}`));
  }
});

test("every format writes an empty mesh", async () => {
  const empty = {
    ...mesh,
    points: new Float64Array(),
    triangles: new Uint32Array(),
    trianglePatch: new Uint32Array(),
    tetrahedra: new Uint32Array(),
    tetrahedronRegion: new Uint32Array(),
  };
  for (const { extensions, writable } of FILE_FORMATS) {
    if (writable.length > 0) expect((await writeMesh(empty, `a${extensions[0]}`)).length).toBeGreaterThan(0);
  }
});

test("writeMesh rejects a file name without a known format", async () => {
  for (const name of ["part.doc", "part.vtp", "part", ""]) {
    const failure: unknown = await writeMesh(mesh, name).catch((reason: unknown) => reason);
    expect(failure).toBeInstanceOf(MesherError);
    expect(failure).toMatchObject({
      code: "invalid-input",
      data: { diagnostics: [{ code: "unknown-format" }] },
    });
    expect(String(failure)).toContain(`"${name}"`);
  }
});

describe("extensions", () => {
  test("belong to one format each and begin with a dot", () => {
    const all = FILE_FORMATS.flatMap(({ extensions }) => extensions);
    expect(new Set(all).size).toBe(all.length);
    expect(all.every((extension) => /^\.[a-z0-9.]+$/.test(extension))).toBe(true);
  });

  test("are readable and writable exactly if the format has a reader and a writer", async () => {
    for (const { readable, writable, load } of FILE_FORMATS) {
      const { read, write } = await load();
      expect([read !== undefined, write !== undefined]).toEqual([readable.length > 0, writable.length > 0]);
    }
  });
});

test("readSurface rejects a volume without triangles and names the remedy", async () => {
  const bare = { ...mesh, triangles: new Uint32Array(), trianglePatch: new Uint32Array() };
  for (const extension of [".vtu", ".vtk", ".msh", ".msh2", ".mesh"]) {
    const file = await only(`part${extension}`, bare);
    const read = await readSurface(file, { fileName: `part${extension}` });
    expect(read.success ? "" : read.errors[0].message).toMatch(/48 tetrahedra but no triangles/);
    expect(read.success ? "" : read.errors[0].remedy).toMatch(/triangles of the boundary/);
  }
});

test("VTP: reads arrays deflated by another program", async () => {
  const numbers = (values: Float64Array | Int32Array) => {
    const bytes = Buffer.from(values.buffer);
    const block = deflateSync(bytes);
    const header = Buffer.from(Uint32Array.of(1, bytes.length, 0, block.length).buffer);
    return `format="binary">${header.toString("base64")}${block.toString("base64")}`;
  };
  const file = `<VTKFile type="PolyData" byte_order="LittleEndian" compressor="vtkZLibDataCompressor"><PolyData>
<Piece NumberOfPoints="5" NumberOfVerts="0" NumberOfLines="1" NumberOfStrips="1" NumberOfPolys="2">
<Points><DataArray type="Float64" NumberOfComponents="3" ${numbers(Float64Array.of(0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1))}</DataArray></Points>
<Lines><DataArray type="Int32" Name="connectivity" ${numbers(Int32Array.of(0, 1))}</DataArray><DataArray type="Int32" Name="offsets" ${numbers(Int32Array.of(2))}</DataArray></Lines>
<Strips><DataArray type="Int32" Name="connectivity" ${numbers(Int32Array.of(0, 1, 4, 2))}</DataArray><DataArray type="Int32" Name="offsets" ${numbers(Int32Array.of(4))}</DataArray></Strips>
<Polys><DataArray type="Int32" Name="connectivity" ${numbers(Int32Array.of(0, 3, 2, 1, 0, 4, 3))}</DataArray><DataArray type="Int32" Name="offsets" ${numbers(Int32Array.of(4, 7))}</DataArray></Polys>
<CellData><DataArray type="Int32" Name="patch" ${numbers(Int32Array.of(9, 1, 2, 3))}</DataArray></CellData>
</Piece></PolyData></VTKFile>`;
  const read = await readSurface(new TextEncoder().encode(file), { fileName: "part.vtp" });
  if (!read.success) throw new Error(read.errors[0].message);
  expect(taggedElements(read.value.triangles, 3, read.value.trianglePatch, read.value.patches)).toEqual(
    ["1: 0 3 2", "1: 0 2 1", "2: 0 4 3", "3: 0 1 4", "3: 4 1 2"].sort(),
  );
});
