/**
 * Requirements of solvers: markers on the boundary only, conforming elements, and a note on each exception.
 */
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import path from "node:path";

import { MesherError, writeMesh, type Mesh, type WrittenFile } from "tetrafront";
import { expect, test, vi } from "vitest";

import { blockMesh, outerFaces } from "../../support/block-mesh.js";
import { tetrafront } from "../../support/command-line.js";
import { polyMeshDefects, readPolyMesh } from "../../support/poly-mesh.js";

const block = blockMesh();
const keyOf = (face: ArrayLike<number>) =>
  Array.from(face)
    .sort((a, b) => a - b)
    .join(" ");

/** Returns the faces shared by elements of different regions, oriented as in one of the two elements. */
function interfaceFaces({ tetrahedra, tetrahedronRegion }: Mesh): number[][] {
  const first = new Map<string, number>();
  const interfaces: number[][] = [];
  tetrahedronRegion.forEach((region, t) => {
    const nodes = [...tetrahedra.subarray(4 * t, 4 * t + 4)];
    for (let f = 0; f < 4; f++) {
      const face = nodes.filter((_, i) => i !== f);
      const other = first.get(keyOf(face));
      if (other !== undefined && other !== region) interfaces.push(face);
      first.set(keyOf(face), region);
    }
  });
  return interfaces;
}

const interfaces = interfaceFaces(block);
const outer = outerFaces(block.tetrahedra).map(keyOf).sort();

function withTriangles(mesh: Mesh, added: readonly number[][], name: string): Mesh {
  const owners = added.map(() => mesh.patches.length);
  return {
    ...mesh,
    triangles: Uint32Array.from([...mesh.triangles, ...added.flat()]),
    trianglePatch: Uint32Array.from([...mesh.trianglePatch, ...owners]),
    patches: [...mesh.patches, { name, tag: 50 }],
  };
}

const withInterface = withTriangles(block, interfaces, "baffle");

async function written(mesh: Mesh, fileName: string): Promise<WrittenFile> {
  const [file] = await writeMesh(mesh, fileName);
  if (file === undefined) throw new Error("nothing was written");
  return file;
}

const textOf = ({ bytes }: WrittenFile) => new TextDecoder().decode(bytes);
const notesOf = ({ notes }: WrittenFile) => notes.map(({ message }) => message).join("\n");

/** Returns the faces of each marker by the marker's name. */
function markersOf(file: WrittenFile): Map<string, string[]> {
  const markers = new Map<string, string[]>();
  let own: string[] = [];
  for (const line of textOf(file).split("\n")) {
    if (line.startsWith("MARKER_TAG= ")) markers.set(line.slice(12), (own = []));
    if (line.startsWith("5 ")) own.push(keyOf(line.split(" ").slice(1).map(Number)));
  }
  return markers;
}

/** Returns three node indices (from 0) and a tag per triangle. */
function ugridFaces(file: WrittenFile): { face: number[]; tag: number }[] {
  const lines = textOf(file)
    .trim()
    .split("\n")
    .map((line) => line.split(" ").map(Number));
  const [points = 0, triangles = 0] = lines[0] ?? [];
  return Array.from({ length: triangles }, (_, t) => ({
    face: (lines[1 + points + t] ?? []).map((node) => node - 1),
    tag: lines[1 + points + triangles + t]?.[0] ?? NaN,
  }));
}

test("the test block has an interface", () => expect(interfaces).toHaveLength(8));

test("SU2: an interface is not written as a marker, and a note reports it", async () => {
  const file = await written(withInterface, "a.su2");
  const markers = markersOf(file);
  expect([...markers.values()].flat().sort()).toEqual(outer);
  expect([...markers.keys()]).not.toContain("baffle");
  expect(notesOf(file)).toMatch(/Left out: 8 triangles with a tetrahedron on both sides, of "baffle"/);
  expect(notesOf(file)).toMatch(/2 regions/);
  expect(file.notes[0]).toMatchObject({ code: "left-out", severity: "information" });
});

