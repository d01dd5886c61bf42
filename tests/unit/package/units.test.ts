/** Units and scales of files that are read: exact factors, in the package and on the command line. */
import { type LengthOptions, readMesh, readSurface, LENGTH_UNITS, writeMesh } from "tetrafront";
import { describe, expect, test } from "vitest";

import { blockMesh } from "../../support/block-mesh.js";

/** Metres per unit, from the definitions of the units. */
const METRES = { um: 1e-6, mm: 1e-3, cm: 1e-2, m: 1, in: 0.0254, ft: 0.3048 } as const;

const smesh = (x: string) =>
  new TextEncoder().encode(
    `4 3 0 0\n0 0 0 0\n1 ${x} 0 0\n2 0 ${x} 0\n3 0 0 ${x}\n4 0\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n` +
      `1\n1 ${x} 0 0\n1\n1 0 0 ${x} 5 2\n`,
  );

async function read(options: LengthOptions, x = "3") {
  const found = await readSurface(smesh(x), { fileName: "a.smesh", ...options });
  if (!found.success) throw new Error(`${found.errors[0].message}. ${found.errors[0].remedy}`);
  return found.value;
}

describe.each(LENGTH_UNITS)("lengths in %s", (fileUnits) => {
  test.each(LENGTH_UNITS)("become %s", async (units) => {
    const { points, unit, regionPoints } = await read({ fileUnits, units });
    const factor = METRES[fileUnits] / METRES[units];
    expect(unit).toBe(units);
    expect(Math.abs((points[3] ?? 0) / (3 * factor) - 1)).toBeLessThan(1e-15);
    expect(regionPoints?.holes[0]?.position[0]).toBe(points[3]);
    expect(regionPoints?.regions[0]?.position[2]).toBe(points[3]);
    expect((regionPoints?.regions[0]?.maxVolume ?? 0) / (2 * factor ** 3)).toBeCloseTo(1, 12);
  });
});

test("millimetres become metres like the decimal number", async () => {
  for (const x of ["0.1", "25.4", "1234.567", "0.007", "3e-5"]) {
    const { points } = await read({ fileUnits: "mm", units: "m" }, x);
    expect(points[3]).toBe(Number(x) / 1000);
  }
});

test("inches become millimetres like the decimal number", async () => {
  for (const x of ["3", "0.5", "7", "11"]) {
    const { points } = await read({ fileUnits: "in", units: "mm" }, x);
    expect(points[3]).toBe(Number((Number(x) * 25.4).toPrecision(12)));
  }
});

test("a scale multiplies all coordinates", async () => {
  expect((await read({ scale: 2 })).points[3]).toBe(6);
  const both = await read({ scale: 2, fileUnits: "in", units: "mm" });
  expect(both.points[3]).toBeCloseTo(152.4, 12);
  expect((await read({ scale: 1 })).points).toEqual((await read({})).points);
});

test("a unit that is not known is an error with a remedy", async () => {
  await expect(read({ units: "mm" })).rejects.toThrow(/does not state its unit.*`fileUnits`/s);
  const wrong = { units: "yd" } as unknown as LengthOptions;
  await expect(read(wrong)).rejects.toThrow(/options\.units is invalid/);
  await expect(read({ scale: -1 })).rejects.toThrow(/options\.scale is invalid/);
});

test("target sizes at the nodes are lengths too; other values are kept", async () => {
  const mesh = blockMesh();
  const values = Float64Array.from({ length: mesh.points.length / 3 }, (_, node) => node + 1);
  const given = { components: 1, values };
  const nodeData = new Map([
    ["size", given],
    ["heat", given],
  ]);
  const [file] = await writeMesh({ ...mesh, nodeData }, "a.vtu");
  const found = await readMesh(file?.bytes ?? new Uint8Array(), { fileName: "a.vtu", scale: 3 });
  if (!found.success) throw new Error(found.errors[0].message);
  expect(found.value.points).toEqual(mesh.points.map((x) => 3 * x));
  expect(found.value.nodeData.get("size")?.values).toEqual(values.map((x) => 3 * x));
  expect(found.value.nodeData.get("heat")?.values).toEqual(values);
});
