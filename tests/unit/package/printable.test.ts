/** What files and callers call things may hold any character: messages show those that terminals obey as escapes. */
import {
  createMesher,
  MesherError,
  parseProject,
  readMesh,
  readProject,
  writeMesh,
  writeProject,
  type ReadResult,
} from "tetrafront";
import { expect, test } from "vitest";

import { blockMesh } from "../../support/block-mesh.js";
import { cubeProject } from "../../support/projects.js";
import { boxSurface } from "../../support/surfaces.js";
import { stlText } from "../../support/surface-files.js";
import { temporaryFolder } from "../../support/temporary-folder.js";

/** Clears a screen in two ways, turns what follows around, rings, and ends a line. Readers take some of it for blanks. */
const NASTY = "x\u009b2J\u202ey\u001b[2J\u0007\r";
const UNREADABLE = /[\p{Cc}\u202e]/u;

const { run, save } = temporaryFolder();
const bytesOf = (text: string) => new TextEncoder().encode(text);

function expectReadable(text: string): void {
  expect(text).not.toMatch(UNREADABLE);
  expect(text).toContain("\\u009b");
}

function messagesOf(read: ReadResult<unknown>): readonly string[] {
  if (read.success) throw new Error("it was read");
  return read.errors.map(({ message }) => message);
}

test.each([
  ["a.off", `OFF\n3 1 0\n0 0 ${NASTY}\n`],
  ["a.obj", `v 0 0 ${NASTY}\n`],
  ["a.ply", `ply\nformat ${NASTY} 1.0\nend_header\n`],
  ["a.stl", new TextDecoder().decode(stlText(boxSurface(1))).replace("vertex", NASTY)],
  ["a.mesh", `MeshVersionFormatted 2\nDimension 3\nVertices\n1\n0 0 ${NASTY} 0\n`],
  ["a.msh", `$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n${NASTY}\n`],
  ["a.msh", `$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n1\n1 0 0 ${NASTY}\n`],
  ["a.vtk", `# vtk DataFile Version 3.0\nx\nASCII\nDATASET ${NASTY}\n`],
  ["a.node", `1 3 0 0\n1 0 0 ${NASTY}\n`],
])("%s: a word that does not belong there", async (fileName, text) => {
  const openOther = () => Promise.resolve(bytesOf("1 4 0\n1 1 2 3 4\n"));
  for (const message of messagesOf(await readMesh(bytesOf(text), { fileName, openOther }))) {
    expectReadable(message);
  }
});

test("a name of a file, a key and a value in a project, and text that is none", async () => {
  const [named = ""] = messagesOf(await readMesh(new Uint8Array(9), { fileName: `a.${NASTY}` }));
  expectReadable(named);
  const cube = cubeProject();
  for (const wrong of [
    { ...cube, [NASTY]: 1 },
    { ...cube, points: NASTY },
  ]) {
    messagesOf(parseProject(wrong)).forEach(expectReadable);
  }
  expect(messagesOf(readProject(NASTY))[0]).not.toMatch(UNREADABLE);
});

test("a name that a diagnostic, a note or an error tells", async () => {
  const cube = cubeProject();
  const mesher = await createMesher();
  try {
    const lines = cube.lines.map((line) => ({ ...line, name: NASTY }));
    const patches = cube.patches.slice(1);
    const { diagnostics } = await mesher.previewProject({ ...cube, lines, patches });
    const told = diagnostics.filter(({ code }) => code === "open-edge").map(({ message }) => message);
    expect(told.length).toBeGreaterThan(0);
    told.forEach(expectReadable);
    const refused = await mesher
      .fillSurface(boxSurface(1), { [NASTY]: 1 } as object)
      .then(({ report }) => report.diagnostics[0]?.message ?? "");
    expectReadable(refused);
  } finally {
    mesher.dispose();
  }
  const block = blockMesh();
  const groups = block.patches.map((patch) => ({ ...patch, name: NASTY }));
  const files = await writeMesh({ ...block, patches: groups }, "a.su2");
  const notes = files.flatMap((file) => file.notes.map(({ message }) => message));
  for (const note of notes) expect(note).not.toMatch(UNREADABLE);
  const failure: unknown = await writeMesh(block, `a.${NASTY}`).catch((reason: unknown) => reason);
  if (!(failure instanceof MesherError)) throw new Error("it was written");
  expectReadable(failure.message);
});

test("names that the command line tells", async () => {
  save("cube.json", writeProject({ ...cubeProject(), name: NASTY }));
  const { code, stdout } = await run("info", "cube.json");
  expect(code).toBe(0);
  stdout
    .trimEnd()
    .split("\n")
    .forEach((line) => expect(line).not.toMatch(UNREADABLE));
  expect(stdout).toContain("\\u009b2J\\u202ey\\u001b[2J\\u0007\\u000d");
  save("bad.obj", `v 0 0 ${NASTY}\n`);
  const { stderr } = await run("check", "bad.obj");
  stderr
    .trimEnd()
    .split("\n")
    .forEach((line) => expect(line).not.toMatch(UNREADABLE));
});
