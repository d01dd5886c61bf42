/**
 * Errors for invalid arguments of callers without type checks, and the error locations that readers report.
 */
import {
  createMesher,
  MesherError,
  readMesh,
  readSurface,
  readVolume,
  writeMesh,
  type ErrorCode,
  type Mesher,
  type ReadError,
} from "tetrafront";
import { parseProject, readProject } from "tetrafront/project";
import { afterAll, beforeAll, describe, expect, test } from "vitest";

import { cubeProject } from "../../support/projects.js";
import { blockMesh } from "../../support/block-mesh.js";
import { boxSurface } from "../../support/surfaces.js";

let mesher: Mesher;
beforeAll(async () => {
  mesher = await createMesher();
});
afterAll(() => mesher.dispose());

const CODES: readonly ErrorCode[] = [
  "invalid-argument",
  "invalid-arrays",
  "invalid-option",
  "invalid-project",
  "not-a-project",
  "empty-file",
  "malformed-file",
  "unknown-format",
];

/** Returns the error codes of a failed call, however it reports them; `undefined` if it reports none. */
async function codesOf(call: () => unknown): Promise<readonly (string | undefined)[]> {
  try {
    const result = (await call()) as {
      readonly errors?: readonly ReadError[];
      readonly report?: { readonly diagnostics: readonly ReadError[] };
    };
    return (result.errors ?? result.report?.diagnostics ?? [{ code: undefined }]).map(({ code }) => code);
  } catch (failure) {
    if (!(failure instanceof MesherError) || failure.code !== "invalid-input") return [undefined];
    return failure.data.diagnostics.map(({ code }) => code);
  }
}

const surface = boxSurface(1);
const block = blockMesh(1);

describe.each<[string, unknown]>([
  ["nothing", undefined],
  ["null", null],
  ["a number", 5],
  ["a word", "word"],
  ["a list of numbers", [1, 2]],
  ["an object with other properties", { lines: 5 }],
])("%s", (_, given) => {
  const wrong = given as never;
  test.each<[string, () => unknown]>([
    ["the source of readSurface", () => readSurface(wrong, { fileName: "a.stl" })],
    ["the source of readMesh", () => readMesh(wrong, { fileName: "a.vtu" })],
    ["the options of readSurface", () => readSurface(new Uint8Array(9), wrong)],
    ["the options of readVolume", () => readVolume(new Uint8Array(9), wrong)],
    ["the text of readProject", () => readProject(wrong)],
    ["the value of parseProject", () => parseProject(wrong)],
    ["the mesh of writeMesh", () => writeMesh(wrong, "a.vtu")],
    ["the name of writeMesh", () => writeMesh(block, wrong)],
    ["the surface to fill", () => mesher.fillSurface(wrong)],
    ["the project to mesh", () => mesher.meshProject(wrong)],
    ["the project of a preview", () => mesher.previewProject(wrong)],
    ["the project to cover", () => mesher.coverProject(wrong)],
    ["the project of a proposal", () => mesher.proposeSizes(wrong)],
    ["the project of size samples", () => mesher.sampleSizes(wrong, new Float64Array(3))],
    ["the positions of size samples", () => mesher.sampleSizes(cubeProject(), wrong)],
    ["the mesh for a background", () => mesher.backgroundFromMesh(wrong)],
    ["the surface to inspect", () => mesher.inspectSurface(wrong)],
    ["the surface to repair", () => mesher.repairSurface(wrong)],
    ["the mesh to inspect", () => mesher.inspectMesh(wrong)],
  ])("as %s is rejected with a code", async (__, call) => {
    const codes = await codesOf(call);
    expect(codes.length).toBeGreaterThan(0);
    expect(codes.filter((code) => !CODES.includes(code as ErrorCode))).toEqual([]);
  });
});

describe.each<[string, unknown]>([
  ["null", null],
  ["a number", 5],
])("%s", (_, given) => {
  const wrong = given as never;
  test.each<[string, () => unknown]>([
    ["the options of fillSurface", () => mesher.fillSurface(surface, wrong)],
    ["the options of repairSurface", () => mesher.repairSurface(surface, wrong)],
    ["the options of backgroundFromMesh", () => mesher.backgroundFromMesh(block, wrong)],
    ["the control of fillSurface", () => mesher.fillSurface(surface, {}, wrong)],
    ["the options of inspectSurface", () => mesher.inspectSurface(surface, wrong)],
    ["the control of inspectSurface", () => mesher.inspectSurface(surface, {}, wrong)],
    ["a signal", () => mesher.inspectSurface(surface, {}, { signal: wrong })],
  ])("as %s is rejected as an invalid option", async (__, call) => {
    expect(await codesOf(call)).toEqual(["invalid-option"]);
  });
});

test("writeMesh rejects a mesh whose arrays do not match", async () => {
  for (const wrong of [
    { points: block.points.subarray(1) },
    { tetrahedra: block.tetrahedra.map((node) => node + 1) },
    { trianglePatch: block.trianglePatch.subarray(1) },
    { patches: [] },
  ]) {
    expect(await codesOf(() => writeMesh({ ...block, ...wrong }, "a.su2"))).toEqual(["invalid-arrays"]);
  }
});

test("readSurface rejects a source that does not deliver bytes", async () => {
  const words = ["solid a", "endsolid a"] as unknown as Iterable<Uint8Array>;
  expect(await codesOf(() => readSurface(words, { fileName: "a.stl" }))).toEqual(["invalid-argument"]);
});

