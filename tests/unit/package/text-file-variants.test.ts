/** Text files as editors and shells leave them: byte order marks, any line ends, concatenated files. */
import { extensionsFor, FILE_FORMATS, formatOf, readMesh, writeMesh, type Mesh } from "tetrafront";
import { describe, expect, test } from "vitest";

import { blockMesh } from "../../support/block-mesh.js";
import { vtkBinary } from "../../support/mesh-files.js";
import { plyBinary, stlBinary } from "../../support/surface-files.js";
import { boxSurface } from "../../support/surfaces.js";

const MARK = "\u{feff}";

/**
 * The surface of a tetrahedron in every format that can be text; its patch has a name if the format can store
 * one.
 */
const POINTS = ["0 0 0", "1 0 0", "0 1 0", "0 0 1"];
const FACES = ["0 2 1", "0 1 3", "1 2 3", "2 0 3"];
const eachPoint = (line: (point: string, p: number) => string) => `${POINTS.map(line).join("\n")}\n`;
const eachFace = (line: (face: string, f: number) => string) => `${FACES.map(line).join("\n")}\n`;
const from1 = (face: string) => face.replace(/\d/g, (node) => String(Number(node) + 1));
const poly = `# patch 3 in let\n4 3 0 0\n${eachPoint((point, p) => `${p} ${point}`)}`;
const vtkXml = (type: string, cells: string) => `<?xml version="1.0"?>\n<!--patch 3 in let-->\n
<VTKFile type="${type}" version="1.0" byte_order="LittleEndian"><${type}>
<Piece NumberOfPoints="4" NumberOfPolys="4" NumberOfCells="4">
<Points><DataArray type="Float64" NumberOfComponents="3" format="ascii">\n${POINTS.join("\n")}\n</DataArray></Points>
${cells}\n<CellData><DataArray type="Int32" Name="patch" format="ascii">\n3 3 3 3\n</DataArray></CellData>
</Piece></${type}></VTKFile>\n`;
const vtkCells = `<DataArray type="Int32" Name="connectivity" format="ascii">\n${FACES.join("\n")}\n</DataArray>
<DataArray type="Int32" Name="offsets" format="ascii">3\n6\n9 12\n</DataArray>`;
const msh = (version: string, nodes: string, elements: string) =>
  `$MeshFormat\n${version} 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n2 3 "in let"\n$EndPhysicalNames\n${
    version === "2.2" ? "" : "$Entities\n0 0 1 0\n1 0 0 0 1 1 1 1 3 0\n$EndEntities\n"
  }$Nodes\n${nodes}$EndNodes\n$Elements\n${elements}$EndElements\n`;
const msh2 = msh(
  "2.2",
  `4\n${eachPoint((point, p) => `${p + 1} ${point}`)}`,
  `4\n${eachFace((face, f) => `${f + 1} 2 2 3 1 ${from1(face)}`)}`,
);

