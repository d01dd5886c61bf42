/** Volume meshes read from files in the forms that this package, meshio and other programs write. */
import { deflateSync } from "node:zlib";

import {
  createMesher,
  readMesh,
  readSurface,
  readVolume,
  writeMesh,
  type Mesh,
  type Mesher,
} from "tetrafront";
import { unusedData } from "tetrafront/internal";
import { afterAll, beforeAll, describe, expect, test } from "vitest";

/** Two tetrahedra that share a face; the first node is unused. */
const points = [9, 9, 9, 0, 0, 0, 1, 0, 0, 0, 1 + 2 ** -52, 0, 0, 0, 1, 1 / 3, 1, 1];
const corners = [
  [1, 2, 3, 4],
  [2, 5, 3, 4],
];
const size = [7, 0.1, 0.2, 0.3, 0.4, 0.5];
const direction = [7, 7, 7, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 0, 0, 1, 1];

const readVtu = (bytes: Uint8Array) => readVolume(bytes, { fileName: "a.vtu" });
const readMsh = (bytes: Uint8Array) => readVolume(bytes, { fileName: "a.msh" });

async function expectTwoTetrahedra(read: ReturnType<typeof readVtu>, data: readonly string[]): Promise<void> {
  const result = await read;
  if (!result.success) throw new Error(result.errors[0].message);
  const { points: found, tetrahedra, nodeData } = result.value;
  expect([...found]).toEqual(points.slice(3));
  expect([...tetrahedra]).toEqual([0, 1, 2, 3, 1, 4, 2, 3]);
  expect([...nodeData.keys()].sort()).toEqual(data);
  if (data.includes("size")) {
    expect(nodeData.get("size")).toEqual({ components: 1, values: Float64Array.from(size.slice(1)) });
  }
  if (data.includes("direction")) {
    expect(nodeData.get("direction")).toEqual({
      components: 3,
      values: Float64Array.from(direction.slice(3)),
    });
  }
}

