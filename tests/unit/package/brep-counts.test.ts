/** Damaged counts and shapes of BREP files, which OpenCascade would try to read for minutes. */
import { readFileSync } from "node:fs";

import { readSurface } from "tetrafront";
import { expect, test } from "vitest";

import { secondsFor } from "../../../wasm/dist/cad/cad-client.js";

test.each([
  "Locations",
  "Curve2ds",
  "Curves",
  "Polygon3D",
  "PolygonOnTriangulations",
  "Surfaces",
  "Triangulations",
  "TShapes",
])("a BREP file with an impossible number of %s is refused at once, with the line", async (table) => {
  const text = readFileSync(new URL("../../fixtures/plate.brep", import.meta.url), "latin1");
  const line = text.split("\n").findIndex((words) => words.startsWith(`${table} `)) + 1;
  expect(line).toBeGreaterThan(0);
  for (const count of ["2147483647", "-1", "99999", "1e9", ""]) {
    const damaged = text.replace(new RegExp(`^${table} .*`, "m"), `${table} ${count}`);
    const begin = performance.now();
    const read = await readSurface(Buffer.from(damaged, "latin1"), { fileName: "a.brep" });
    const error = read.success ? undefined : read.errors[0];
    expect(error?.message, count).toMatch(new RegExp(`^line ${line}: the file is damaged: .*${table}`));
    expect(error).toMatchObject({
      line,
      remedy: expect.stringMatching(/^Export the part again/) as string,
    });
    expect(performance.now() - begin).toBeLessThan(2000);
  }
});

test("a BREP file with an impossible number of poles is refused at once, with the line", async () => {
  const file =
    "DBRep_DrawableShape\n\nCASCADE Topology V1, (c) Matra-Datavision\nLocations 0\nCurve2ds 0\nCurves 1\n";
  const rest = "\nPolygon3D 0\nPolygonOnTriangulations 0\nSurfaces 0\nTriangulations 0\n\nTShapes 0\n";
  const text = `${file}7 0 0  1 2000000000 2 0 0 0 1 1 1 0 2 1 2 ${rest}`;
  const read = await readSurface(new TextEncoder().encode(text), { fileName: "a.brep" });
  expect(read.success ? "" : read.errors[0].message).toMatch(
    /^line 7: the file is damaged: .*2000000000 poles/,
  );
});

test.each([
  ["knots", "7 4 90000000 1 100000000 4"],
  ["poles", "7 1.5 0  90000000 100000000 0"],
])("a line of %s that begins with the number of a kind of curve is no impossible count", async (_, line) => {
  const text = plate.replace(/^Curves .*\n/m, (head) => `${head}${line}\n`);
  const read = await readSurface(Buffer.from(text, "latin1"), { fileName: "a.brep" });
  expect(read.success ? "" : read.errors[0].message).not.toMatch(/poles or knots/);
});

const plate = readFileSync(new URL("../../fixtures/plate.brep", import.meta.url), "latin1");

test.each([
  [
    "cut off in a shape",
    (text: string) => text.slice(0, text.lastIndexOf("+3 0 *")),
    /found the end of the file: it is truncated; before it, 42 of 44/,
  ],
  [
    "cut off before its shapes",
    (text: string) => text.slice(0, text.indexOf("TShapes")),
    /no table of shapes/,
  ],
  [
    "without an end of a shape",
    (text: string) => text.replace(" 0 *", " 0 +"),
    /expected a part of shape 3, an edge, found "\+"/,
  ],
  [
    "with a wrong kind of shape",
    (text: string) => text.replace("\nEd\n", "\nEx\n"),
    /expected the kind of shape 3, found "Ex"/,
  ],
  [
    "with a part that comes later",
    (text: string) => text.replace("-44 0 +43 0 *", "-44 0 +2 0 *"),
    /a part of shape 3/,
  ],
  [
    "with a curve that it lacks",
    (text: string) => text.replace("\n1  1 0 0 8", "\n1  99 0 0 8"),
    /geometry of shape 3, an edge/,
  ],
])("a BREP file %s is refused at once", async (_, damage, message) => {
  const damaged = damage(plate);
  expect(damaged).not.toBe(plate);
  const begin = performance.now();
  const read = await readSurface(Buffer.from(damaged, "latin1"), { fileName: "a.brep" });
  expect(read.success ? "" : read.errors[0].message).toMatch(message);
  expect(read.success ? "" : read.errors[0].message).toMatch(/^line \d+: the file is damaged: /);
  expect(performance.now() - begin).toBeLessThan(2000);
});

test("a file of a few kilobytes that keeps OpenCascade busy is stopped after seconds", () => {
  expect(secondsFor(3300)).toBeLessThan(10);
  expect(secondsFor(200_000)).toBeGreaterThan(60);
});