test("UGRID: the triangles are the boundary, oriented outward, without the interface", async () => {
  for (const name of ["a.ugrid", "a.b8.ugrid"]) {
    expect(notesOf(await written(withInterface, name))).toMatch(/Left out: .* of "baffle"/);
  }
  const lowestFirst = (face: readonly number[]) => {
    const at = face.indexOf(Math.min(...face));
    return [...face.slice(at), ...face.slice(0, at)].join(" ");
  };
  const file = await written(withInterface, "a.ugrid");
  expect(
    ugridFaces(file)
      .map(({ face }) => lowestFirst(face))
      .sort(),
  ).toEqual(outerFaces(block.tetrahedra).map(lowestFirst).sort());
  expect(notesOf(file)).toMatch(/names are left out.*7 for "in let"/i);
});

test("OpenFOAM: no map has an entry per face (a map holds at most 2^24 entries)", async () => {
  const set = vi.spyOn(Map.prototype, "set");
  try {
    await written(withInterface, "a.foam.zip");
    expect(set.mock.calls.length).toBeLessThan(block.tetrahedra.length / 4);
  } finally {
    set.mockRestore();
  }
});

test("OpenFOAM: an interface is a face zone and not part of the boundary", async () => {
  const file = await written(withInterface, "a.foam.zip");
  const poly = readPolyMesh(file.bytes);
  expect(polyMeshDefects(poly)).toEqual([]);
  expect(poly.faces.length - poly.neighbour.length).toBe(outer.length);
  expect(notesOf(file)).not.toMatch(/left out/);
});

test("Abaqus: an interface has a surface for each side", async () => {
  const lines = textOf(await written(withInterface, "a.inp")).split("\n");
  const rowsOf = (name: string) => {
    const begin = lines.indexOf(`*SURFACE, NAME=${name}, TYPE=ELEMENT`) + 1;
    expect(begin).toBeGreaterThan(0);
    return lines.slice(
      begin,
      lines.findIndex((line, i) => i >= begin && line.startsWith("*")),
    );
  };
  const sides = [rowsOf("baffle_FACES"), rowsOf("baffle_BACK")];
  const elements = sides.map((rows) => rows.map((row) => Number(row.split(",")[0])));
  expect(elements.map((own) => own.length)).toEqual([8, 8]);
  expect(elements[0]?.filter((element) => elements[1]?.includes(element))).toEqual([]);
  expect(lines.filter((line) => /_BACK/.test(line))).toHaveLength(1);
});

test("boundary faces without a patch get an extra one, triangles without an element are left out, and notes report both", async () => {
  const gap = {
    ...block,
    triangles: block.triangles.subarray(3),
    trianglePatch: block.trianglePatch.subarray(1),
  };
  const odd = withTriangles(gap, [[0, 13, 26]], "loose");
  const su2 = await written(odd, "a.su2");
  expect(markersOf(su2).get("unnamed_faces")).toEqual([keyOf(block.triangles.subarray(0, 3))]);
  expect([...markersOf(su2).values()].flat().sort()).toEqual(outer);
  const tags = ugridFaces(await written(odd, "a.ugrid")).map(({ tag }) => tag);
  expect(tags.filter((tag) => !block.patches.some((patch) => patch.tag === tag))).toEqual([51]);
  for (const file of [su2, await written(odd, "a.foam.zip")]) {
    expect(notesOf(file)).toMatch(/Left out: 1 triangle without a tetrahedron/);
    expect(notesOf(file)).toMatch(/Added to ".*": 1 boundary face without a patch/);
  }
});

test("duplicate triangles are written once, and a note reports them", async () => {
  const twice = withTriangles(
    block,
    [[...block.triangles.subarray(0, 3)], interfaces[0] ?? [], interfaces[0] ?? []],
    "more",
  );
  const su2 = await written(twice, "a.su2");
  expect([...markersOf(su2).values()].flat().sort()).toEqual(outer);
  const foam = await written(twice, "a.foam.zip");
  const poly = readPolyMesh(foam.bytes);
  expect(polyMeshDefects(poly)).toEqual([]);
  expect(poly.faces.length - poly.neighbour.length).toBe(outer.length);
  for (const file of [su2, foam]) expect(notesOf(file)).toMatch(/Left out: 2 duplicate triangles/);
});