describe("VTU", () => {
  type Form = (type: string, bytes: Buffer, numbers: readonly number[]) => string;
  const length = (bytes: number) => Buffer.from(Uint32Array.of(bytes).buffer);
  const text: Form = (_, __, numbers) => `format="ascii">\n${numbers.join("\n")}\n`;
  const together: Form = (_, bytes) =>
    `format="binary">${Buffer.concat([length(bytes.length), bytes]).toString("base64")}`;
  const apart: Form = (_, bytes) =>
    `format="binary">${length(bytes.length).toString("base64")}${bytes.toString("base64")}`;
  /** Compresses in blocks of 16 bytes. */
  const packed: Form = (_, bytes) => {
    const blocks: Buffer[] = [];
    for (let at = 0; at < bytes.length; at += 16) blocks.push(deflateSync(bytes.subarray(at, at + 16)));
    const header = Uint32Array.of(
      blocks.length,
      16,
      bytes.length % 16,
      ...blocks.map((block) => block.length),
    );
    return `format="binary">\n${Buffer.from(header.buffer).toString("base64")}${Buffer.concat(blocks).toString("base64")}\n`;
  };

  function vtu(form: Form, attributes = ""): Uint8Array {
    const array = (type: string, name: string, numbers: readonly number[], more = "") => {
      const values =
        type === "Float64"
          ? Float64Array.from(numbers)
          : type === "Int64"
            ? BigInt64Array.from(numbers, BigInt)
            : Uint8Array.from(numbers);
      return `<DataArray type="${type}" Name="${name}" ${more} ${form(type, Buffer.from(values.buffer), numbers)}</DataArray>`;
    };
    return new TextEncoder().encode(`<?xml version="1.0"?>
<VTKFile type="UnstructuredGrid" version="0.1" byte_order="LittleEndian" ${attributes}>
<!--made by hand--><UnstructuredGrid><Piece NumberOfPoints="6" NumberOfCells="3">
<Points>${array("Float64", "Points", points, 'NumberOfComponents="3"')}</Points>
<Cells>
${array("Int64", "connectivity", [...(corners[0] ?? []), 1, 2, 3, ...(corners[1] ?? [])])}
${array("Int64", "offsets", [4, 7, 11])}${array("UInt8", "types", [10, 5, 10])}</Cells>
<PointData>${array("Float64", "size", size)}${array("Float64", "direction", direction, 'NumberOfComponents="3"')}</PointData>
<CellData>${array("Float64", "size", [1, 2, 3])}</CellData>
</Piece></UnstructuredGrid></VTKFile>`);
  }

  test.each<[string, Form, string]>([
    ["as text", text, ""],
    ["in base64 together with their length", together, ""],
    ["in base64 after a separate length", apart, ""],
    ["compressed", packed, 'compressor="vtkZLibDataCompressor"'],
  ])("with arrays %s is read", async (_, form, attributes) => {
    await expectTwoTetrahedra(readVtu(vtu(form, attributes)), ["direction", "size"]);
  });

  test.each<[string, (file: string) => string, RegExp]>([
    ["of another kind", (file) => file.replaceAll("UnstructuredGrid", "ImageData"), /no unstructured grid/],
    ["without a piece", (file) => file.replace(/<Piece.*<\/Piece>/s, ""), /no piece/],
    ["with hexahedra", (file) => file.replace("10\n5\n10", "12\n5\n10"), /cells of type 12/],
    [
      "with a node index out of range",
      (file) => file.replace("\n5\n3\n4\n", "\n6\n3\n4\n"),
      /refers to node \d+, which/,
    ],
    [
      "with missing points",
      (file) => file.replace('NumberOfPoints="6"', 'NumberOfPoints="7"'),
      /6 points, but announces 7/,
    ],
    ["without tetrahedra", (file) => file.replace("10\n5\n10", "5\n5\n5"), /no tetrahedra/],
    ["without types", (file) => file.replace('"types"', '"kinds"'), /no array "types"/],
    [
      "with another compressor",
      (file) => file.replace(" >\n", ' compressor="vtkLZ4DataCompressor">\n'),
      /vtkLZ4DataCompressor/,
    ],
  ])("%s is rejected", async (_, damage, message) => {
    const file = new TextEncoder().encode(damage(new TextDecoder().decode(vtu(text))));
    const read = await readVtu(file);
    expect(read.success ? "" : read.errors[0].message).toMatch(message);
    expect(read.success ? "" : read.errors[0].remedy).toMatch(/\.$/);
  });

  test("with several pieces is read as one mesh, with the data of all pieces", async () => {
    const file = new TextDecoder().decode(vtu(text));
    const piece = /<Piece.*<\/Piece>/s.exec(file)?.[0] ?? "";
    const unnamed = piece.replace('Name="direction"', 'Name="other"');
    const empty = `<Piece NumberOfPoints="0" NumberOfCells="0"></Piece>`;
    const twice = file.replace(piece, `${empty}${piece}${empty}${unnamed}`);
    const options = { fileName: "a.vtu" };
    const encoded = (content: string) => new TextEncoder().encode(content);
    const one = await readMesh(encoded(file), options);
    const two = await readMesh(encoded(twice), options);
    if (!one.success || !two.success) throw new Error("not read");
    const repeated = (numbers: ArrayLike<number>, by = 0) => [
      ...Array.from(numbers),
      ...Array.from(numbers, (value) => value + by),
    ];
    const count = one.value.points.length / 3;
    expect([...two.value.points]).toEqual(repeated(one.value.points));
    expect([...two.value.tetrahedra]).toEqual(repeated(one.value.tetrahedra, count));
    expect([...two.value.triangles]).toEqual(repeated(one.value.triangles, count));
    expect([...two.value.nodeData.keys()]).toEqual(["size", "direction", "other"]);
    const direction = two.value.nodeData.get("direction")?.values ?? new Float64Array();
    expect([...direction.subarray(0, 3 * count)]).toEqual([
      ...(one.value.nodeData.get("direction")?.values ?? []),
    ]);
    expect(direction.subarray(3 * count).every(Number.isNaN)).toBe(true);
    expect([...(two.value.nodeData.get("size")?.values ?? [])]).toEqual(repeated(size));
    const welded = await readSurface(encoded(twice), options);
    expect(welded.success && [welded.value.points.length, welded.value.triangles.length]).toEqual([9, 6]);
  });

  test("with blocks that claim a million times their size is rejected before it is unpacked", async () => {
    const bomb: Form = (_, bytes) => {
      const block = deflateSync(Buffer.alloc(1 << 20));
      const header = Uint32Array.of(1, 0x7fffffff, 0, block.length);
      return `format="binary">${Buffer.from(header.buffer).toString("base64")}${(bytes.length > 0 ? block : bytes).toString("base64")}`;
    };
    const read = await readVtu(vtu(bomb, 'compressor="vtkZLibDataCompressor"'));
    expect(read.success ? "" : read.errors[0].message).toMatch(/more than zlib can compress/);
  });
});