const TEXTS: Readonly<Record<string, string>> = {
  ".stl": `solid in let\n${eachFace(
    (face) =>
      `facet normal 0 0 0\nouter loop\n${face.replace(/(\d) ?/g, (_, node: string) => `vertex ${POINTS[Number(node)]}\n`)}endloop\nendfacet`,
  )}endsolid in let\n`,
  ".off": `# patch 3 in let\nOFF\n4 4 6\n${eachPoint((point) => point)}${eachFace((face) => `3 ${face}`)}`,
  ".obj": `# a comment\n${eachPoint((point) => `v ${point}`)}usemtl in let\n${eachFace((face) => `f ${from1(face)}`)}`,
  ".ply": `ply\nformat ascii 1.0\ncomment patch 3 in let\nelement vertex 4\nproperty double x\nproperty double y
property double z\nelement face 4\nproperty list uchar int vertex_indices\nend_header
${eachPoint((point) => point)}${eachFace((face) => `3 ${face}`)}`,
  ".vtu": vtkXml(
    "UnstructuredGrid",
    `<Cells>${vtkCells}<DataArray type="UInt8" Name="types" format="ascii">5 5\n5 5</DataArray></Cells>`,
  ),
  ".vtp": vtkXml("PolyData", `<Polys>${vtkCells}</Polys>`),
  ".msh": msh(
    "4.1",
    `1 4 1 4\n2 1 0 4\n1\n2\n3\n4\n${eachPoint((point) => point)}`,
    `1 4 1 4\n2 1 2 4\n${eachFace((face, f) => `${f + 1} ${from1(face)}`)}`,
  ),
  ".msh2": msh2,
  ".vtk": `# vtk DataFile Version 3.0\npatch 3 in let\nASCII\nDATASET POLYDATA\nPOINTS 4 double\n${eachPoint(
    (point) => point,
  )}METADATA\nINFORMATION 0\n\nPOLYGONS 4 16\n${eachFace((face) => `3 ${face}`)}`,
  ".mesh": `# patch 3 in let\nMeshVersionFormatted 2\nDimension 3\nVertices\n4\n${eachPoint(
    (point) => `${point} 0`,
  )}Triangles\n4\n${eachFace((face) => `${from1(face)} 3`)}End\n`,
  ".smesh": `${poly}4 1\n${eachFace((face) => `3 ${face} 3`)}0\n0\n`,
  ".poly": `${poly}4 1\n${eachFace((face) => `1 0 3\n3 ${face}`)}0\n0\n`,
  ".face": `4 1\n${eachFace((face, f) => `${f} ${face} 3`)}`,
};
/** The .node file that belongs to the .face file. */
const NODES = poly;

async function meshIn(extension: string, change: (text: string) => string): Promise<Mesh> {
  const encode = (text: string) => new TextEncoder().encode(change(text));
  const read = await readMesh(encode(TEXTS[extension] ?? ""), {
    fileName: `a${extension}`,
    openOther: (name) => Promise.resolve(name === "a.node" ? encode(NODES) : undefined),
  });
  if (!read.success) throw new Error(read.errors[0].message);
  return read.value;
}

test("there is a sample for every surface format that is text", () => {
  const isText = (extension: string) =>
    formatOf(extension)?.isCad !== true && ![".3mf", ".meshb"].includes(extension);
  const known = extensionsFor("read", "surface").filter(isText);
  expect(Object.keys(TEXTS).sort()).toEqual([...known].sort());
});

describe.each(Object.keys(TEXTS))("a %s text file", (extension) => {
  test.each<[string, (text: string) => string]>([
    ["a byte order mark", (text) => MARK + text],
    ["carriage returns only", (text) => text.replaceAll("\n", "\r")],
    ["carriage returns before line feeds", (text) => text.replaceAll("\n", "\r\n")],
    ["a byte order mark and carriage returns", (text) => MARK + text.replaceAll("\n", "\r")],
    ["no line end after the last line", (text) => text.trimEnd()],
  ])("with %s is read the same way", async (_, change) => {
    const plain = await meshIn(extension, (text) => text);
    expect(plain.triangles).toHaveLength(12);
    expect(plain.patches.map(({ name }) => name)).toEqual(["in let"]);
    expect(await meshIn(extension, change)).toEqual(plain);
  });

  test.each([
    ["little", MARK],
    ["big", MARK],
    ["little", ""],
    ["big", ""],
  ])("in UTF-16, %s-endian, after %j, is read the same way", async (order, mark) => {
    const text = mark + (TEXTS[extension] ?? "");
    const units = Uint8Array.from({ length: 2 * text.length }, (_, i) => {
      const unit = text.charCodeAt(i >> 1);
      return (i % 2 === 0) === (order === "little") ? unit & 255 : unit >> 8;
    });
    const openOther = (name: string) =>
      Promise.resolve(name === "a.node" ? new TextEncoder().encode(NODES) : undefined);
    const options = { fileName: `a${extension}`, openOther };
    // In pieces that end within a character.
    const pieces = [units.subarray(0, 1), units.subarray(1, 3), units.subarray(3, 101), units.subarray(101)];
    for (const source of [units, pieces]) {
      const read = await readMesh(source, options);
      expect(read.success && read.value).toEqual(await meshIn(extension, (plain) => plain));
    }
  });

  test("with carriage returns as line ends reports the same line for an error", async () => {
    const broken = (end: string) => async () => {
      await meshIn(extension, (text) => text.replace(/0 1 0(?=[^]*$)/, "0 x 0").replaceAll("\n", end));
    };
    const message = await broken("\n")().then(String, String);
    expect(message).toMatch(/line \d+/);
    expect(await broken("\r")().then(String, String)).toBe(message);
  });
});

