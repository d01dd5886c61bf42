/** Files as other programs write them, with what formats allow beside a plain mesh. */
import { readMesh, type FileMesh } from "tetrafront";
import { describe, expect, test } from "vitest";

import { stlBinary } from "../../support/surface-files.js";
import { boxSurface } from "../../support/surfaces.js";

async function read(file: string | Uint8Array, fileName: string): Promise<FileMesh> {
  const bytes = typeof file === "string" ? new TextEncoder().encode(file) : file;
  const result = await readMesh(bytes, { fileName });
  if (!result.success) throw new Error(result.problems[0].message);
  return result.value;
}

describe("Gmsh 2.2 with places on lines and faces", () => {
  /** Number, place, dimension, entity, and one or two numbers on a line or a face. */
  const nodes: readonly (readonly number[])[] = [
    [1, 0, 0, 0, 0, 1],
    [2, 1, 0, 0, 1, 5, 0.25],
    [3, 0, 1, 0, 2, 6, 0.5, 0.75],
    [4, 0, 0, 1, 3, 1],
  ];
  const places = nodes.flatMap((row) => row.slice(1, 4));

  test("as text", async () => {
    const rows = nodes.map((row) => row.join(" ")).join("\n");
    const file = `$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$ParametricNodes\n4\n${rows}\n$EndParametricNodes
$Elements\n2\n1 2 2 5 1 1 2 3\n2 4 2 7 1 1 2 3 4\n$EndElements\n`;
    const mesh = await read(file, "a.msh");
    expect([...mesh.points]).toEqual(places);
    expect([...mesh.triangles, ...mesh.tetrahedra]).toEqual([0, 1, 2, 0, 1, 2, 3]);
  });

  test("as numbers", async () => {
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
    expect([...mesh.points]).toEqual(places);
    expect([...mesh.tetrahedra]).toEqual([0, 1, 2, 3]);
  });
});

test("Medit: sections about geometry are passed over, and other volumes only matter where there are some", async () => {
  const head =
    'MeshVersionFormatted 2\nDimension 3\nIdentifier "a part"\nGeometry\n"a.geo"\nVertices 3\n0 0 0 0\n1 0 0 0\n0 1 0 0\n';
  const others =
    "BoundingBox\n0 1 0 1 0 0\nAngleOfCornerBound 10\nVertexOnGeometricVertex\n1\n1 1\nHexahedra\n0\n" +
    "SubDomainFromMesh\n1\n3 1 1 1\nNormalAtTriangleVertices\n1\n1 1 1\n";
  const { triangles } = await read(`${head}${others}Triangles\n1\n1 2 3 4\nEnd\n`, "a.mesh");
  expect([...triangles]).toEqual([0, 1, 2]);
  await expect(read(`${head}Hexahedra\n1\n1 2 3 1 2 3 1 2 0\nEnd\n`, "a.mesh")).rejects.toThrow(
    /hexahedra cannot/,
  );
});

test("OBJ: a line that is continued by an empty one ends there", async () => {
  const { triangles } = await read("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 \\\n3 \\\n\nf 3 2 1\n", "a.obj");
  expect([...triangles]).toEqual([0, 1, 2, 2, 1, 0]);
});

test("STL: triangles beyond the number announced are not left out silently; zeros that fill a block are", async () => {
  const file = stlBinary(boxSurface(1));
  const fewer = file.slice();
  new DataView(fewer.buffer).setUint32(80, 5, true);
  await expect(read(fewer, "a.stl")).rejects.toThrow(/byte 334: the file goes on behind the 5 triangles/);
  const filled = new Uint8Array(2048);
  filled.set(file);
  expect((await read(filled, "a.stl")).triangles).toHaveLength(36);
});
