/** XML files in UTF-16 and Latin-1: 3MF and VTU. */
import { readSurface, readVolume } from "tetrafront";
import { expect, test } from "vitest";

import { xmlInUtf8 } from "../../../wasm/dist/formats/xml-encoding.js";
import { boxSurface } from "../../support/surfaces.js";
import { meshTags, packedModel } from "../../support/threemf-files.js";

function utf16(text: string, isLittle: boolean): Uint8Array {
  const bytes = Buffer.from(text, "utf16le");
  return isLittle ? bytes : bytes.swap16();
}

const latin1 = (text: string) => Buffer.from(text, "latin1");

const model = (encoding: string) => `<?xml version="1.0" encoding="${encoding}"?>
<model unit="millimeter"><resources><object id="1" name="Gehäuse Ã©">${meshTags(boxSurface(1))}</object>
<object id="2" name="b">${meshTags(boxSurface(1, [3, 0, 0], [4, 1, 1]))}</object></resources>
<build><item objectid="1"/><item objectid="2"/></build></model>`;

const cases: readonly (readonly [string, Uint8Array])[] = [
  ["UTF-8", Buffer.from(model("UTF-8"))],
  ["UTF-8 with a mark", Buffer.from(`\ufeff${model("UTF-8")}`)],
  ["UTF-16, low byte first", utf16(`\ufeff${model("UTF-16")}`, true)],
  ["UTF-16, high byte first", utf16(`\ufeff${model("UTF-16")}`, false)],
  ["UTF-16 without a mark", utf16(model("UTF-16"), true)],
  ["ISO-8859-1", latin1(model("ISO-8859-1"))],
];

test.each(cases)("a model in %s is read with its names", async (_, bytes) => {
  const read = await readSurface(packedModel(bytes), { fileName: "a.3mf" });
  if (!read.success) throw new Error(read.errors[0].message);
  expect(read.value.triangles.length).toBe(3 * 24);
  expect(read.value.surfaceRegions?.regions.map(({ name }) => name)).toEqual(["Gehäuse Ã©", "b"]);
});

const vtu = `<?xml version="1.0"?>
<VTKFile type="UnstructuredGrid" byte_order="LittleEndian"><UnstructuredGrid>
<Piece NumberOfPoints="4" NumberOfCells="1">
<Points><DataArray type="Float64" NumberOfComponents="3" format="ascii">0 0 0 1 0 0 0 1 0 0 0 1</DataArray></Points>
<Cells><DataArray type="Int32" Name="connectivity" format="ascii">0 1 2 3</DataArray>
<DataArray type="Int32" Name="offsets" format="ascii">4</DataArray>
<DataArray type="UInt8" Name="types" format="ascii">10</DataArray></Cells></Piece></UnstructuredGrid></VTKFile>`;

test.each([true, false])("a VTU file in UTF-16 is read, low byte first: %s", async (isLittle) => {
  const read = await readVolume(utf16(`\ufeff${vtu}`, isLittle), { fileName: "a.vtu" });
  if (!read.success) throw new Error(read.errors[0].message);
  expect(read.value.tetrahedra).toHaveLength(4);
});

test("characters across the pieces of a long file, and binary data after Latin-1, are kept", () => {
  const long = `<?xml version="1.0"?><a n="${"ä😀".repeat(400_000)}"/>`;
  expect(Buffer.from(xmlInUtf8(utf16(`\ufeff${long}`, false))).toString()).toBe(long);
  const head = '<?xml version="1.0" encoding="latin1"?><a n="ä"/><AppendedData encoding="raw">_';
  const binary = Uint8Array.of(0xe4, 0xff, 0, 1);
  const whole = xmlInUtf8(Buffer.concat([latin1(head), binary]));
  expect(Buffer.from(whole).equals(Buffer.concat([Buffer.from(head), binary]))).toBe(true);
});
