import { readMesh, readSurface, writeMesh, type ReadResult, type Mesh, type SurfaceInput } from "tetrafront";
import { describe, expect, test } from "vitest";

import { objFile, offFile, plyBinary, plyText, stlBinary, stlText } from "../../support/surface-files.js";
import { boxSurface, joined, sphereSurface } from "../../support/surfaces.js";

const bytes = (text: string) => new TextEncoder().encode(text);

type Reading = Promise<ReadResult<Mesh>>;

const reader = (fileName: string) => (file: Uint8Array) => readSurface(file, { fileName });
const readStl = reader("a.stl");
const readOff = reader("a.off");
const readObj = reader("a.obj");
const readPly = reader("a.PLY");

async function surfaceIn(reading: Reading): Promise<Mesh> {
  const read = await reading;
  if (!read.success) throw new Error(read.errors[0].message);
  return read.value;
}

async function problemIn(reading: Reading) {
  const read = await reading;
  if (read.success) throw new Error("the file was accepted");
  expect(read.errors[0].remedy).toMatch(/^[A-Z].*\.$/);
  return read.errors[0];
}

/** Returns triangles by the coordinates of their corners, independent of node indices. */
function soup({ points, triangles }: SurfaceInput): string[] {
  const corner = (node: number) => points.subarray(3 * node, 3 * node + 3).join(" ");
  return Array.from({ length: triangles.length / 3 }, (_, t) =>
    [...triangles.subarray(3 * t, 3 * t + 3)].map(corner).join(" | "),
  );
}

const sphere = sphereSurface(4);
const float32 = (surface: SurfaceInput) => ({
  ...surface,
  points: Float64Array.from(new Float32Array(surface.points)),
});

describe("STL", () => {
  test("text is read with exact coordinates, and its nodes are welded", async () => {
    const read = await surfaceIn(readStl(stlText(sphere)));
    expect(soup(read)).toEqual(soup(sphere));
    expect(read.points.length).toBe(sphere.points.length);
  });

  test("binary is read as float32, and its nodes are welded", async () => {
    const read = await surfaceIn(readStl(stlBinary(sphere)));
    expect(soup(read)).toEqual(soup(float32(sphere)));
    expect(read.points.length).toBe(sphere.points.length);
  });

  test('binary that begins with "solid" is not read as text', async () => {
    const read = await surfaceIn(readStl(stlBinary(sphere, "solid exported by some program facet")));
    expect(soup(read)).toEqual(soup(float32(sphere)));
  });

  test("binary with bytes after its triangles is accepted", async () => {
    expect(soup(await surfaceIn(readStl(Uint8Array.of(...stlBinary(sphere), 0, 0, 0))))).toEqual(
      soup(float32(sphere)),
    );
  });

  test("several solids are read as one surface", async () => {
    const text = Uint8Array.of(...stlText(boxSurface(1), "one"), ...stlText(sphere, "endsolid facet of two"));
    expect(soup(await surfaceIn(readStl(text)))).toEqual(soup(joined(boxSurface(1), sphere)));
  });

  test("capitals, tabs, carriage returns and NaN normals are accepted", async () => {
    const text = new TextDecoder()
      .decode(stlText(boxSurface(1)))
      .replace(/normal 0 0 0/g, "normal NaN NaN NaN");
    const read = await surfaceIn(
      readStl(bytes(text.toUpperCase().replace(/\n/g, "\r\n").replace(/ {2}/g, "\t"))),
    );
    expect(soup(read)).toEqual(soup(boxSurface(1)));
  });

  test("-0 is read as 0", async () => {
    const { points, triangles } = boxSurface(1);
    const signed = { triangles, points: points.map((value) => (value === 0 ? -0 : value)) };
    const both = await surfaceIn(readStl(stlText(joined({ points, triangles }, signed))));
    expect(both.points.length).toBe(points.length);
    expect([...both.points].some((value) => Object.is(value, -0))).toBe(false);
  });

  test("nodes that differ by a rounding error are not welded", async () => {
    const { points, triangles } = boxSurface(1);
    const moved = { triangles, points: points.map((value) => value + Number.EPSILON) };
    const both = await surfaceIn(readStl(stlText(joined({ points, triangles }, moved))));
    expect(both.points.length).toBe(2 * points.length);
  });

  test.each([0, 10, 83, 84 + 49, 84 + 50 * 3 + 17])(
    "binary truncated after %i bytes is rejected with its byte offset",
    async (length) => {
      const problem = await problemIn(readStl(stlBinary(sphere).subarray(0, length)));
      expect(problem.offset).toBe(length);
    },
  );

  test.each<[string, number, string]>([
    ["a missing number", 4, "vertex 0 0"],
    ["a word for a number", 4, "vertex 0 0 zero"],
    ["an infinite coordinate", 4, "vertex 0 Infinity 0"],
    ["four corners", 7, "vertex 1 1 1\nvertex 1 1 0\nvertex 2 2 2\nvertex 3 3 3"],
  ])("text with %s is rejected with its line", async (_, line, vertices) => {
    const text = `solid a\n facet normal 0 0 1\n  outer loop\n${vertices}\nvertex 1 0 0\nendloop\nendfacet\nendsolid`;
    expect(await problemIn(readStl(bytes(text)))).toMatchObject({ line });
  });

  test("text truncated in a facet is rejected with its line", async () => {
    const text = new TextDecoder().decode(stlText(sphere));
    const problem = await problemIn(readStl(bytes(text.slice(0, text.length / 2))));
    expect(problem.line).toBeGreaterThan(100);
    expect(problem.message).toMatch(/line \d+: /);
  });

  test("another kind of file is rejected", async () => {
    expect((await problemIn(readStl(bytes("<html><body>Not found</body></html>")))).message).toMatch(
      /a web page \(HTML\), not STL/,
    );
    expect((await problemIn(readStl(bytes("solid\nThis is a text about solid things.\n")))).message).toMatch(
      /"This"/,
    );
  });
});

