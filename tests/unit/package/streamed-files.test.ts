/** Files that are written while their bytes are made. */
import { readdirSync, readFileSync, writeFileSync } from "node:fs";
import { setFlagsFromString } from "node:v8";
import { runInNewContext } from "node:vm";

import { FILE_FORMATS, MesherError, streamMesh, writeMesh, type Mesh, type StreamedFile } from "tetrafront";
import { writeMeshFile } from "tetrafront/node";
import { describe, expect, test } from "vitest";

import { fileSpool } from "../../../wasm/src/formats/file-spool.js";
import { memorySpool, type Spool } from "../../../wasm/src/formats/spool.js";
import { blockMesh } from "../../support/block-mesh.js";
import { randomSource } from "../../support/random.js";
import { temporaryFolder } from "../../support/temporary-folder.js";

const folder = temporaryFolder();
const block = blockMesh();

async function joined({ pieces }: StreamedFile): Promise<Buffer> {
  const all: Uint8Array[] = [];
  for await (const piece of pieces) all.push(piece.slice());
  return Buffer.concat(all);
}

const writable = FILE_FORMATS.filter((format) => format.writable.length > 0);

test.each(writable.map(({ extensions }) => extensions[0]))(
  "%s: the pieces of a stream, the file on disk and that of the command line have the same bytes",
  async (extension) => {
    const whole = await writeMesh(block, `a${extension}`);
    const { files, notes } = await streamMesh(block, `a${extension}`);
    const onDisk = await writeMeshFile(block, folder.inFolder(`a${extension}`));
    expect(files.map(({ fileName }) => fileName)).toEqual(whole.map(({ fileName }) => fileName));
    for (const [f, { fileName, bytes }] of whole.entries()) {
      const file = files[f];
      expect(file && (await joined(file)).equals(bytes), fileName).toBe(true);
      expect(readFileSync(folder.inFolder(fileName)).equals(bytes), fileName).toBe(true);
    }
    expect(notes).toEqual(whole[0]?.notes);
    expect(onDisk.map((file) => file.notes)).toEqual(whole.map((file) => file.notes));
    // No temporary file is left.
    expect(readdirSync(folder.path).sort()).toEqual(whole.map(({ fileName }) => fileName).sort());
  },
);

test.each([".vtu", ".msh"])("the command line writes %s as the package does", async (extension) => {
  await writeMeshFile(block, folder.inFolder("block.msh2"));
  const { code } = await folder.run("convert", "block.msh2", "-o", `out${extension}`);
  expect(code).toBe(0);
  const { stdout } = await folder.run("info", `out${extension}`, "--json");
  expect(JSON.parse(stdout)).toMatchObject({ tetrahedra: block.tetrahedra.length / 4 });
  expect(readdirSync(folder.path).sort()).toEqual(["block.msh2", `out${extension}`]);
});

describe("a mesh of 162,000 tetrahedra", () => {
  const large = blockMesh(30);

  /** Frees what is not used. Array buffers are freed beside, and a collection begins only when those of the one before are. */
  function collect(): void {
    setFlagsFromString("--expose-gc");
    const collectOnce = runInNewContext("gc") as () => void;
    collectOnce();
    collectOnce();
  }

  /** Largest number of bytes in arrays beyond those of the mesh while it is written, and the bytes of the file. */
  async function memoryFor(extension: string, mesh: Mesh): Promise<{ most: number; bytes: number }> {
    const { files } = await streamMesh(mesh, `a${extension}`);
    collect();
    const before = process.memoryUsage().arrayBuffers;
    let [most, bytes, next] = [0, 0, 0];
    for (const { pieces } of files) {
      for await (const piece of pieces) {
        expect(piece.length).toBeLessThanOrEqual(1 << 20);
        bytes += piece.length;
        if (bytes < next) continue;
        next = bytes + (1 << 19);
        collect();
        most = Math.max(most, process.memoryUsage().arrayBuffers - before);
      }
    }
    return { most, bytes };
  }

  test.each([".msh", ".mesh", ".vtk", ".inp"])(
    "%s: a few pieces are in memory, not the file",
    async (extension) => {
      const { most, bytes } = await memoryFor(extension, large);
      expect(bytes).toBeGreaterThan(4e6);
      expect(most).toBeLessThan(bytes / 4);
    },
  );

  test("VTU: the compressed arrays are in memory, a quarter of the arrays they are made of", async () => {
    const { most, bytes } = await memoryFor(".vtu", large);
    expect(most).toBeLessThan(1.2 * bytes);
  });

  test("a cancelled file leaves the one that was there", async () => {
    writeFileSync(folder.inFolder("a.vtu"), "before");
    const control = new AbortController();
    const onProgress = () => control.abort();
    const writing = writeMeshFile(large, folder.inFolder("a.vtu"), { signal: control.signal, onProgress });
    await expect(writing).rejects.toThrow(MesherError);
    expect(readFileSync(folder.inFolder("a.vtu"), "utf8")).toBe("before");
    expect(readdirSync(folder.path)).toEqual(["a.vtu"]);
  });
});

describe.each([
  ["memory", memorySpool],
  ["a file", () => fileSpool(folder.path)],
])("a spool in %s", (_, create: () => Spool) => {
  test("returns the bytes that were added, in portions of any size (seed 4711)", () => {
    const random = randomSource(4711);
    const spool = create();
    const added: Buffer[] = [];
    // More than a spool with a file keeps in memory.
    for (let bytes = 0; bytes < 3e7;) {
      const piece = Buffer.alloc(random() % 2e6, added.length % 251);
      spool.add(piece);
      added.push(piece);
      bytes += piece.length;
    }
    const all = Buffer.concat(added);
    for (let at = 0; at < all.length;) {
      const count = Math.min(all.length - at, random() % 5e6);
      const taken = Buffer.concat([...spool.take(count)]);
      expect(taken.equals(all.subarray(at, at + count)), `${count} bytes at ${at}`).toBe(true);
      at += count;
    }
    spool.close();
    expect(readdirSync(folder.path)).toEqual([]);
  });
});
