/** Files written by other programs, with content that formats allow beside a plain mesh. */
import { readMesh, writeMesh, type Mesh } from "tetrafront";
import { describe, expect, test } from "vitest";

import { Column } from "../../../wasm/src/formats/column.js";
import { blockMesh } from "../../support/block-mesh.js";
import { offBinary, plyStrips, stlBinary } from "../../support/surface-files.js";
import { boxSurface } from "../../support/surfaces.js";

async function read(file: string | Uint8Array, fileName: string): Promise<Mesh> {
  const bytes = typeof file === "string" ? new TextEncoder().encode(file) : file;
  const result = await readMesh(bytes, { fileName });
  if (!result.success) throw new Error(result.errors[0].message);
  return result.value;
}

describe("Gmsh 2.2: nodes with parametric coordinates are read", () => {
  /** Tag, position, dimension, entity, and one or two parameters on a line or a face. */
  const nodes: readonly (readonly number[])[] = [
    [1, 0, 0, 0, 0, 1],
    [2, 1, 0, 0, 1, 5, 0.25],
    [3, 0, 1, 0, 2, 6, 0.5, 0.75],
    [4, 0, 0, 1, 3, 1],
  ];
  const positions = nodes.flatMap((row) => row.slice(1, 4));

  test("from text", async () => {
    const rows = nodes.map((row) => row.join(" ")).join("\n");
    const file = `$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$ParametricNodes\n4\n${rows}\n$EndParametricNodes
$Elements\n2\n1 2 2 5 1 1 2 3\n2 4 2 7 1 1 2 3 4\n$EndElements\n`;
    const mesh = await read(file, "a.msh");
    expect([...mesh.points]).toEqual(positions);
    expect([...mesh.triangles, ...mesh.tetrahedra]).toEqual([0, 1, 2, 0, 1, 2, 3]);
  });

  test("from binary", async () => {
    const ints = (...values: number[]) => Buffer.from(Int32Array.from(values).buffer);
    const doubles = (values: readonly number[]) => Buffer.from(Float64Array.from(values).buffer);
    const rows = nodes.flatMap(([tag = 0, x = 0, y = 0, z = 0, dimension = 0, entity = 0, ...parameters]) => [
      ints(tag),
      doubles([x, y, z]),
      ints(dimension, entity),
      doubles(parameters),
    ]);
    const file = Buffer.concat([
      Buffer.from("$MeshFormat\n2.2 1 8\n"),
      ints(1),
      Buffer.from("\n$EndMeshFormat\n$ParametricNodes\n4\n"),
      ...rows,
      Buffer.from("\n$EndParametricNodes\n$Elements\n1\n"),
      ints(4, 1, 2, 1, 7, 1, 1, 2, 3, 4),
      Buffer.from("\n$EndElements\n"),
    ]);
    const mesh = await read(file, "a.msh");
    expect([...mesh.points]).toEqual(positions);
    expect([...mesh.tetrahedra]).toEqual([0, 1, 2, 3]);
  });
});

test("Gmsh 2.2: a tetrahedron in several physical groups is read once", async () => {
  const nodes = "$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n$EndNodes";
  const elements = ["4 2 7 1 1 2 3 4", "4 2 8 1 1 2 3 4", "4 2 9 1 1 2 3 4"];
  const file = (rows: readonly string[]) =>
    `$MeshFormat\n2.2 0 8\n$EndMeshFormat\n${nodes}\n$Elements\n${rows.length}\n${rows
      .map((row, e) => `${e + 1} ${row}\n`)
      .join("")}$EndElements\n`;
  const mesh = await read(file(elements), "a.msh");
  expect([...mesh.tetrahedra]).toEqual([0, 1, 2, 3]);
  expect(mesh.regions.map(({ tag }) => tag)).toEqual([7]);
  expect(mesh.duplicateTetrahedra).toBe(2);
  // The duplicates can be anywhere in the file, with their nodes in any order.
  const triangles = ["2 2 3 1 1 3 2", "2 2 4 2 2 1 3", "2 2 3 1 1 2 4", "2 2 3 9 3 2 1"];
  const apart = [elements[0] ?? "", ...triangles, "4 2 8 1 2 1 3 4"];
  const both = await read(file(apart), "a.msh");
  expect([...both.tetrahedra]).toEqual([0, 1, 2, 3]);
  expect([...both.triangles]).toEqual([0, 2, 1, 0, 1, 3]);
  expect(both.patches.map(({ tag }) => tag)).toEqual([3]);
  expect([both.duplicateTetrahedra, both.duplicateTriangles]).toEqual([1, 2]);
  const quadrilaterals = await read(file(["3 2 1 1 1 2 3 4", "3 2 2 1 1 2 3 4"]), "a.msh");
  expect([quadrilaterals.triangles.length, quadrilaterals.duplicateTriangles]).toEqual([6, 1]);
  // A duplicate in the same group is a defect of the mesh; its inspection reports it.
  const twice = await read(file([elements[0] ?? "", elements[0] ?? ""]), "a.msh");
  expect(twice.tetrahedra).toHaveLength(8);
});