describe("OFF", () => {
  test("is read with exact coordinates", async () => {
    expect(await surfaceIn(readOff(offFile(sphere)))).toMatchObject(sphere);
  });

  test("comments, blank lines, counts on the first line and colours are skipped", async () => {
    const text = [
      "OFF 4 4 6 # a tetrahedron",
      "",
      "# its points",
      "0 0 0",
      "1 0 0 # on the x axis",
      "0 1 0",
      "0 0 1e0",
      "3 0 2 1 255 0 0",
      "3 0 1 3 0.5 0.5 0.5 1.0",
      "3  0 3 2",
      "3 1 2 3",
    ];
    const read = await surfaceIn(readOff(bytes(text.join("\r\n"))));
    expect([...read.points]).toEqual([0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1]);
    expect([...read.triangles]).toEqual([0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3]);
  });

  test("coincident nodes are welded", async () => {
    const { points, triangles } = joined(boxSurface(1), boxSurface(1));
    expect((await surfaceIn(readOff(offFile({ points, triangles })))).points.length).toBe(24);
  });

  test("colours and normals of nodes are skipped", async () => {
    const text = "COFF\n3 1 0\n0 0 0 255 0 0 255\n1 0 0 0 255 0 255\n0 1 0 0 0 255 255\n3 0 1 2\n";
    expect([...(await surfaceIn(readOff(bytes(text)))).points]).toEqual([0, 0, 0, 1, 0, 0, 0, 1, 0]);
  });

  test("convex polygons are triangulated", async () => {
    const cube = "OFF\n8 6 12\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1\n";
    const faces = "4 0 3 2 1\n4 4 5 6 7\n4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n";
    const read = await surfaceIn(readOff(bytes(cube + faces)));
    expect([...read.triangles.subarray(0, 6)]).toEqual([0, 3, 2, 0, 2, 1]);
    expect(read.triangles.length).toBe(3 * 12);
  });

  test("a self-intersecting polygon is rejected with its line", async () => {
    const text = "OFF\n4 1 0\n0 0 0\n1 1 0\n1 0 0\n0 1 0\n4 0 1 2 3\n";
    expect(await problemIn(readOff(bytes(text)))).toMatchObject({ line: 7 });
  });

  test.each<[string, string, number]>([
    ["another header", "OBJ\n8 6 0\n", 1],
    ["no header and no points", "8 6 0\n", 2],
    ["points of four dimensions", "4OFF\n1 0 0\n0 0 0 1\n", 1],
    ["too few points", "OFF\n4 1 0\n0 0 0\n1 0 0\n", 5],
    ["a word for a coordinate", "OFF\n3 1 0\n0 0 0\n1 x 0\n0 1 0\n3 0 1 2\n", 4],
    ["a corner that does not exist", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n", 6],
    ["a corner that is not an integer", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 1.5\n", 6],
    ["a face with two corners", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n2 0 1\n", 6],
    ["too few faces", "OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", 7],
    ["a huge count without data", "OFF\n2000000000 1 0\n", 3],
  ])("%s is rejected with its line", async (_, text, line) => {
    expect(await problemIn(readOff(bytes(text)))).toMatchObject({ line });
  });

  test("an empty file is rejected", async () => {
    expect((await problemIn(readOff(new Uint8Array()))).message).toMatch(/empty/);
  });
});

/** A square pyramid whose base is one quadrilateral. */
const pyramid = { points: ["0 0 0", "1 0 0", "1 1 0", "0 1 0", "0.5 0.5 1"], base: [0, 3, 2, 1] };

describe("the attribute bytes of a triangle in binary STL", () => {
  /** A cube whose triangles have these attributes in turn. */
  function stlOf(attributes: readonly number[], header?: string): Uint8Array {
    const file = stlBinary(boxSurface(1), header);
    const view = new DataView(file.buffer);
    for (let t = 0; 84 + 50 * t < file.length; t++) {
      view.setUint16(84 + 50 * t + 48, attributes[t % attributes.length] ?? 0, true);
    }
    return file;
  }
  const patchesOf = async (attributes: readonly number[], header?: string) =>
    (await surfaceIn(readStl(stlOf(attributes, header)))).patches;

  test("are the number of its patch, or no patch if 0", async () => {
    const patches = await patchesOf([11, 0, 1]);
    expect(patches.map(({ name, tag }) => [name, tag])).toEqual([
      ["attribute 11", 11],
      ["surface", 2],
      ["attribute 1", 1],
    ]);
    // Writing the mesh again keeps the numbers.
    const read = await readMesh(stlOf([11, 7]), { fileName: "a.stl" });
    if (!read.success) throw new Error();
    const [file] = await writeMesh(read.value, "a.stl");
    const again = await surfaceIn(readStl(file?.bytes ?? new Uint8Array()));
    expect(again.patches.map(({ tag }) => tag)).toEqual([11, 7]);
  });

  test("are a colour, blue in the lowest bits, if bit 15 is set", async () => {
    const [red, , ...others] = await patchesOf([0x8000 | (31 << 10), 3]);
    expect(red).toMatchObject({ name: "#ff0000", color: [1, 0, 0] });
    expect(others).toEqual([]);
  });

  test("are a colour in files of Magics, red in the lowest bits, or the colour of the object if bit 15 is set", async () => {
    const header = "COLOR=\x00\x7f\x00\x7f,MATERIAL=";
    const patches = await patchesOf([31, 0x8000 | 11, 0x8000], header);
    expect(patches.map(({ name }) => name)).toEqual(["#ff0000", "#007f00"]);
    expect(patches[1]?.color).toEqual([0, 127 / 255, 0]);
  });
});

describe("OBJ", () => {
  test("is read with exact coordinates", async () => {
    expect(soup(await surfaceIn(readObj(objFile(sphere))))).toEqual(soup(sphere));
  });

  test("can have negative indices, continued lines, weights, colours and polygons", async () => {
    const rows = pyramid.points.map((point) => `v ${point} 1.0`).join("\n");
    const file = `${rows}\nf 1 4 3 2\nf -5/1/1 -4/2/2 -1/3/3\nf 2 3 \\\n 5\nf 3 4 5 # side\nf 4 1 5\n`;
    const { triangles } = await surfaceIn(readObj(bytes(file)));
    expect([...triangles]).toEqual([0, 3, 2, 0, 2, 1, 0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4]);
  });

  test.each(["\n", "\r\n", "\r"])("continues any line after a backslash, with line ends %j", async (end) => {
    const rows = pyramid.points.map((point) => `v ${point.replace(" ", "\\\n\\\n ")} \\\n 1.0`);
    const head = [
      "# a folder: C:\\parts\\",
      "mtllib a.mtl \\",
      "v.mtl",
      ...rows,
      "usemtl red \\",
      "and blue",
    ];
    const faces = [
      "f 1 4\\",
      " 3 2",
      "f -5/1/1 -4/2/2 -1/3/3",
      "f 2 3 \\",
      "\\",
      "5",
      "f 3 4 5",
      "f 4 1 5\\",
      "",
    ];
    const file = [...head, ...faces].join("\n").replaceAll("\n", end);
    const surface = await surfaceIn(readObj(bytes(file)));
    expect([...surface.triangles]).toEqual([0, 3, 2, 0, 2, 1, 0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4]);
    expect(surface.patches.map(({ name }) => name)).toEqual(["red and blue"]);
    expect(surface.points).toHaveLength(15);
    // Continued lines still count as lines.
    const wrong = readObj(bytes(["v 0 0 \\", "0", "v 1 zero 0"].join(end)));
    expect(await problemIn(wrong)).toMatchObject({ line: 3 });
  });

  test.each<[string, string, RegExp]>([
    ["no content", "", /empty/],
    ["no face", "v 0 0 0\n", /no face/],
    [
      "a corner that is defined later",
      "v 0 0 0\nf 1 2 3\nv 1 0 0\nv 0 1 0\n",
      /line 2: a face has the corner "2", which refers to point 2, but the file has 1 point up/,
    ],
    [
      "a corner with index 0",
      "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 0 1 2\n",
      /line 4: a face has the corner "0", which refers to point 0, but/,
    ],
    ["a face with two corners", "v 0 0 0\nv 1 0 0\nf 1 2\n", /line 3: a face has 2 corners/],
    ["an invalid coordinate", "v 0 0 zero\n", /line 1: .*found "zero"/],
    ["a curved surface", "v 0 0 0\ncstype bezier\n", /line 2: "cstype"/],
    ["a bow tie", "v 0 0 0\nv 1 1 0\nv 1 0 0\nv 0 1 0\nf 1 2 3 4\n", /cannot be cut into triangles/],
  ])("with %s is rejected", async (_, file, message) => {
    expect((await problemIn(readObj(bytes(file)))).message).toMatch(message);
  });
});

describe("PLY", () => {
  test.each([
    ["text", plyText(sphere)],
    ["binary, low byte first", plyBinary(sphere, true)],
    ["binary, high byte first", plyBinary(sphere, false)],
  ])("as %s is read with exact coordinates", async (_, file) => {
    expect(soup(await surfaceIn(readPly(file)))).toEqual(soup(sphere));
  });

  const head = (format: string, faces: number) =>
    `ply\nformat ${format} 1.0\nelement vertex 5\nproperty float x\nproperty float y\nproperty float z
element face ${faces}\nproperty uchar flag\nproperty list uchar uint vertex_index\nelement edge 1\nproperty int from
end_header\n`;
  const rows = `${pyramid.points.join("\n")}\n0 4 ${pyramid.base.join(" ")}\n`;

  test("can have polygons and unused elements", async () => {
    const { triangles } = await surfaceIn(readPly(bytes(`${head("ascii", 1)}${rows}7\n`)));
    expect([...triangles]).toEqual([0, 3, 2, 0, 2, 1]);
  });

  test.each<[string, string, RegExp]>([
    ["no content", "", /empty/],
    ["another header", "solid\n", /begin with "ply"/],
    [
      "half a header",
      "ply\nformat ascii 1.0\n",
      /the file is truncated: it ends where "end_header" should follow/,
    ],
    ["an unknown format", head("ebcdic", 1), /"ebcdic"/],
    ["an unknown number type", head("ascii", 1).replace("property float x", "property half x"), /"half"/],
    ["points without z", `${head("ascii", 1).replace("float z", "float w")}${rows}7\n`, /lack x, y or z/],
    [
      "a corner out of range",
      `${head("ascii", 1)}${rows.replace("4 0 3 2 1", "3 0 3 9")}7\n`,
      /has corner 9, but the file has 5 points/,
    ],
    [
      "missing faces",
      `${head("ascii", 4_000_000)}${rows}`,
      /the file is truncated: it ends where a property should follow/,
    ],
    ["truncated points", `${head("ascii", 1)}0 0 0 1`, /./],
    ["a second surface", `${head("ascii", 1)}${rows}7\n${head("ascii", 1)}`, /a second surface/],
    [
      "a second surface and CRLF line ends",
      `${head("ascii", 1)}${rows}7\n${head("ascii", 1)}`.replaceAll("\n", "\r\n"),
      /a second surface/,
    ],
  ])("with %s is rejected", async (_, file, message) => {
    expect((await problemIn(readPly(bytes(file)))).message).toMatch(message);
  });

  test("truncated binary is rejected with its byte offset", async () => {
    const file = plyBinary(sphere, true);
    const problem = await problemIn(readPly(file.subarray(0, file.length - 5)));
    expect(problem.message).toMatch(/^byte \d+: the file is truncated: it ends in the middle of a number/);
  });
});
