/** Legacy VTK files with everything that VTK writes beside a mesh, as text and as big-endian binary. */
import { readMesh, type Mesh } from "tetrafront";
import { expect, test } from "vitest";

const encoder = new TextEncoder();

/** Part of a file; a DataView holds binary numbers. */
type Part = string | DataView;

function file(coding: "ASCII" | "BINARY", dataset: string, ...parts: readonly Part[]): Uint8Array {
  const head = `# vtk DataFile Version 4.2\ntest\n${coding}\nDATASET ${dataset}\n`;
  const bytes = [head, ...parts].map((part) =>
    typeof part === "string" ? encoder.encode(part) : new Uint8Array(part.buffer),
  );
  return new Uint8Array(bytes.flatMap((each) => [...each]));
}

function numbers(type: "Float64" | "Int32" | "Uint8", values: readonly number[]): DataView {
  const bytes = { Float64: 8, Int32: 4, Uint8: 1 }[type];
  const view = new DataView(new ArrayBuffer(bytes * values.length));
  values.forEach((value, i) => view[`set${type}`](bytes * i, value));
  return view;
}

/**
 * Returns text as VTK writes it in binary files: after its length, whose two highest bits encode how
 * many bytes the length has.
 */
function binaryText(text: string): DataView {
  const bytes = [...encoder.encode(text)];
  const length = bytes.length < 64 ? [0xc0 | bytes.length] : [0x80 | (bytes.length >> 8), bytes.length & 255];
  return numbers("Uint8", [...length, ...bytes]);
}

async function read(bytes: Uint8Array): Promise<Mesh> {
  const result = await readMesh(bytes, { fileName: "a.vtk" });
  if (!result.success) throw new Error(result.errors[0].message);
  return result.value;
}

const POINTS = [0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1];
const SIZES = [1, 2, 3, 4];

const text = file(
  "ASCII",
  "UNSTRUCTURED_GRID",
  "FIELD FieldData 2\nmade%20by 1 2 string\nNaN POINTS 9\nsecond\nTimeValue 1 1 double\n0.5\nMETADATA\nINFORMATION 0\n\n",
  `POINTS 4 double\n${POINTS.join(" ")}\nCELLS 3 9\n4 0 1 2 3\n0\n2 0 1\nCELL_TYPES 3\n10\n0\n3\n`,
  "CELL_DATA 3\nSCALARS colour unsigned_char 1\nLOOKUP_TABLE mine\n1 2 3\nLOOKUP_TABLE mine 2\n0 0 0 1 1 1 1 0.5\n",
  "COLOR_SCALARS more 3\n0 0 1 0 1 0 1 0 0\nGLOBAL_IDS ids vtkIdType\n7 8 9\n",
  "FIELD FieldData 2\nregion 1 3 int\n5 6 6\nflags 1 3 bit\n0 1 1\n",
  "POINT_DATA 4\nTEXTURE_COORDINATES uv 2 float\n0 0 0 1 1 0 1 1\nSCALARS Gr%C3%B6%C3%9Fe double\nLOOKUP_TABLE default\n",
  "nan -inf 1 2\nTENSORS6 t double\n1 2 3 4 5 6\n1 2 3 4 5 6\n1 2 3 4 5 6\n1 2 3 4 5 6\n",
  `FIELD FieldData 1\nsize 1 4 double\n${SIZES.join(" ")}\n`,
);

const binary = file(
  "BINARY",
  "UNSTRUCTURED_GRID",
  "FIELD FieldData 1\nmade%20by 1 2 string\n",
  binaryText("a\nb"),
  binaryText("POINTS ".repeat(20)),
  "\nPOINTS 4 double\n",
  numbers("Float64", POINTS),
  "\nCELLS 1 5\n",
  numbers("Int32", [4, 0, 1, 2, 3]),
  "\nCELL_TYPES 1\n",
  numbers("Int32", [10]),
  "\nCELL_DATA 1\nSCALARS colour unsigned_char 1\nLOOKUP_TABLE mine\n",
  numbers("Uint8", [1]),
  "\nLOOKUP_TABLE mine 1\n",
  numbers("Uint8", [10, 10, 10, 10]),
  "\nCOLOR_SCALARS more 3\n",
  numbers("Uint8", [10, 10, 10]),
  "\nFIELD FieldData 1\nregion 1 1 int\n",
  numbers("Int32", [5]),
  "\nPOINT_DATA 4\nSCALARS flags bit 1\nLOOKUP_TABLE default\n",
  numbers("Uint8", [0b01100000]),
  "\nFIELD FieldData 1\nsize 1 4 double\n",
  numbers("Float64", SIZES),
  "\n",
);