test("Gmsh: notes name the groups that lose elements shared by several groups, in both versions", async () => {
  const names = '$PhysicalNames\n3\n2 3 "inlet"\n2 4 "wetted"\n3 7 "fluid"\n$EndPhysicalNames';
  const lost = [
    'elements in several physical groups stay only in their first; dropped: 2 triangles of "wetted"',
    "elements in several physical groups stay only in their first; dropped: 1 tetrahedron of group 8",
  ];
  const rows = [
    ...["2 2 3 1 1 3 2", "2 2 4 1 1 3 2", "2 2 3 1 1 2 4", "2 2 4 1 1 2 4"],
    ...["4 2 7 1 1 2 3 4", "4 2 8 1 1 2 3 4"],
  ].map((row, e) => `${e + 1} ${row}`);
  const positions = ["0 0 0", "1 0 0", "0 1 0", "0 0 1"];
  const listed = `$Nodes\n4\n${positions.map((position, n) => `${n + 1} ${position}`).join("\n")}\n$EndNodes`;
  const old = `$MeshFormat\n2.2 0 8\n$EndMeshFormat\n${names}\n${listed}\n$Elements\n6\n${rows.join("\n")}\n$EndElements\n`;
  const entities = "$Entities\n0 0 1 1\n1 0 0 0 1 1 1 2 3 -4 0\n1 0 0 0 1 1 1 2 7 8 1 1\n$EndEntities";
  const nodes = `$Nodes\n1 4 1 4\n3 1 0 4\n1\n2\n3\n4\n${positions.join("\n")}\n$EndNodes`;
  const elements = "$Elements\n2 3 1 3\n2 1 2 2\n1 1 3 2\n2 1 2 4\n3 1 4 1\n3 1 2 3 4\n$EndElements";
  const blocks = `$MeshFormat\n4.1 0 8\n$EndMeshFormat\n${names}\n${entities}\n${nodes}\n${elements}\n`;
  for (const file of [old, blocks]) {
    const mesh = await read(file, "a.msh");
    expect(mesh.patches.map(({ name }) => name)).toEqual(["inlet"]);
    expect(mesh.regions.map(({ name }) => name)).toEqual(["fluid"]);
    expect(mesh.notes).toEqual(lost);
  }
});

test("Medit: skips sections about geometry, and rejects other volume elements only if there are any", async () => {
  const head =
    'MeshVersionFormatted 2\nDimension 3\nIdentifier "a part"\nGeometry\n"a.geo"\nVertices 3\n0 0 0 0\n1 0 0 0\n0 1 0 0\n';
  const others =
    "BoundingBox\n0 1 0 1 0 0\nAngleOfCornerBound 10\nVertexOnGeometricVertex\n1\n1 1\nHexahedra\n0\n" +
    "SubDomainFromMesh\n1\n3 1 1 1\nNormalAtTriangleVertices\n1\n1 1 1\n";
  const { triangles } = await read(`${head}${others}Triangles\n1\n1 2 3 4\nEnd\n`, "a.mesh");
  expect([...triangles]).toEqual([0, 1, 2]);
  await expect(read(`${head}Hexahedra\n1\n1 2 3 1 2 3 1 2 0\nEnd\n`, "a.mesh")).rejects.toThrow(
    /has hexahedra; only linear/,
  );
});

test("OBJ: an empty line ends a continued line", async () => {
  const { triangles } = await read("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 \\\n3 \\\n\nf 3 2 1\n", "a.obj");
  expect([...triangles]).toEqual([0, 1, 2, 2, 1, 0]);
});