test.each([".vtu", ".vtp"])(
  'attribute values in %s can have quotes of either kind and contain ">" and "/"',
  async (extension) => {
    const plain = await meshIn(extension, (text) => text);
    const single = (text: string) => text.replaceAll('"', "'");
    const tagCharacters = (text: string) =>
      text.replace("<Points><DataArray", `<Points><DataArray Name = 'it is "a > b"/'`);
    for (const change of [single, tagCharacters, (text: string) => tagCharacters(single(text))]) {
      expect(await meshIn(extension, change)).toEqual(plain);
    }
  },
);

test.each([".obj", ".stl"])("concatenated %s files are read to the end", async (extension) => {
  for (const end of ["\n", "\r", "\r\n"]) {
    const one = await meshIn(extension, (text) => text);
    for (const marked of [MARK, `${MARK}${MARK} # more\n`.slice(0, extension === ".obj" ? undefined : 1)]) {
      const two = await meshIn(extension, (text) => text + marked + text.replaceAll("\n", end));
      expect(two.trianglePatch).toHaveLength(2 * one.trianglePatch.length);
    }
  }
});

test.each(["-3", "0.5", "x"])("a VTK XML file with NumberOfCells='%s' is rejected", async (count) => {
  const change = (text: string) => text.replace('NumberOfCells="4"', `NumberOfCells="${count}"`);
  await expect(meshIn(".vtu", change)).rejects.toThrow(/line 5: NumberOfCells must be/);
});

test("the word OFF at the beginning of an OFF file is optional", async () => {
  const plain = await meshIn(".off", (text) => text);
  expect(await meshIn(".off", (text) => text.replace("OFF\n", ""))).toEqual(plain);
  await expect(meshIn(".off", (text) => text.replace("OFF\n4 4 6", "4 4 x"))).rejects.toThrow(
    /begin with "OFF"/,
  );
});

test("entities of a partitioned Gmsh mesh get the physical groups of their parent entities", async () => {
  const plain = await meshIn(".msh", (text) => text);
  const parts = `$PartitionedEntities\n2\n1\n9 1\n0 0 2 0
11 2 1 1 1 0 0 0 1 1 1 0 0\n12 2 1 2 1 2 0 0 0 1 1 1 1 3 2 5 -6\n$EndPartitionedEntities\n$Nodes`;
  const cut = (text: string) =>
    text.replace("$Nodes", parts).replace(/1 4 1 4\n2 1 2 4\n(.*\n.*\n)/, "2 4 1 4\n2 11 2 2\n$12 12 2 2\n");
  expect(await meshIn(".msh", cut)).toEqual(plain);
});

test("a file that holds only a byte order mark is rejected", async () => {
  const read = await readMesh(new TextEncoder().encode(MARK), { fileName: "a.obj" });
  expect(read.success).toBe(false);
});