describe("MSH", () => {
  const rows = (values: readonly number[], width: number, first = 1) =>
    Array.from({ length: values.length / width }, (_, i) =>
      [i + first, ...values.slice(width * i, width * (i + 1))].join(" "),
    ).join("\n");
  const coordinates = Array.from({ length: 6 }, (_, i) => points.slice(3 * i, 3 * i + 3).join(" ")).join(
    "\n",
  );
  const data = `$NodeData\n1\n"size"\n1\n0.0\n3\n0\n1\n6\n${rows(size, 1)}\n$EndNodeData
$NodeData\n1\n"direction"\n1\n0.0\n3\n0\n3\n6\n${rows(direction, 3)}\n$EndNodeData\n`;
  const blocks = `$MeshFormat\n4.1 0 8\n$EndMeshFormat
$Entities\n0 0 0 1\n1 0 0 0 1 1 1 0 0\n$EndEntities
$Nodes\n1 6 1 6\n3 1 0 6\n1\n2\n3\n4\n5\n6\n${coordinates}\n$EndNodes
$Elements\n2 3 1 3\n2 1 2 1\n1 2 3 4\n3 1 4 2\n2 2 3 4 5\n3 3 6 4 5\n$EndElements\n${data}`;
  const list = `$MeshFormat\n2.2 0 8\n$EndMeshFormat
$PhysicalNames\n1\n3 1 "all"\n$EndPhysicalNames
$Nodes\n6\n${rows(points, 3)}\n$EndNodes
$Elements\n3\n1 2 2 0 1 2 3 4\n2 4 2 0 1 2 3 4 5\n3 4 2 0 1 3 6 4 5\n$EndElements\n${data}`;

  test.each([
    ["4.1", blocks],
    ["2.2", list],
    ["4.1 with Windows line ends", blocks.replaceAll("\n", "\r\n")],
  ])("%s is read from text", async (_, file) => {
    await expectTwoTetrahedra(readMsh(new TextEncoder().encode(file)), ["direction", "size"]);
  });

  /** Returns a binary file in either byte order. */
  function binary(version: "4.1" | "2.2", isLittle: boolean): Uint8Array {
    const parts: Buffer[] = [];
    const text = (words: string) => parts.push(Buffer.from(words));
    const int = (...values: number[]) =>
      values.forEach((value) => {
        const bytes = Buffer.alloc(4);
        parts.push((bytes[isLittle ? "writeInt32LE" : "writeInt32BE"](value), bytes));
      });
    const long = (...values: number[]) =>
      values.forEach((value) => {
        const bytes = Buffer.alloc(8);
        parts.push((bytes[isLittle ? "writeBigUInt64LE" : "writeBigUInt64BE"](BigInt(value)), bytes));
      });
    const double = (...values: number[]) =>
      values.forEach((value) => {
        const bytes = Buffer.alloc(8);
        parts.push((bytes[isLittle ? "writeDoubleLE" : "writeDoubleBE"](value), bytes));
      });
    text(`$MeshFormat\n${version} 1 8\n`);
    int(1);
    text("\n$EndMeshFormat\n$Nodes\n");
    if (version === "4.1") {
      long(1, 6, 1, 6);
      int(3, 1, 0);
      long(6, 1, 2, 3, 4, 5, 6);
      double(...points);
      text("\n$EndNodes\n$Elements\n");
      long(1, 2, 1, 2);
      int(3, 1, 4);
      long(2, 1, 2, 3, 4, 5, 2, 3, 6, 4, 5);
    } else {
      text("6\n");
      for (let i = 0; i < 6; i++) {
        int(i + 1);
        double(...points.slice(3 * i, 3 * i + 3));
      }
      text("\n$EndNodes\n$Elements\n3\n");
      int(2, 1, 2, 1, 0, 1, 2, 3, 4, 4, 2, 2, 2, 0, 1, 2, 3, 4, 5, 3, 0, 1, 3, 6, 4, 5);
    }
    text('\n$EndElements\n$NodeData\n1\n"size"\n1\n0.0\n3\n0\n1\n6\n');
    size.forEach((value, i) => {
      int(i + 1);
      double(value);
    });
    text("\n$EndNodeData\n");
    return new Uint8Array(Buffer.concat(parts));
  }

  test.each([
    ["4.1", true],
    ["4.1", false],
    ["2.2", true],
    ["2.2", false],
  ] as const)("%s is read from binary, little-endian: %s", async (version, isLittle) => {
    await expectTwoTetrahedra(readMsh(binary(version, isLittle)), ["size"]);
  });

  test.each<[string, string, RegExp]>([
    ["of version 4.0", blocks.replace("4.1 0", "4.0 0"), /"4.0 0 8"/],
    ["of another kind", "solid\n", /begin with "\$MeshFormat"/],
    ["with hexahedra", blocks.replace("3 1 4 2", "3 1 5 2"), /type 5/],
    [
      "with a node tag that does not exist",
      blocks.replace("3 3 6 4 5", "3 3 7 4 5"),
      /refers to node \d+, which/,
    ],
    [
      "that announces more than it holds",
      blocks.replace("3 1 0 6", "3 1 0 600000"),
      /found "\$EndNodes", which is not a finite number/,
    ],
    ["that is truncated", blocks.slice(0, 150), /./],
  ])("%s is rejected", async (_, file, message) => {
    const read = await readMsh(new TextEncoder().encode(file));
    expect(read.success ? "" : read.errors[0].message).toMatch(message);
    expect(read.success ? "" : read.errors[0].remedy).toMatch(/\.$/);
  });
});

