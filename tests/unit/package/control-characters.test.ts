/** Names from files and callers can contain any character; messages show control characters as escapes. */
import { createMesher, MesherError, readMesh, writeMesh, type ReadResult } from "tetrafront";
import { parseProject, readProject, writeProject } from "tetrafront/project";
import { expect, test } from "vitest";

import { blockMesh } from "../../support/block-mesh.js";
import { cubeProject } from "../../support/projects.js";
import { boxSurface } from "../../support/surfaces.js";
import { stlText } from "../../support/surface-files.js";
import { temporaryFolder } from "../../support/temporary-folder.js";

/**
 * Clears the screen in two ways, reverses the text after it, rings the bell and ends a line. Readers take
 * some of these characters for whitespace.
 */
const CONTROL_CHARACTERS = "x\u009b2J\u202ey\u001b[2J\u0007\r";
const UNPRINTABLE = /[\p{Cc}\u202e]/u;

const { run, save } = temporaryFolder();
const bytesOf = (text: string) => new TextEncoder().encode(text);

function expectPrintable(text: string): void {
  expect(text).not.toMatch(UNPRINTABLE);
  expect(text).toContain("\\u009b");
}

function messagesOf(read: ReadResult<unknown>): readonly string[] {
  if (read.success) throw new Error("it was read");
  return read.errors.map(({ message }) => message);
}

test.each([
  ["a.off", `OFF\n3 1 0\n0 0 ${CONTROL_CHARACTERS}\n`],
  ["a.obj", `v 0 0 ${CONTROL_CHARACTERS}\n`],
  ["a.ply", `ply\nformat ${CONTROL_CHARACTERS} 1.0\nend_header\n`],
  ["a.stl", new TextDecoder().decode(stlText(boxSurface(1))).replace("vertex", CONTROL_CHARACTERS)],
  ["a.mesh", `MeshVersionFormatted 2\nDimension 3\nVertices\n1\n0 0 ${CONTROL_CHARACTERS} 0\n`],
  ["a.msh", `$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n${CONTROL_CHARACTERS}\n`],
  ["a.msh", `$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n1\n1 0 0 ${CONTROL_CHARACTERS}\n`],
  ["a.vtk", `# vtk DataFile Version 3.0\nx\nASCII\nDATASET ${CONTROL_CHARACTERS}\n`],
  ["a.node", `1 3 0 0\n1 0 0 ${CONTROL_CHARACTERS}\n`],
])("%s: the message about an unexpected word escapes control characters", async (fileName, text) => {
  const openOther = () => Promise.resolve(bytesOf("1 4 0\n1 1 2 3 4\n"));
  for (const message of messagesOf(await readMesh(bytesOf(text), { fileName, openOther }))) {
    expectPrintable(message);
  }
});

test("the name of a file, keys and values of a project, and text that is not JSON are escaped", async () => {
  const [named = ""] = messagesOf(await readMesh(new Uint8Array(9), { fileName: `a.${CONTROL_CHARACTERS}` }));
  expectPrintable(named);
  const cube = cubeProject();
  for (const wrong of [
    { ...cube, [CONTROL_CHARACTERS]: 1 },
    { ...cube, points: CONTROL_CHARACTERS },
  ]) {
    messagesOf(parseProject(wrong)).forEach(expectPrintable);
  }
  expect(messagesOf(readProject(CONTROL_CHARACTERS))[0]).not.toMatch(UNPRINTABLE);
});

test("names in diagnostics, notes and errors are escaped", async () => {
  const cube = cubeProject();
  const mesher = await createMesher();
  try {
    const lines = cube.lines.map((line) => ({ ...line, name: CONTROL_CHARACTERS }));
    const patches = cube.patches.slice(1);
    const { diagnostics } = await mesher.previewProject({ ...cube, lines, patches });
    const messages = diagnostics.filter(({ code }) => code === "open-edge").map(({ message }) => message);
    expect(messages.length).toBeGreaterThan(0);
    messages.forEach(expectPrintable);
    const refused = await mesher
      .fillSurface(boxSurface(1), { [CONTROL_CHARACTERS]: 1 } as object)
      .then(({ report }) => report.diagnostics[0]?.message ?? "");
    expectPrintable(refused);
  } finally {
    mesher.dispose();
  }
  const block = blockMesh();
  const groups = block.patches.map((patch) => ({ ...patch, name: CONTROL_CHARACTERS }));
  const files = await writeMesh({ ...block, patches: groups }, "a.su2");
  const notes = files.flatMap((file) => file.notes.map(({ message }) => message));
  for (const note of notes) expect(note).not.toMatch(UNPRINTABLE);
  const failure: unknown = await writeMesh(block, `a.${CONTROL_CHARACTERS}`).catch(
    (reason: unknown) => reason,
  );
  if (!(failure instanceof MesherError)) throw new Error("it was written");
  expectPrintable(failure.message);
});

test("names printed by the command line are escaped", async () => {
  save("cube.json", writeProject({ ...cubeProject(), name: CONTROL_CHARACTERS }));
  const { code, stdout } = await run("info", "cube.json");
  expect(code).toBe(0);
  stdout
    .trimEnd()
    .split("\n")
    .forEach((line) => expect(line).not.toMatch(UNPRINTABLE));
  expect(stdout).toContain("\\u009b2J\\u202ey\\u001b[2J\\u0007\\u000d");
  save("bad.obj", `v 0 0 ${CONTROL_CHARACTERS}\n`);
  const checked = await run("check", "bad.obj");
  `${checked.stdout}${checked.stderr}`
    .trimEnd()
    .split("\n")
    .forEach((line) => expect(line).not.toMatch(UNPRINTABLE));
});
