/** Files read and written by path in Node. */
import { readFileSync, writeFileSync } from "node:fs";

import { MesherError, writeMesh } from "tetrafront";
import {
  readMeshFile,
  readProjectFile,
  readSurfaceFile,
  readVolumeFile,
  writeMeshFile,
  writeProjectFile,
} from "tetrafront/node";
import { describe, expect, test } from "vitest";

import { blockMesh } from "../../support/block-mesh.js";
import { cubeProject } from "../../support/projects.js";
import { stlBinary } from "../../support/surface-files.js";
import { boxSurface } from "../../support/surfaces.js";
import { temporaryFolder } from "../../support/temporary-folder.js";

const { inFolder } = temporaryFolder();

test("readSurfaceFile reads a surface and reports progress", async () => {
  const bytes = stlBinary(boxSurface(2));
  writeFileSync(inFolder("part.stl"), bytes);
  let read = 0;
  const result = await readSurfaceFile(inFolder("part.stl"), { onProgress: (count) => (read = count) });
  expect(result).toMatchObject({ success: true });
  expect(read).toBe(bytes.length);
});

test.each([".vtu", ".ele", ".msh"])(
  "writeMeshFile writes a mesh as %s with all files of the format, and it can be read again",
  async (extension) => {
    const file = inFolder(`block${extension}`);
    const block = blockMesh();
    const written = await writeMeshFile(block, file);
    const whole = await writeMesh(block, `block${extension}`);
    expect(written.map(({ fileName }) => fileName)).toEqual(whole.map(({ fileName }) => fileName));
    for (const { fileName, bytes } of whole) {
      expect(new Uint8Array(readFileSync(inFolder(fileName)))).toEqual(new Uint8Array(bytes));
    }
    for (const read of [readVolumeFile, readMeshFile]) {
      const result = await read(file);
      if (!result.success) throw new Error(result.errors[0].message);
      expect(result.value.tetrahedra).toHaveLength(block.tetrahedra.length);
    }
  },
);

test("writeProjectFile writes a project that readProjectFile reads again", async () => {
  const project = cubeProject();
  await writeProjectFile(project, inFolder("cube.json"));
  expect(await readProjectFile(inFolder("cube.json"))).toEqual({ success: true, value: project });
});

describe.each([
  ["readSurfaceFile", readSurfaceFile],
  ["readVolumeFile", readVolumeFile],
  ["readMeshFile", readMeshFile],
  ["readProjectFile", readProjectFile],
])("%s", (_, read) => {
  test.each(["missing.vtu", "."])("returns an error for a path without a file: %s", async (name) => {
    const result = await read(inFolder(name));
    if (result.success) throw new Error("read a file that does not exist");
    expect(result.errors[0].code).toBe(
      name === "." && read !== readProjectFile ? "unknown-format" : "unreadable-file",
    );
    expect(result.errors[0].fileName).toBe(inFolder(name));
  });

  test("rejects with a MesherError if the path is not a string", async () => {
    await expect(read(5 as never)).rejects.toThrow(MesherError);
  });
});