describe("binary data after lines that end with carriage returns only is rejected", () => {
  const withReturns = (bytes: Uint8Array, lines: number) => {
    for (let i = 0, line = 0; line < lines; i++) if (bytes[i] === 10 && ++line > 0) bytes[i] = 13;
    return bytes;
  };
  test.each([
    [".ply", () => withReturns(plyBinary(boxSurface(1), true), 11)],
    [".vtk", () => withReturns(vtkBinary(blockMesh().points, blockMesh().tetrahedra), 5)],
    [
      ".msh",
      async () => withReturns((await writeMesh(blockMesh(), "a.msh"))[0]?.bytes ?? new Uint8Array(), 2),
    ],
  ])("in %s", async (extension, bytes) => {
    expect(FILE_FORMATS.some(({ extensions }) => extensions.includes(extension))).toBe(true);
    const read = await readMesh(await bytes(), { fileName: `a${extension}` });
    expect(read.success ? "read" : read.errors[0].message).toMatch(/lone carriage return/);
  });
});

const errorOf = async (text: string | Uint8Array, fileName: string) => {
  const bytes = typeof text === "string" ? new TextEncoder().encode(text) : text;
  const read = await readMesh(bytes, { fileName });
  return read.success ? undefined : read.errors[0];
};

describe("a file that is cut", () => {
  test.each([".stl", ".off", ".obj", ".ply", ".vtu", ".vtp", ".vtk", ".mesh", ".msh", ".msh2"])(
    "at any number of %s is said to be truncated, unless what is left is complete",
    async (extension) => {
      const text = TEXTS[extension] ?? "";
      const others = new Map<string, number>();
      for (let length = text.indexOf(POINTS[0] ?? ""); length < text.length; length++) {
        const error = await errorOf(text.slice(0, length), `a${extension}`);
        if (error === undefined || /truncated|the file has no faces/.test(error.message)) continue;
        others.set(error.message, length);
      }
      expect([...others]).toEqual([]);
    },
  );

  test("as STEP, binary STL or 3MF is said to be truncated", async () => {
    const step = "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION((''),'2;1');\n";
    expect((await errorOf(step, "a.step"))?.message).toBe(
      "line 4: the file is truncated: it ends without END-ISO-10303-21",
    );
    const stl = stlBinary(boxSurface(1));
    expect((await errorOf(stl.subarray(0, 500), "a.stl"))?.message).toMatch(
      /^byte 500: the file is truncated: it ends there, but the 12 triangles/,
    );
    const zip = Uint8Array.from([0x50, 0x4b, 3, 4, ...new Array<number>(100).fill(7)]);
    expect((await errorOf(zip, "a.3mf"))?.message).toMatch(/^byte 104: the file is truncated/);
    expect((await errorOf(zip, "a.stl"))?.message).toBe("this is a ZIP archive, not STL");
  });
});

test.each(["stl", "obj", "off", "step", "iges", "vtu", "3mf", "mesh"])(
  "a web page that was saved as .%s is called so",
  async (extension) => {
    const page = "\n<!DOCTYPE html>\n<html><head><title>Sign in</title></head><body></body></html>\n";
    const error = await errorOf(page, `a.${extension}`);
    expect(error).toMatchObject({ code: "malformed-file", fileName: `a.${extension}` });
    expect(error?.message).toMatch(/^this is a web page \(HTML\), not /);
    expect(error?.remedy).toMatch(/^Download the file itself/);
  },
);

test("a missing coordinate is said where it is missing", async () => {
  const stl = TEXTS[".stl"]?.replace("vertex 1 0 0", "vertex 1 0") ?? "";
  const line = stl.slice(0, stl.indexOf("vertex 1 0\n")).split("\n").length;
  const message = `line ${line}: expected a coordinate, found the end of the line, then "endloop"`;
  expect(await errorOf(stl, "a.stl")).toMatchObject({ line, message });
  const inLine = await errorOf("v 0 0 zero\n", "a.obj");
  expect(inLine?.message).toBe('line 1: expected a coordinate, found "zero", which is not a number');
});