test("an element so thin that rounding decides its orientation is accepted", async () => {
  const corners = [
    [0, 0, 0],
    [1, 0.3, 0.1],
    [0.2, 1, 0.7],
  ] as const;
  for (let i = 1; i < 30; i++) {
    const inside = [0, 1, 2].map((axis) =>
      corners.reduce((sum, at) => sum + at[axis as 0 | 1 | 2] / (i + 2), 0),
    );
    const points = Float64Array.from([...corners.flat(), ...inside]);
    for (const nodes of [
      [0, 1, 2, 3],
      [1, 0, 2, 3],
    ]) {
      const thin = {
        ...block,
        points,
        tetrahedra: Uint32Array.from(nodes),
        tetrahedronRegion: new Uint32Array(1),
        triangles: new Uint32Array(),
        trianglePatch: new Uint32Array(),
      };
      expect(textOf(await written(thin, "a.su2"))).toMatch(/NELEM= 1/);
    }
  }
});

const tetrahedron = (t: number) => [...block.tetrahedra.subarray(4 * t, 4 * t + 4)];
const [a = 0, b = 0, c = 0, d = 0] = tetrahedron(5);
const FLAWS: readonly (readonly [string, number[], RegExp])[] = [
  ["that is a duplicate", [a, b, c, d], /5, 48 .*same side|48.*share/],
  ["that is inverted", [b, a, c, d], /tetrahedron 48 .*inverted/i],
  ["without volume", [a, b, c, c], /tetrahedron 48 .*without volume/i],
];

test.each(FLAWS)("solver formats reject an element %s and name its index", async (_, nodes, message) => {
  const flawed = {
    ...block,
    tetrahedra: Uint32Array.from([...block.tetrahedra, ...nodes]),
    tetrahedronRegion: Uint32Array.from([...block.tetrahedronRegion, 0]),
  };
  for (const name of ["a.su2", "a.ugrid", "a.b8.ugrid", "a.foam.zip"]) {
    const failure: unknown = await writeMesh(flawed, name).catch((reason: unknown) => reason);
    if (!(failure instanceof MesherError) || failure.code !== "invalid-input") {
      throw new Error(`${name} was written`);
    }
    const { diagnostics } = failure.data;
    expect(diagnostics.every(({ code }) => code === "invalid-mesh")).toBe(true);
    expect(diagnostics.map((found) => found.message).join("\n")).toMatch(message);
  }
  expect((await writeMesh(flawed, "a.vtu")).length).toBe(1);
});

test("convert rejects a duplicate element for a solver format and warns about it for other formats", async () => {
  const folder = mkdtempSync(path.join(tmpdir(), "tetrafront-"));
  try {
    const head =
      "MeshVersionFormatted 2\nDimension 3\nVertices\n5\n0 0 0 0\n1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 -1 0\n";
    const rows = ["1 2 3 4 1", "2 1 3 5 1", "1 2 3 4 1"].join("\n");
    writeFileSync(path.join(folder, "a.mesh"), `${head}Tetrahedra\n3\n${rows}\nEnd\n`);
    const solver = await tetrafront(folder, ["convert", "a.mesh", "-o", "a.su2"]);
    expect(solver.code).toBe(2);
    expect(solver.stderr).toMatch(/error: a\.mesh: .*2 \(counted from 0\).*share/i);
    const other = await tetrafront(folder, ["convert", "a.mesh", "-o", "a.vtu"]);
    expect(other.code).toBe(0);
    expect(other.stderr).toMatch(/warning: a\.mesh: .*2 \(counted from 0\).*share/i);
  } finally {
    rmSync(folder, { recursive: true, force: true });
  }
});