test.each([".vtu", ".msh"])("a %s file of this package is read with exact coordinates", async (extension) => {
  const mesh: Mesh = {
    points: Float64Array.from(points.slice(3)),
    triangles: Uint32Array.of(0, 2, 1),
    trianglePatch: Uint32Array.of(0),
    patches: [{ name: "surface", tag: 1 }],
    tetrahedra: Uint32Array.of(0, 1, 2, 3, 1, 4, 2, 3),
    tetrahedronRegion: Uint32Array.of(0, 1),
    regions: [1, 2].map((tag) => ({ name: `region ${tag}`, tag })),
    nodeData: new Map(),
  };
  const [file] = await writeMesh(mesh, `a${extension}`);
  if (file === undefined) throw new Error("nothing written");
  await expectTwoTetrahedra(readVolume(file.bytes, { fileName: file.fileName }), []);
});

describe("backgroundFromMesh", () => {
  const volume = (data: Readonly<Record<string, number>>) => ({
    points: Float64Array.from(points.slice(3)),
    tetrahedra: Uint32Array.of(0, 1, 2, 3, 1, 4, 2, 3),
    nodeData: new Map(
      Object.entries(data).map(([name, components]) => [
        name,
        { components, values: new Float64Array(5 * components).fill(2) },
      ]),
    ),
  });
  let mesher: Mesher;
  beforeAll(async () => {
    mesher = await createMesher();
  });
  afterAll(() => mesher.dispose());

  test("takes sizes, stretchings and directions from the file", async () => {
    expect(await mesher.backgroundFromMesh(volume({ size: 1, stretching: 1, direction: 3 }))).toMatchObject({
      sizes: new Float64Array(5).fill(2),
      stretchings: new Float64Array(5).fill(2),
      directions: new Float64Array(15).fill(2),
    });
  });

  test("ignores case in the name of an array if the match is unique", async () => {
    const capitals = volume({ Size: 1, STRETCHING: 1, Direction: 3, pressure: 1 });
    const { sizes, stretchings } = await mesher.backgroundFromMesh(capitals);
    expect([sizes, stretchings]).toEqual([new Float64Array(5).fill(2), new Float64Array(5).fill(2)]);
    expect(unusedData(capitals)).toEqual(["pressure"]);
    const both = volume({ Size: 1, SIZE: 1 });
    expect((await mesher.backgroundFromMesh(both)).sizes).not.toContain(2);
    expect(unusedData(both)).toEqual(["Size", "SIZE"]);
    expect(unusedData(volume({ Size: 1, size: 1, direction: 3 }))).toEqual(["Size", "direction"]);
  });

  test("omits what is stored at a node without a tetrahedron", async () => {
    const across = direction.flatMap((_, i) =>
      i % 3 === 0 ? [-(direction[i + 1] ?? 0), direction[i] ?? 0, 0] : [],
    );
    const data = {
      size,
      stretching: [7, 1, 2, 3, 4, 5],
      direction,
      secondStretching: [1, 5, 4, 3, 2, 1],
      SecondDirection: across,
    };
    const grid = await mesher.backgroundFromMesh({
      points: Float64Array.from(points),
      tetrahedra: Uint32Array.from(corners.flat()),
      nodeData: new Map(
        Object.entries(data).map(([name, values]) => [
          name,
          { components: values.length / 6, values: Float64Array.from(values) },
        ]),
      ),
    });
    expect([...grid.sizes]).toEqual(size.slice(1));
    expect([...(grid.stretchings ?? [])]).toEqual([1, 2, 3, 4, 5]);
    expect([...(grid.directions ?? [])]).toEqual(direction.slice(3));
    expect([...(grid.secondStretchings ?? [])]).toEqual([5, 4, 3, 2, 1]);
    expect([...(grid.secondDirections ?? [])]).toEqual(across.slice(3));
  });

  test("derives sizes from the edges if the file has none", async () => {
    const { sizes, stretchings } = await mesher.backgroundFromMesh(volume({ pressure: 1 }));
    expect(sizes).not.toContain(2);
    expect(stretchings).toBeUndefined();
  });

  test.each<[string, Record<string, number>, RegExp]>([
    ["three sizes per node", { size: 3 }, /`size` must have one value/],
    ["a stretching without a direction", { size: 1, stretching: 1 }, /needs `direction`/],
    [
      "a second stretching alone",
      { size: 1, secondStretching: 1, secondDirection: 3 },
      /`secondStretching` needs `stretching`/,
    ],
    [
      "directions that are not orthogonal",
      { size: 1, stretching: 1, direction: 3, secondStretching: 1, secondDirection: 3 },
      /node 0 .*not orthogonal.*orthogonal to the first/,
    ],
  ])("rejects %s", async (_, data, message) => {
    await expect(mesher.backgroundFromMesh(volume(data))).rejects.toThrow(message);
  });
});
