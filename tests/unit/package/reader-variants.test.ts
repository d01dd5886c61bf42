/** What other programs write: STL texts and binaries, Fortran numbers, Latin-1 names, counts that disagree. */
import { readSurface, type ReadError, type Mesh } from "tetrafront";
import { describe, expect, test } from "vitest";

import { stlBinary } from "../../support/surface-files.js";
import { boxSurface } from "../../support/surfaces.js";

async function surfaceIn(file: string | Uint8Array, fileName: string): Promise<Mesh> {
  const bytes = typeof file === "string" ? new TextEncoder().encode(file) : file;
  const read = await readSurface(bytes, { fileName });
  if (!read.success) throw new Error(read.errors[0].message);
  return read.value;
}

async function errorIn(file: string | Uint8Array, fileName: string): Promise<ReadError> {
  const bytes = typeof file === "string" ? new TextEncoder().encode(file) : file;
  const read = await readSurface(bytes, { fileName });
  if (read.success) throw new Error(`${fileName} was read`);
  return read.errors[0];
}

const box = boxSurface(1);
const corners = Array.from({ length: 12 }, (_, t) =>
  [0, 1, 2].map((corner) => {
    const node = box.triangles[3 * t + corner] ?? 0;
    return [...box.points.subarray(3 * node, 3 * node + 3)];
  }),
);

interface TextStyle {
  readonly number?: (x: number) => string;
  readonly normal?: string;
  readonly ends?: readonly [loop: string, facet: string, solid: string];
  readonly head?: string;
  readonly lineEnd?: string;
}

function stlText({
  number = String,
  normal = " normal 0 0 1",
  ends,
  head = "solid box",
  lineEnd = "\n",
}: TextStyle) {
  const [loop, facet, solid] = ends ?? ["endloop", "endfacet", "endsolid"];
  const facets = corners.map((triangle) => [
    `facet${normal}`,
    " outer loop",
    ...triangle.map((position) => `  vertex ${position.map(number).join(" ")}`),
    ` ${loop}`,
    facet,
  ]);
  return [head, ...facets.flat(), solid, ""].join(lineEnd);
}

describe("STL texts", () => {
  const fortran = (letter: string) => (x: number) => x.toExponential(9).replace("e", letter);
  test.each<[string, TextStyle | ((text: string) => string)]>([
    ["ends in two words", { ends: ["end loop", "end facet", "end solid box"] }],
    ["ends in two words in capitals, with tabs", { ends: ["END\tLOOP", "END  FACET", "END SOLID"] }],
    ["Fortran exponents", { number: fortran("D") }],
    ["Fortran exponents in lower case", { number: fortran("d") }],
    ["Fortran numbers without digits after the point", { number: (x) => `${x}.D+00` }],
    ["no normals", { normal: "" }],
    ["normals without a number", { normal: " normal" }],
    ["normals that are no numbers", { normal: " normal -nan(ind) 1.#QNAN nan" }],
    ["a comment in the first line", { head: "solid box ;units=mm facet normal" }],
    ["no name", { head: "solid" }],
    ["a byte-order mark", { head: "\uFEFFsolid box" }],
    ["blanks before the first word", { head: "  \tsolid box" }],
    ["line feeds after carriage returns", { lineEnd: "\r\n" }],
    ["lone carriage returns", { lineEnd: "\r" }],
    ["capitals", (text) => text.toUpperCase()],
    ["mixed case", (text) => text.replace(/\b[a-z]/g, (letter) => letter.toUpperCase())],
    ["tabs", (text) => text.replaceAll(" ", "\t")],
  ])("with %s are read", async (_, style) => {
    const text = typeof style === "function" ? style(stlText({})) : stlText(style);
    const read = await surfaceIn(text, "box.stl");
    expect([read.points.length / 3, read.triangles.length / 3]).toEqual([8, 12]);
    expect(new Set(read.points)).toEqual(new Set([0, 1]));
    expect(read.patches).toHaveLength(1);
  });

  test("with the wrong word after end are refused, with the line", async () => {
    const error = await errorIn(stlText({ ends: ["end facet", "endfacet", "endsolid"] }), "box.stl");
    expect(error).toMatchObject({ line: 7, message: 'line 7: expected "loop", found "facet"' });
  });
});

describe("binary STL", () => {
  const withCount = (count: number, header = "made by a test") => {
    const bytes = stlBinary(box, header);
    new DataView(bytes.buffer, bytes.byteOffset).setUint32(80, count, true);
    return bytes;
  };

  test.each([
    [0, /announces 0 triangles, but the file has 12, which are read/],
    [1, /announces 1 triangle, but the file has 12, which are read/],
    [11, /announces 11 triangles, but the file has 12, which are read/],
    [0xffffffff, /announces an unknown number of triangles, but the file has 12, which are read/],
  ])("whose header announces %d triangles is read, with a note", async (count, note) => {
    const read = await surfaceIn(withCount(count), "box.stl");
    expect([read.points.length / 3, read.triangles.length / 3]).toEqual([8, 12]);
    expect(read.notes).toEqual([expect.stringMatching(note)]);
  });

  test.each([20, 60, 100, 1000])(
    "with %d bytes of text at its end has the announced triangles",
    async (length) => {
      const text = new TextEncoder()
        .encode("exported by a program that likes to talk ".repeat(30))
        .slice(0, length);
      const read = await surfaceIn(Uint8Array.of(...withCount(12), ...text), "box.stl");
      expect(read.triangles.length / 3).toBe(12);
      expect(read.notes).toEqual([expect.stringContaining("what follows the 12 triangles")]);
    },
  );

  test("without a count is read beyond a record of zeros", async () => {
    const bytes = withCount(0);
    const record = 50;
    const begin = 84 + 2 * record;
    const zeros = new Uint8Array(record);
    const read = await surfaceIn(
      Uint8Array.of(...bytes.subarray(0, begin), ...zeros, ...bytes.subarray(begin), ...zeros),
      "box.stl",
    );
    expect(read.triangles.length / 3).toBe(12);
  });

  test("whose header announces more triangles than the file has is refused: it is truncated", async () => {
    expect((await errorIn(withCount(13), "box.stl")).message).toMatch(/the 13 triangles .* need 734 bytes/);
  });

  test("with other content after the triangles is refused", async () => {
    const twice = Buffer.concat([withCount(12), withCount(12)]);
    expect((await errorIn(twice, "box.stl")).message).toMatch(/^byte 684: .* not with whole triangles/);
  });

  test("that begins with the word solid is read", async () => {
    const read = await surfaceIn(withCount(12, "solid exported by a program"), "box.stl");
    expect([read.triangles.length / 3, read.notes]).toEqual([12, undefined]);
  });
});

