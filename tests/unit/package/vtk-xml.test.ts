/** VTU files in all forms of the specification: parsed from bytes, without losing or inventing values. */
import { zlibSync } from "fflate";
import { readMesh, readVolume, writeMesh, type ReadResult } from "tetrafront";
import { expect, test, vi } from "vitest";

const encoder = new TextEncoder();

interface Tetrahedron {
  /** Content of `<PointData>`. */
  readonly pointData?: string;
  readonly cellData?: string;
  /** Attributes and content of the array of points. */
  readonly points?: string;
  readonly data?: string;
}

const POINTS = "0 0 0 1 0 0 0 1 0 0 0 1";

function piece({ pointData = "", cellData = "", points = `format="ascii">${POINTS}` }: Tetrahedron): string {
  return `<Piece NumberOfPoints="4" NumberOfCells="1">
<Points><DataArray type="Float64" NumberOfComponents="3" ${points}</DataArray></Points>
<Cells><DataArray type="Int32" Name="connectivity" format="ascii">0 1 2 3</DataArray>
<DataArray type="Int32" Name="offsets" format="ascii">4</DataArray>
<DataArray type="UInt8" Name="types" format="ascii">10</DataArray></Cells>
<PointData>${pointData}</PointData><CellData>${cellData}</CellData></Piece>\n`;
}

const vtu = (pieces: string, attributes = "", appended = "") =>
  `<VTKFile type="UnstructuredGrid" byte_order="LittleEndian" ${attributes}>\n<UnstructuredGrid>
${pieces}</UnstructuredGrid>${appended}</VTKFile>`;

const array = (name: string, numbers: string, attributes = "") =>
  `<DataArray type="Float64" Name="${name}" format="ascii" ${attributes}>${numbers}</DataArray>`;

const volume = (file: string | Uint8Array) =>
  readVolume(typeof file === "string" ? encoder.encode(file) : file, { fileName: "a.vtu" });

function valueOf<T>(read: ReadResult<T>): T {
  if (!read.success) throw new Error(read.errors[0].message);
  return read.value;
}

const problemOf = async (file: string | Uint8Array): Promise<string> => {
  const read = await volume(file);
  return read.success ? "it could be read" : read.errors[0].message;
};

test("long content is never decoded into one string, which could exceed the maximum string length", async () => {
  const blanks = " ".repeat(1 << 16);
  const coded = Buffer.from(new Uint8Array(1 << 16)).toString("base64");
  const head = Buffer.from(Uint32Array.of(4 * 8, 0).buffer).subarray(0, 4);
  const sizes = Buffer.concat([head, Buffer.from(Float64Array.of(1, 2, 3, 4).buffer)]).toString("base64");
  const pointData =
    `<DataArray type="Float64" Name="a" format="appended" offset="0"/>${array("b", `1${blanks}2 3 4`)}` +
    `<DataArray type="Float64" Name="c" format="binary">${sizes}${blanks}</DataArray>`;
  const appended = `<AppendedData encoding="base64">_${sizes}${coded}</AppendedData>`;
  const decode = vi.spyOn(TextDecoder.prototype, "decode");
  try {
    const { nodeData } = valueOf(await volume(vtu(piece({ pointData }), "", appended)));
    for (const name of ["a", "b", "c"]) expect([...(nodeData.get(name)?.values ?? [])]).toEqual([1, 2, 3, 4]);
    const longest = Math.max(...decode.mock.calls.map(([bytes]) => bytes?.byteLength ?? 0));
    expect(longest).toBeLessThan(1 << 12);
  } finally {
    decode.mockRestore();
  }
});

test("a piece without an array gets NaN at its nodes and does not affect the values of other pieces", async () => {
  const pieces = [
    piece({ pointData: array("size", "1 2 3 4") }),
    piece({ pointData: array("other", "5 6 7 8 9 10 11 12", 'NumberOfComponents="2"') }),
  ];
  for (const order of [pieces, pieces.toReversed()]) {
    const { nodeData } = valueOf(await volume(vtu(order.join(""))));
    const first = order === pieces ? 0 : 4;
    expect([...(nodeData.get("size")?.values ?? [])].slice(first, first + 4)).toEqual([1, 2, 3, 4]);
    expect(nodeData.get("size")?.values.filter(Number.isNaN)).toHaveLength(4);
    expect(nodeData.get("other")).toMatchObject({ components: 2 });
    expect(nodeData.get("other")?.values.filter(Number.isNaN)).toHaveLength(8);
  }
});

test("too few values at nodes, or other components in another piece, are rejected by name", async () => {
  expect(await problemOf(vtu(piece({ pointData: array("size", "1 2 3") })))).toMatch(
    /line 8: "size" has 3 values, but 4 points need 1 each/,
  );
  const [one, two] = ["1 2 3 4", "1 2 3 4 5 6 7 8"].map((numbers, i) =>
    piece({ pointData: array("size", numbers, `NumberOfComponents="${i + 1}"`) }),
  );
  expect(await problemOf(vtu(`${one}${two}`))).toMatch(/line 14: "size" has 8 values, but 4 points need 1/);
  const none = piece({ pointData: array("size", "1 2 3 4", 'NumberOfComponents="some"') });
  expect(await problemOf(vtu(none))).toMatch(/line 8: NumberOfComponents must be .*"some"/);
});