test.each([
  ["text", text],
  ["binary", binary],
])("%s: skips all other data and reads everything after it", async (_, bytes) => {
  const mesh = await read(bytes);
  expect([...mesh.points]).toEqual(POINTS);
  expect([...mesh.tetrahedra]).toEqual([0, 1, 2, 3]);
  expect(mesh.regions.map(({ tag }) => tag)).toEqual([5]);
  expect([...(mesh.nodeData.get("size")?.values ?? [])]).toEqual(SIZES);
});

test("values at nodes can be NaN, bits are read as numbers, and encoded names are decoded", async () => {
  expect([...((await read(text)).nodeData.get("Größe")?.values ?? [])]).toEqual([NaN, -Infinity, 1, 2]);
  expect([...((await read(binary)).nodeData.get("flags")?.values ?? [])]).toEqual([0, 1, 1, 0]);
});

test("cell data refer to lines, polygons and strips, in any order of these sections", async () => {
  const lines = "LINES 1 3\n2 0 1\n";
  const strips = "TRIANGLE_STRIPS 1 4\n3 1 2 3\n";
  const polygons = "POLYGONS 1 4\n3 0 1 2\n";
  const data = "CELL_DATA 3\nSCALARS patch int\nLOOKUP_TABLE default\n1 2 3\n";
  for (const sections of [lines + polygons + strips, strips + polygons + lines]) {
    const bytes = file("ASCII", "POLYDATA", `POINTS 4 float\n${POINTS.join(" ")}\n${sections}${data}`);
    const { triangles, trianglePatch, patches } = await read(bytes);
    const taggedTriangles = Array.from(trianglePatch, (patch, t) => [
      patches[patch]?.tag,
      ...triangles.subarray(3 * t, 3 * t + 3),
    ]);
    expect(taggedTriangles).toEqual([
      [2, 0, 1, 2],
      [3, 1, 2, 3],
    ]);
  }
});

test.each([
  ["too few values at the nodes", "POINT_DATA 3\n", /line \d+: the file has 4 points, but data for 3/],
  [
    "an array of another length",
    "POINT_DATA 4\nFIELD a 1\nsize 1 3 int\n1 2 3\n",
    /"size" has 3 rows, but the number of points is 4/,
  ],
  [
    "a cell without a group",
    "CELL_DATA 0\nFIELD a 1\nregion 1 0 int\n",
    /cell 0 .* has no value of "region"/,
  ],
])("rejects %s", async (_, data, message) => {
  const mesh = `POINTS 4 double\n${POINTS.join(" ")}\nCELLS 1 5\n4 0 1 2 3\nCELL_TYPES 1\n10\n`;
  await expect(read(file("ASCII", "UNSTRUCTURED_GRID", mesh, data))).rejects.toThrow(message);
});

test("a word that only begins like NaN or infinity is not a number", async () => {
  const field = (values: string) =>
    `POINTS 4 double\n${POINTS.join(" ")}\nCELLS 1 5\n4 0 1 2 3\nCELL_TYPES 1\n10\nPOINT_DATA 4\nFIELD f 1\nsize 1 4 double\n${values}\n`;
  const bytes = (values: string) => file("ASCII", "UNSTRUCTURED_GRID", field(values));
  const mesh = await read(bytes("1 -Infinity nan(ind) 4"));
  expect([...(mesh.nodeData.get("size")?.values ?? [])]).toEqual([1, -Infinity, NaN, 4]);
  await expect(read(bytes("1 2 information 4"))).rejects.toThrow("information");
});
