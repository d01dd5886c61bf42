/** 3MF files whose zip entries have ZIP64 sizes, with and without a ZIP64 end record. */
import { createMesher, readSurface } from "tetrafront";
import { expect, test } from "vitest";

import { boxSurface } from "../../support/surfaces.js";
import { meshTags, threeMfFile } from "../../support/threemf-files.js";

/** Moves the numbers of each entry of the central directory to a ZIP64 extra field, after another extra field. */
function withLongSizes(file: Uint8Array, fields: readonly number[], hasOtherFirst: boolean): Uint8Array {
  const given = Buffer.from(file);
  const end = given.length - 22;
  const begin = given.readUInt32LE(end + 16);
  const parts: Buffer[] = [];
  for (let at = begin; at < end;) {
    const length = 46 + given.readUInt16LE(at + 28);
    const entry = Buffer.from(given.subarray(at, at + length));
    at += length + given.readUInt16LE(at + 30) + given.readUInt16LE(at + 32);
    const other = hasOtherFirst ? Buffer.from([0x55, 0x54, 1, 0, 7]) : Buffer.alloc(0);
    const extra = Buffer.alloc(4 + 8 * fields.length);
    extra.writeUInt16LE(1, 0);
    extra.writeUInt16LE(8 * fields.length, 2);
    fields.forEach((field, i) => {
      extra.writeUInt32LE(entry.readUInt32LE(field), 4 + 8 * i);
      entry.writeUInt32LE(0xffffffff, field);
    });
    entry.writeUInt16LE(other.length + extra.length, 30);
    entry.writeUInt16LE(0, 32);
    parts.push(entry, other, extra);
  }
  const directory = Buffer.concat(parts);
  const tail = Buffer.from(given.subarray(end));
  tail.writeUInt32LE(directory.length, 12);
  return Buffer.concat([given.subarray(0, begin), directory, tail]);
}

const SIZES = [24, 20];
const cube = threeMfFile(
  `<object id="1" type="model">${meshTags(boxSurface(2))}</object>`,
  '<item objectid="1"/>',
);

test.each([
  ["no long size", [], false],
  ["both sizes", SIZES, false],
  ["both sizes, after another extra field", SIZES, true],
  ["the original size", [24], false],
  ["sizes and offset", [...SIZES, 42], false],
] as const)("a 3MF file is read with %s", async (_, fields, hasOtherFirst) => {
  const file = withLongSizes(cube, fields, hasOtherFirst);
  const read = await readSurface(file, { fileName: "cube.3mf" });
  if (!read.success) throw new Error(read.errors[0].message);
  const mesher = await createMesher();
  expect((await mesher.inspectSurface(read.value)).volume).toBeCloseTo(1, 12);
  mesher.dispose();
});

test("a damaged zip file gives an error, wherever it ends", async () => {
  const file = withLongSizes(cube, SIZES, true);
  for (let length = 1; length < file.length; length += 7) {
    const read = await readSurface(file.subarray(0, length), { fileName: "cube.3mf" });
    expect(read.success).toBe(false);
  }
});

test("a file with a damaged byte gives an error, or the same surface", async () => {
  const read = async (file: Uint8Array) => readSurface(file, { fileName: "cube.3mf" });
  const whole = await read(cube);
  let refused = 0;
  for (let at = 0; at < cube.length; at++) {
    const file = Uint8Array.from(cube, (byte, i) => (i === at ? byte ^ 4 : byte));
    const found = await read(file);
    if (found.success) expect(found.value).toEqual(whole.success ? whole.value : undefined);
    else if (found.errors[0].message.includes("damaged")) refused++;
  }
  expect(refused).toBeGreaterThan(cube.length / 4);
});