test("a cell without a value of its group is rejected", async () => {
  const read = await readMesh(encoder.encode(vtu(piece({ cellData: array("region", "") }))), {
    fileName: "a.vtu",
  });
  expect(read.success ? "" : read.errors[0].message).toMatch(/cell 0 .* has no value of "region"/);
});

test("names are UTF-8 with entities, comments are skipped, and unused arrays are not parsed", async () => {
  const pointData =
    array("Größe &lt;m&gt; &amp; &quot;so&quot;", "nan -inf 1 +1e3") +
    '<DataArray type="String" Name="words" format="ascii">104 0</DataArray>' +
    '<DataArray type="Bit" Name="bits" format="appended" offset="99"/>';
  const cellData =
    '<DataArray type="String" Name="pressure" format="ascii">one</DataArray>' + array("region", "7");
  const file = vtu(`<!-- <Piece NumberOfPoints="x"> -->${piece({ pointData, cellData })}`);
  const read = await readMesh(encoder.encode(file), { fileName: "a.vtu" });
  const mesh = valueOf(read);
  expect([...mesh.nodeData.keys()]).toEqual(['Größe <m> & "so"']);
  expect([...(mesh.nodeData.values().next().value?.values ?? [])]).toEqual([NaN, -Infinity, 1, 1000]);
  expect(mesh.regions.map(({ tag }) => tag)).toEqual([7]);
});

test("a compressed block with a wrong checksum is rejected as damaged", async () => {
  const points = new Uint8Array(Float64Array.from(POINTS.split(" "), Number).buffer);
  const packed = zlibSync(points);
  const file = (damage: (bytes: Uint8Array) => void) => {
    const bytes = packed.slice();
    damage(bytes);
    const head = new Uint8Array(Uint32Array.of(1, points.length, 0, bytes.length).buffer);
    const coded = [head, bytes].map((part) => Buffer.from(part).toString("base64")).join("");
    return vtu(piece({ points: `format="binary">${coded}` }), 'compressor="vtkZLibDataCompressor"');
  };
  expect([...valueOf(await volume(file(() => undefined))).points]).toEqual(POINTS.split(" ").map(Number));
  const last = packed.length - 1;
  expect(await problemOf(file((bytes) => (bytes[last] = (bytes[last] ?? 0) ^ 1)))).toMatch(
    /line 4: a compressed block is damaged/,
  );
});

/**
 * meshio (5.3) reads the uncompressed base64 data from the first byte on. It looks up the array with the
 * current offset (the first match in the file) and replaces the offset by a new one, which can equal the old
 * offset of another array.
 */
test("written offsets are unambiguous for readers that replace them one by one", async () => {
  const [file] = await writeMesh(
    valueOf(await readMesh(encoder.encode(vtu(piece({}))), { fileName: "a.vtu" })),
    "b.vtu",
  );
  const text = Buffer.from(file?.bytes ?? []).toString("latin1");
  const offsets = [...text.matchAll(/ offset="(\d+)"/g)].map(([, offset]) => Number(offset));
  expect(offsets).toHaveLength(6);
  const order = offsets.map((_, array) => array).sort((a, b) => (offsets[a] ?? 0) - (offsets[b] ?? 0));
  // The arrays before this one already have new offsets; none of them may precede it in the file.
  order.forEach((array, at) => {
    for (const renamed of order.slice(0, at)) expect(renamed).toBeGreaterThan(array);
  });
});

test("progress advances while arrays are decoded and cells are made, and is complete only at the end", async () => {
  const count = 50_000;
  const corners = Array.from({ length: count }, () => "0 1 2 3").join(" ");
  const offsets = Array.from({ length: count }, (_, i) => 4 * (i + 1)).join(" ");
  const many = `<Piece NumberOfPoints="4" NumberOfCells="${count}">
<Points><DataArray type="Float64" NumberOfComponents="3" format="ascii">${POINTS}</DataArray></Points>
<Cells><DataArray type="Int32" Name="connectivity" format="ascii">${corners}</DataArray>
<DataArray type="Int32" Name="offsets" format="ascii">${offsets}</DataArray>
<DataArray type="UInt8" Name="types" format="ascii">${"10 ".repeat(count)}</DataArray></Cells></Piece>`;
  const file = encoder.encode(vtu(many));
  const progress: number[] = [];
  const onProgress = (bytes: number) => progress.push(bytes);
  const read = await readMesh(file.slice(), { fileName: "a.vtu", onProgress });
  expect(valueOf(read).tetrahedra).toHaveLength(4 * count);
  expect(progress).toEqual(progress.toSorted((a, b) => a - b));
  expect(progress.indexOf(file.length)).toBe(progress.length - 1);
  // Three arrays of cells are decoded and the cells made in a dozen steps after all bytes have arrived.
  const behind = progress.filter((bytes) => bytes > 0.3 * file.length);
  expect(new Set(behind).size).toBeGreaterThan(10);
});
