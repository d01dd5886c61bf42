/** Damaged counts of BREP files, which OpenCascade would try to read for minutes. */
import { readFileSync } from "node:fs";

import { readSurface } from "tetrafront";
import { expect, test } from "vitest";

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