describe("readers report the location of", () => {
  const vtu = (points: string, connectivity: string, count = '"4"') =>
    `<VTKFile type="UnstructuredGrid">\n<Piece NumberOfPoints=${count} NumberOfCells="1">\n<Points>
<DataArray type="Float64" format="ascii">\n0 0 0\n1 0 0\n${points}\n0 0 1\n</DataArray></Points>\n<Cells>
<DataArray type="Int32" Name="connectivity" format="ascii">\n${connectivity}</DataArray>
<DataArray type="Int32" Name="offsets" format="ascii">4</DataArray>
<DataArray type="UInt8" Name="types" format="ascii">10</DataArray></Cells></Piece></VTKFile>`;
  const vtk = (cells: string, points = "0 0 0 1 0 0\n0 1 0 0 0 1") =>
    `# vtk DataFile Version 3.0\ntest\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 4 float\n${points}
CELLS 1 5\n${cells}\nCELL_TYPES 1\n10\n`;
  const ply = `ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z
element face 2\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n3 0 1 7\n`;
  // The corner would be 0, a valid index, if truncated to 32 bits.
  const plyBefore = `ply\nformat ascii 1.0\nelement face 2\nproperty list uchar double vertex_indices
element vertex 3\nproperty float x\nproperty float y\nproperty float z\nend_header\n3 0 1 2
3 4294967296 1 2\n0 0 0\n1 0 0\n0 1 0\n`;

  test.each<[string, string, string, number, RegExp]>([
    ["a word among coordinates", "a.vtu", vtu("0 x 0", "0 1 2 3"), 7, /found "x"/],
    ["too few coordinates", "a.vtu", vtu("", "0 1 2 3"), 4, /3 points, but announces 4/],
    ["a node that does not exist", "a.vtu", vtu("0 1 0", "0 1 2 9"), 11, /refers to node 9, which its piece/],
    ["an invalid count", "a.vtu", vtu("0 1 0", "0 1 2 3", '"many"'), 2, /NumberOfPoints .*, found "many"/],
    [
      "a missing count",
      "a.vtu",
      vtu("0 1 0", "", '"4"').replace(/NumberOfPoints="4"/, ""),
      2,
      /has no NumberOf/,
    ],
    [
      "an invalid node index in legacy VTK",
      "a.vtk",
      vtk("4 0 1 2 9"),
      8,
      /refers to node 9, which does not exist/,
    ],
    ["an invalid corner in PLY", "a.ply", ply, 14, /face 1 .*has corner 7/],
    ["an invalid corner in PLY before the points", "a.ply", plyBefore, 11, /face 1 .*has corner 4294967296/],
    ["another header", "a.msh", "hello\nthere\n", 1, /does not begin with/],
    ["text that is not STL", "a.stl", "hello\n".repeat(99), 1, /must begin with "solid"/],
  ])("%s", async (_, fileName, file, line, message) => {
    const read = await readMesh(new TextEncoder().encode(file), { fileName });
    if (read.success) throw new Error("it could be read");
    const [problem] = read.errors;
    expect(problem.message).toMatch(message);
    expect(problem).toMatchObject({ code: "malformed-file", fileName, line });
    expect(problem.message.startsWith(`line ${line}: `)).toBe(true);
  });

  test("a damaged compressed block by its byte offset", async () => {
    const [written] = await writeMesh(block, "a.vtu");
    if (written === undefined) throw new Error("nothing was written");
    const bytes = written.bytes.slice();
    const begin = new TextDecoder("latin1").decode(bytes).indexOf("\n_") + 2;
    bytes.fill(255, begin + 40, begin + 60);
    const read = await readMesh(bytes, { fileName: "a.vtu" });
    if (read.success) throw new Error("it could be read");
    expect(read.errors[0]).toMatchObject({ code: "malformed-file", offset: begin });
    expect(read.errors[0].message).toMatch(`byte ${begin}: `);
  });

  test("an error in a second file by its name, and a missing second file", async () => {
    const node = new TextEncoder().encode("3 3 0 0\n1 0 0 0\n2 1 x 0\n");
    const openOther = () => Promise.resolve(node);
    const read = await readMesh(new TextEncoder().encode("0 0\n"), { fileName: "a.face", openOther });
    expect(read).toMatchObject({ success: false, errors: [{ fileName: "a.node", line: 3 }] });
    const alone = await readMesh(new TextEncoder().encode("0 0\n"), { fileName: "a.face" });
    expect(alone).toMatchObject({ success: false, errors: [{ fileName: "a.face", code: "missing-file" }] });
  });
});

test("readers reject an unknown option by its name", async () => {
  const options = { fileName: "a.stl", weld: 1e-6 };
  for (const read of [readSurface, readMesh, readVolume]) {
    expect(await read(new Uint8Array(9), options)).toMatchObject({
      success: false,
      errors: [{ code: "invalid-argument", message: 'unknown option "weld"' }],
    });
  }
});

test("writeMesh rejects an unknown option by its name", async () => {
  const options = { signal: undefined, onProgres: () => undefined };
  const refused = await writeMesh(block, "a.su2", options).catch((failure: unknown) => failure);
  expect(refused).toMatchObject({
    data: { diagnostics: [{ code: "invalid-argument", message: 'Unknown option "onProgres"' }] },
  });
});

test("a surface without nodes is reported as empty, not as too small to weld", async () => {
  const nothing = { points: new Float64Array(), triangles: new Uint32Array() };
  const outcome = await mesher.repairSurface(nothing, { weld: 0.1 }).then(
    (repair) => JSON.stringify(repair),
    (failure: unknown) => JSON.stringify((failure as MesherError).data),
  );
  expect(outcome).toMatch(/empty-model/);
  expect(outcome).not.toMatch(/Infinity/);
});

test("a surface with all nodes at the origin is reported as such", async () => {
  const { report } = await mesher.fillSurface({ ...surface, points: surface.points.map(() => 0) });
  expect(report.diagnostics[0]).toMatchObject({
    code: "not-finite",
    message: "All points lie at the origin",
  });
});
