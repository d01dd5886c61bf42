/**
 * Absurd option values and invalid paths: each is rejected in one line that names the valid range or the
 * remedy.
 */
import { mkdirSync, writeFileSync } from "node:fs";
import path from "node:path";

import { createMesher } from "tetrafront";
import { writeProject } from "tetrafront/project";
import { beforeAll, describe, expect, test } from "vitest";

import { tetrafront } from "../../support/command-line.js";
import { cubeProject } from "../../support/projects.js";
import { offFile } from "../../support/surface-files.js";
import { boxSurface } from "../../support/surfaces.js";
import { temporaryFolder } from "../../support/temporary-folder.js";

const folder = temporaryFolder("all tests");
beforeAll(() => {
  writeFileSync(path.join(folder.path, "part.off"), offFile(boxSurface(1)));
  writeFileSync(path.join(folder.path, "cube.json"), writeProject(cubeProject()));
  mkdirSync(path.join(folder.path, "parts"));
});

const MESH = ["mesh", "part.off", "-o", "x.vtu"];
const REMESH = ["remesh", "part.off", "-o", "x.ply"];
const PROPOSE = ["propose", "cube.json", "-o", "x.json"];
const SIZE = /from 1e-30 to 1e30/;

test.each<[readonly string[], RegExp]>([
  [[...MESH, "--size", "1e300"], SIZE],
  [[...MESH, "--size", "1e-300"], SIZE],
  [[...MESH, "--growth", "99"], /growth from 0 to 10/],
  [[...MESH, "--gradation", "99"], /gradation is 99\. Use 0, or a gradation above 1 and up to 10/],
  [[...MESH, "--gradation", "1.2", "--growth", "0.2"], /exclude each other/],
  [[...MESH, "--source", "0,0,0,1e300"], /sources\[0\]\.size: expected at most 1e\+30/],
  [[...MESH, "--source", "0,0,0,1,1e300"], /sources\[0\]\.distance: expected at most 1e\+30/],
  [[...MESH, "--source", "0,0,0,1,1,99"], /sources\[0\]\.growth: expected at most 10/],
  [[...MESH, "--weld", "1e300"], /from 0 to 1e30/],
  [[...MESH, "--weld", "7"], /extent of the whole surface is 1\. Use a distance below/],
  [[...MESH, "--surface", "polish"], /Allowed choices are auto, keep, refine, remesh/],
  [[...MESH, "--surface", "keep", "--tolerance", "0.1"], /--tolerance is for surfaces that are remeshed/],
  [[...MESH, "--surface", "refine", "--layers", "2"], /--layers is for surfaces that are remeshed/],
  [
    [...MESH, "--surface", "remesh", "--layers", "101"],
    /number of layers is 101\. Use a number from 0 to 100/,
  ],
  [["mesh", "cube.json", "-o", "x.vtu", "--surface", "remesh"], /--surface is for surfaces, .* a project/],
  [[...REMESH, "--size", "0"], SIZE],
  [[...REMESH, "--min-size", "-1"], SIZE],
  [[...REMESH, "--size", "1", "--min-size", "2"], /smallest size, 2, is larger than the largest, 1/],
  [[...REMESH, "--size", "1", "--max-size", "2"], /largest size is given together with an element size/],
  [[...REMESH, "--tolerance", "thin"], /tolerance is "thin"\. Use a distance from 1e-30 to 1e30/],
  [[...REMESH, "--feature-angle", "0"], /feature angle is 0\. Use an angle from 1 to 180 degrees/],
  [[...REMESH, "--angle-per-edge", "200"], /angle per edge is 200\. Use an angle from 1 to 180/],
  [[...REMESH, "--layers", "-1"], /number of layers is -1\. Use a number from 0 to 100/],
  [[...REMESH, "--growth", "99"], /growth from 0 to 10/],
  [[...REMESH, "--size", "1e-5"], /would have about \d+ triangles, most of them in .*the limit is 5000000/],
  [["remesh", "part.off", "-o", "x.vtu"], /"\.vtu" files cannot be written here/],
  [["remesh", "part.off", "-o", "part.off"], /would replace the input/],
  [["remesh", "cube.json", "-o", "x.ply"], /only surfaces can be remeshed\. Mesh it with `tetrafront mesh`/],
  [["remesh", "part.off", "-o", "-", "--to", "ply", "--json"], /--json and the surface cannot both/],
  [["cover", "cube.json", "-o", "x.json", "--size", "1e300"], SIZE],
  [[...PROPOSE, "--max-size", "1e300"], SIZE],
  [[...PROPOSE, "--angle-per-edge", "1e300"], /0, or an angle from 0.36 to 360 degrees/],
  [[...PROPOSE, "--growth", "99"], /from 0 to 10/],
  [["propose", "part.off", "--angle-per-edge", "360"], /angle per edge is 360\. Use an angle from 1 to 180/],
  [["propose", "part.off", "--layers", "1000"], /number of layers is 1000\. Use a number from 0 to 100/],
  [["propose", "part.off", "--uniform", "1"], /unknown option '--uniform'/],
  [["propose", "part.off", "--max-size", "0"], /largest size/],
  [["mesh", ".", "-o", "x.vtu"], /\.: This is a folder\. Use a file in it.*'\*\.stl'/],
  [["mesh", "cube.json", "-o", "parts"], /parts: This is a folder\. Use the name of a file in it/],
  [["convert", "part.off", "-o", "parts"], /parts: This is a folder/],
  [["cover", "cube.json", "-o", "parts"], /parts: This is a folder/],
  [["mesh", "part.off", "-o", "x.vtu", "--background", "parts"], /parts: This is a folder/],
  [["check", "parts"], /parts: This is a folder/],
  [["stats", "missing.xyz"], /missing\.xyz: There is no such file/],
  [["mesh", "", "-o", "x.vtu"], /"": The file name is empty/],
  [["mesh", "part.off", "-o", ""], /"": The file name is empty/],
  [["mesh", "part.off", "-o", "x.vtu", "--from", ""], /"": Unknown format/],
])("rejects the arguments %j", async (args, message) => {
  const { code, stderr } = await tetrafront(folder.path, args);
  expect(stderr).toMatch(message);
  expect(code).toBe(2);
});

describe("a size larger than a given surface", () => {
  test("has no effect and gives a warning", async () => {
    const mesher = await createMesher();
    const surface = boxSurface(2);
    try {
      const codes = async (size: number, given = surface) => {
        const { report } = await mesher.fillSurface(given, { size });
        return report.diagnostics.map(({ code, severity }) => `${severity} ${code}`);
      };
      expect(await codes(1.5)).toEqual(["warning size-too-large"]);
      expect(await codes(0.9)).toEqual([]);
      // An unused node does not enlarge the model.
      const points = Float64Array.of(...surface.points, 100, 0, 0);
      expect(await codes(1.5, { ...surface, points })).toContain("warning size-too-large");
    } finally {
      mesher.dispose();
    }
  });
});