test("STL: reads triangles beyond the announced count, rejects other content, and skips zero padding", async () => {
  const file = stlBinary(boxSurface(1));
  const fewer = file.slice();
  new DataView(fewer.buffer).setUint32(80, 5, true);
  expect((await read(fewer, "a.stl")).triangles).toHaveLength(36);
  const cut = fewer.subarray(0, -7);
  await expect(read(cut, "a.stl")).rejects.toThrow(/byte 334: the file continues after the 5 triangles/);
  const filled = new Uint8Array(2048);
  filled.set(file);
  expect((await read(filled, "a.stl")).triangles).toHaveLength(36);
});

test("Medit: skips sections added by other programs, whatever numbers they hold", async () => {
  const head = "MeshVersionFormatted 2\nDimension 3\nVertices 3\n0 0 0 0\n1 0 0 0\n0 1 0 0\n";
  const more = "TangentAtEdgeVertices\n1\n1 1 1\nPeriodicVertices\n1\n1 2\nEdgesP2\n1\n1 2 3 0\nTime\n0.5\n";
  expect([...(await read(`${head}${more}Triangles\n1\n1 2 3 4\nEnd`, "a.mesh")).triangles]).toEqual([
    0, 1, 2,
  ]);
  await expect(read(`${head}TetrahedraP2\n1\n1\n`, "a.mesh")).rejects.toThrow(
    /has tetrahedrap2; only linear/,
  );
  await expect(read(`${head}Triangels\n1\n1 2 3 4\n`, "a.mesh")).rejects.toThrow(
    /unknown section "triangels"/,
  );
});

test("PLY: every second triangle of a strip is reversed, and -1 ends a strip", async () => {
  for (const isLast of [false, true]) {
    const { triangles } = await read(plyStrips([0, 1, 2, 3, -1, 3, 2, 4, 4, 0], isLast), "a.ply");
    expect([...triangles]).toEqual([0, 1, 2, 2, 1, 3, 3, 2, 4]);
  }
  await expect(read(plyStrips([0, 1, 5], false), "a.ply")).rejects.toThrow(
    /has corner 5, but the file has 5 points/,
  );
});

test("PLY: a strip can be longer than the limit for other entries", async () => {
  const corners = Array.from({ length: 200_000 }, (_, i) => i % 5);
  expect((await read(plyStrips(corners, false), "a.ply")).triangles).toHaveLength(3 * (corners.length - 2));
});

test("OFF: reads binary files like text, and skips normals, colours and texture coordinates", async () => {
  const box = boxSurface(2);
  for (const [word, extras] of [
    ["OFF", 0],
    ["STCNOFF", 9],
  ] as const) {
    const { points, triangles, patches } = await read(offBinary(box, word, extras), "a.off");
    expect([points, triangles]).toEqual([box.points, box.triangles]);
    expect(patches.map(({ name }) => name)).toEqual(["#ff8000"]);
  }
});

test.each([".msh", ".msh2", ".mesh", ".vtk", ".off", ".ply"])(
  "%s: rejects a second mesh after the first in one file",
  async (extension) => {
    const [file] = await writeMesh(blockMesh(), `a${extension}`);
    const bytes = Buffer.from(file?.bytes ?? []);
    // A Medit file ends at the keyword End, so join the meshes without it.
    const one = extension === ".mesh" ? bytes.subarray(0, bytes.lastIndexOf("\nEnd")) : bytes;
    const end = extension === ".mesh" ? one.subarray(one.indexOf("Vertices")) : one;
    await expect(read(Buffer.concat([one, Buffer.from("\n"), end]), `a${extension}`)).rejects.toThrow();
  },
);

test("files beyond the index range or the memory are rejected", async () => {
  const column = new Column(Uint32Array, 10_000);
  const fill = () => {
    for (let i = 0; i < 20_000; i++) column.push(i);
  };
  expect(fill).toThrow(/more than 3333 points or triangles, or 2500 tetrahedra/);
  const source = (function* () {
    yield new TextEncoder().encode("OFF 1 1 0\n");
    throw new RangeError("Array buffer allocation failed");
  })();
  expect(await readMesh(source, { fileName: "a.off" })).toMatchObject({
    success: false,
    errors: [{ code: "too-large-file", fileName: "a.off" }],
  });
});