describe("names in Latin-1", () => {
  const NAME = "Gehäuse größer";
  const latin1 = (text: string) => Buffer.from(text, "latin1");
  const triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

  test.each([
    ["a.stl", latin1(stlText({ head: `solid ${NAME}` }))],
    ["a.stl", Buffer.from(stlText({ head: `solid ${NAME}` }))],
    ["a.obj", latin1(`${triangle}g Gehäuse größer\nf 1 2 3\n`)],
  ])("in %s are read as they are", async (fileName, file) => {
    const read = await surfaceIn(file, fileName);
    expect(read.patches.map(({ name }) => name)).toEqual([NAME]);
  });

  test.each([
    ["a.stl", `${stlText({ head: "solid Käfig" })}${stlText({ head: "solid Köfig" })}`, ["Käfig", "Köfig"]],
    ["a.obj", `${triangle}g ä\nf 1 2 3\ng ö\nf 1 3 2\n`, ["ä", "ö"]],
  ])("that differ stay different in %s", async (fileName, text, names) => {
    const read = await surfaceIn(latin1(text), fileName);
    expect(read.patches.map(({ name }) => name)).toEqual(names);
  });

  test("in the title of a VTK file are accepted", async () => {
    const head = "# vtk DataFile Version 3.0\nGehäuse größer\nASCII\nDATASET POLYDATA\n";
    const read = await surfaceIn(
      latin1(`${head}POINTS 3 float\n0 0 0 1 0 0 0 1 0\nPOLYGONS 1 4\n3 0 1 2\n`),
      "a.vtk",
    );
    expect(read.triangles.length).toBe(3);
  });
});

describe("Fortran numbers", () => {
  test.each([
    ["a.off", "OFF\n3 1 0\n0.0D0 0 0\n2.0D+00 0 0\n0 2.0d-0 0\n3 0 1 2\n"],
    ["a.obj", "v 0 0 0\nv 2.0D+00 0 0\nv 0 .2d1 0\nf 1 2 3\n"],
    [
      "a.ply",
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty double x\nproperty double y\nproperty double z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n2D0 0 0\n0 0.0000000000000000000002D+22 0\n3 0 1 2\n",
    ],
  ])("are read in %s", async (fileName, text) => {
    expect([...(await surfaceIn(text, fileName)).points]).toEqual([0, 0, 0, 2, 0, 0, 0, 2, 0]);
  });

  test("need an exponent", async () => {
    expect((await errorIn("v 0 0 0\nv 2D 0 0\n", "a.obj")).message).toMatch(
      /found "2D", which is not a finite number/,
    );
  });
});

describe("VTU and VTP files whose counts disagree with their arrays", () => {
  const array = (name: string, values: string, type = "Int64") =>
    `<DataArray type="${type}" Name="${name}" format="ascii">${values}</DataArray>`;
  const points = `<Points><DataArray type="Float64" NumberOfComponents="3" format="ascii">0 0 0 1 0 0 0 1 0 1 1 0</DataArray></Points>`;
  const vtu = (pointCount: number, cellCount: number, types = "5 5") =>
    `<VTKFile type="UnstructuredGrid"><UnstructuredGrid><Piece NumberOfPoints="${pointCount}" NumberOfCells="${cellCount}">${points}<Cells>${array("connectivity", "0 1 2 1 3 2")}${array("offsets", "3 6")}${array("types", types, "UInt8")}</Cells></Piece></UnstructuredGrid></VTKFile>`;
  const vtp = (polys: number) =>
    `<VTKFile type="PolyData"><PolyData><Piece NumberOfPoints="4" NumberOfPolys="${polys}">${points}<Polys>${array("connectivity", "0 1 2 1 3 2")}${array("offsets", "3 6")}</Polys></Piece></PolyData></VTKFile>`;

  test("are read if they agree", async () => {
    expect((await surfaceIn(vtu(4, 2), "a.vtu")).triangles.length).toBe(6);
    expect((await surfaceIn(vtp(2), "a.vtp")).triangles.length).toBe(6);
  });

  test.each([
    ["a.vtu", vtu(4, 3), /has 2 .*announces NumberOfCells="3"/],
    ["a.vtu", vtu(4, 1), /has 2 .*announces NumberOfCells="1"/],
    ["a.vtu", vtu(5, 2), /has 4 points, but announces 5/],
    ["a.vtu", vtu(3, 2), /has 4 points, but announces 3/],
    ["a.vtu", vtu(4, 2, "5 5 5"), /3 types, but 2 offsets/],
    ["a.vtp", vtp(7), /has 2 .*announces NumberOfPolys="7"/],
  ])("are refused with both numbers: %s", async (fileName, text, message) => {
    expect((await errorIn(text, fileName)).message).toMatch(message);
  });
});
