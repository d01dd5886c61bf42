/** Files read in pieces, patches kept by a repair, and decimals parsed without strings. */
import { readFileSync } from "node:fs";
import { fileURLToPath } from "node:url";
import { Worker } from "node:worker_threads";

import {
  createMesher,
  FILE_FORMATS,
  readMesh,
  readSurface,
  writeMesh,
  type Mesh,
  type ReadResult,
  type SurfaceInput,
} from "tetrafront";
import { describe, expect, test } from "vitest";

import { blockMesh } from "../../support/block-mesh.js";
import { randomSource } from "../../support/random.js";
import { stlBinary, stlText } from "../../support/surface-files.js";
import { boxSurface, sphereSurface } from "../../support/surfaces.js";

const mesh = blockMesh();

function* pieces(bytes: Uint8Array, length: number): Generator<Uint8Array> {
  for (let at = 0; at < bytes.length; at += length) yield bytes.subarray(at, at + length);
}

function valueOf<T>(read: ReadResult<T>): T {
  if (!read.success) throw new Error(read.errors[0].message);
  return read.value;
}

const readable = FILE_FORMATS.filter(({ readable, writable }) => readable.length > 0 && writable.length > 0);

describe.each(readable.map(({ extensions }) => extensions[0]))("a %s file", (extension) => {
  test.each([1, 7, 4096])("read in pieces of %i bytes equals the file read at once", async (length) => {
    const written = new Map(
      (await writeMesh(mesh, `a${extension}`)).map((file) => [file.fileName, file.bytes]),
    );
    const read = async (cut: (bytes: Uint8Array) => Uint8Array | Iterable<Uint8Array>): Promise<Mesh> => {
      const openOther = (name: string) => {
        const other = written.get(name);
        return Promise.resolve(other && cut(other));
      };
      const file = written.get(`a${extension}`) ?? new Uint8Array();
      return valueOf(await readMesh(cut(file), { fileName: `a${extension}`, openOther }));
    };
    expect(await read((bytes) => pieces(bytes, length))).toEqual(await read((bytes) => bytes));
  });
});

describe("a source of bytes", () => {
  const file = stlText(sphereSurface(4));
  const whole = async () => valueOf(await readSurface(file, { fileName: "a.stl" }));

  test("can be a Blob of another realm, which is not an instance of this realm's Blob", async () => {
    const blob = new Blob([file.slice()]);
    const foreign = { size: blob.size, type: "", stream: () => blob.stream() };
    expect(valueOf(await readSurface(foreign as unknown as Blob, { fileName: "a.stl" }))).toEqual(
      await whole(),
    );
  });

  test("can be an ArrayBuffer, a Blob, a web stream or an async iterator", async () => {
    const blob = new Blob([file.slice()]);
    async function* slow(): AsyncGenerator<Uint8Array> {
      for (const piece of pieces(file, 5000)) {
        await new Promise((resolve) => setTimeout(resolve));
        yield piece;
      }
    }
    for (const source of [file.slice().buffer, blob, blob.stream(), slow()]) {
      expect(valueOf(await readSurface(source, { fileName: "a.stl" }))).toEqual(await whole());
    }
  });

  test("is cancelled if the file is rejected", async () => {
    let isCancelled = false;
    const stream = new ReadableStream<Uint8Array>({
      pull: (controller) => controller.enqueue(new TextEncoder().encode("solid a\nthis is none\n")),
      cancel: () => {
        isCancelled = true;
      },
    });
    const read = await readSurface(stream, { fileName: "a.stl" });
    expect([read.success, isCancelled]).toEqual([false, true]);
  });

  test("reports progress and can be cancelled", async () => {
    const progress: number[] = [];
    const stop = new AbortController();
    await readSurface(pieces(file, 10_000), {
      fileName: "a.stl",
      onProgress: (bytes) => progress.push(bytes),
    });
    expect(progress.at(-1)).toBe(file.length);
    expect(progress).toEqual(progress.toSorted((a, b) => a - b));
    const reading = readSurface(pieces(file, 1000), {
      fileName: "a.stl",
      signal: stop.signal,
      onProgress: () => stop.abort(new Error("enough")),
    });
    await expect(reading).rejects.toMatchObject({ code: "cancelled", cause: { message: "enough" } });
  });

  test("rejects with its own error if it fails", async () => {
    async function* broken(): AsyncGenerator<Uint8Array> {
      yield await Promise.resolve(file.subarray(0, 100));
      throw new Error("the wire is cut");
    }
    await expect(readSurface(broken(), { fileName: "a.stl" })).rejects.toThrow("the wire is cut");
  });

  test("of 100 MB is never held in memory as a whole and leaves time for other tasks", async () => {
    // 2 000 000 triangles over the same four nodes: memory grows only with the stored arrays.
    const count = 2_000_000;
    const header = new Uint8Array(84);
    new DataView(header.buffer).setUint32(80, count, true);
    const block = stlBinary(boxSurface(1)).subarray(84, 84 + 50 * 4);
    const piece = new Uint8Array(200 * 1000);
    for (let at = 0; at < piece.length; at += 200) piece.set(block, at);
    function* big(): Generator<Uint8Array> {
      yield header;
      for (let sent = 0; sent < count * 50; sent += piece.length) yield piece;
    }
    let ticks = 0;
    const timer = setInterval(() => ticks++, 1);
    const { arrayBuffers: before } = process.memoryUsage();
    let peak = 0;
    const read = await readSurface(big(), {
      fileName: "a.stl",
      onProgress: () => (peak = Math.max(peak, process.memoryUsage().arrayBuffers - before)),
    });
    clearInterval(timer);
    expect(valueOf(read).triangles.length / 3).toBe(count);
    expect(ticks).toBeGreaterThan(10);
    // Three nodes and a patch per triangle, and the same amount again for uncollected garbage.
    expect(peak).toBeLessThan(2 * 16 * count);
  });

  test("can be read in a worker", async () => {
    const entry = new URL("../../../wasm/dist/index.js", import.meta.url).href;
    const code = `import("${entry}").then(async ({ readSurface }) => {
      const { parentPort, workerData } = await import("node:worker_threads");
      const read = await readSurface(new Blob([workerData]).stream(), { fileName: "a.stl" });
      parentPort.postMessage(read);
    });`;
    const worker = new Worker(code, { eval: true, workerData: file });
    const read = await new Promise<ReadResult<Mesh>>((resolve, reject) => {
      worker.once("message", resolve).once("error", reject);
    });
    await worker.terminate();
    expect(valueOf(read)).toEqual(await whole());
  });
});

/** Gives each corner of each triangle its own node, moved by less than `shift` along each axis. */
function separatedCorners(surface: SurfaceInput, shift: number): SurfaceInput {
  const random = randomSource(7);
  const corners = Array.from(surface.triangles, (node) => [
    ...surface.points.subarray(3 * node, 3 * node + 3),
  ]);
  return {
    points: Float64Array.from(corners.flat(), (value) => value + shift * (random() / 2 ** 31 - 1)),
    triangles: Uint32Array.from(corners, (_, i) => i),
  };
}

test("repairSurface welds nodes separated by rounding if asked to, and the surface keeps its patches", async () => {
  const whole = sphereSurface(6);
  const { points, triangles } = separatedCorners(whole, 1e-7);
  const hole = 3 * 5;
  const given = {
    points,
    triangles: Uint32Array.from([...triangles.subarray(0, hole), ...triangles.subarray(hole + 3)]),
    trianglePatch: Uint32Array.from({ length: triangles.length / 3 - 1 }, (_, t) => t % 3),
    patches: [4, 9, 2].map((tag) => ({ name: `patch ${tag}`, tag })),
  };
  const mesher = await createMesher();
  try {
    const repair = await mesher.repairSurface(given, { weld: 1e-6, fillHoles: 3, orient: false });
    const { trianglePatch, patches, ...closed } = repair.mesh;
    expect((await mesher.inspectSurface(closed)).isFillable).toBe(true);
    expect(closed.points.length).toBe(whole.points.length);
    expect([...trianglePatch]).toEqual([...given.trianglePatch, 3]);
    expect(patches).toEqual([...given.patches, { name: "filled holes", tag: 10 }]);
  } finally {
    mesher.dispose();
  }
});

test("a skipped section can end at any position relative to the buffer", async () => {
  const square =
    "$Nodes\n3\n1 0 0 0\n2 1 0 0\n3 0 1 0\n$EndNodes\n$Elements\n1\n1 2 2 5 1 1 2 3\n$EndElements\n";
  const begin = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Comments\n";
  const end = "\n$EndComments";
  const piece = 1 << 20;
  for (let beyond = -end.length; beyond <= 3; beyond++) {
    const comment = "c".repeat(piece + beyond - begin.length - end.length);
    const file = new TextEncoder().encode(`${begin}${comment}${end}\n${square}`);
    const read = await readMesh(pieces(file, piece), { fileName: "a.msh" });
    expect(valueOf(read).triangles, `${beyond}`).toHaveLength(3);
  }
});

test("a face longer than the read buffer is rejected with that reason", async () => {
  const header = `ply\nformat binary_little_endian 1.0\nelement vertex 9\nproperty float x\nproperty float y
property float z\nelement face 1\nproperty list uint int vertex_indices\nend_header\n`;
  const body = new Uint8Array(9 * 12 + 4 + 4 * 400_000);
  new DataView(body.buffer).setUint32(9 * 12, 400_000, true);
  const file = new Uint8Array([...new TextEncoder().encode(header), ...body]);
  const read = await readMesh(pieces(file, 1 << 16), { fileName: "a.ply" });
  expect(read.success ? "" : read.errors[0].message).toMatch(/an entry is longer than/);
});

test("decimals of every length are parsed exactly as JavaScript does", async () => {
  const random = randomSource(11);
  const digits = (count: number) => Array.from({ length: count }, () => random() % 10).join("");
  const words: string[] = [
    "0",
    "-0",
    ".5",
    "5.",
    "1e5",
    "1E-5",
    "+3",
    "123456789012345678",
    "0.000001",
    "1e22",
    "1e23",
  ];
  while (words.length < 3000) {
    const sign = ["", "-", "+"][random() % 3] ?? "";
    const point = random() % 3 === 0 ? "" : `.${digits(random() % 20)}`;
    const exponent = random() % 3 === 0 ? `e${["", "-", "+"][random() % 3]}${random() % 120}` : "";
    words.push(`${sign}${digits(1 + (random() % 18))}${point}${exponent}`);
  }
  while (words.length % 3 !== 0) words.push("1");
  const file = `OFF\n${words.length / 3} 0 0\n${words.join(" ")}\n`;
  const read = valueOf(await readMesh(new TextEncoder().encode(file), { fileName: "a.off" }));
  expect([...read.points]).toEqual(words.map(Number));
});

test.each(["0x10", "1e", "e5", "--1", "1.2.3", "1_0", "Infinity", "NaN", ".", "1e5.5"])(
  "%s is rejected as a coordinate",
  async (word) => {
    const file = `OFF\n1 0 0\n0 0 ${word}\n`;
    const read = await readMesh(new TextEncoder().encode(file), { fileName: "a.off" });
    expect(read.success ? "" : read.errors[0].message).toMatch(
      /which is not a (finite )?number|expected a finite number/,
    );
  },
);

test("TetGen: facets keep their markers, and the nodes are read from the .node file", async () => {
  const node = "# points\n4 3 0 0\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n";
  const smesh = "0 3 0 0\n4 1\n3 1 3 2 7\n3 1 2 4 8\n3 1 4 3 9\n3 2 3 4 7\n0\n0\n";
  const openOther = (name: string) =>
    Promise.resolve(name === "a.node" ? new TextEncoder().encode(node) : undefined);
  const read = valueOf(
    await readSurface(new TextEncoder().encode(smesh), { fileName: "a.smesh", openOther }),
  );
  expect([...read.triangles]).toEqual([0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3]);
  expect([...read.trianglePatch].map((patch) => read.patches[patch]?.tag)).toEqual([7, 8, 9, 7]);
  const alone = await readSurface(new TextEncoder().encode(smesh), { fileName: "a.smesh" });
  expect(alone.success ? "" : alone.errors[0]).toMatchObject({
    message: expect.stringMatching(/another file, a\.node/) as string,
  });
});

describe("a large mesh", () => {
  const random = randomSource(7);
  /** A fan of needles with more rows than fit into one piece of text. */
  const count = 40_000;
  const large: Mesh = {
    ...mesh,
    points: Float64Array.from({ length: 3 * count }, () => random() - 0.5),
    triangles: Uint32Array.from({ length: 3 * (count - 2) }, (_, h) =>
      h % 3 === 0 ? 0 : Math.floor(h / 3) + (h % 3),
    ),
    trianglePatch: new Uint32Array(count - 2),
    tetrahedra: new Uint32Array(),
    tetrahedronRegion: new Uint32Array(),
  };

  test.each([".vtk", ".vtu", ".mesh"])(
    "is written as %s while other tasks run, and writing can be cancelled",
    async (extension) => {
      const progress: number[] = [];
      let ticks = 0;
      const timer = setInterval(() => ticks++);
      const [file] = await writeMesh(large, `a${extension}`, {
        onProgress: ({ bytes }) => progress.push(bytes),
      });
      clearInterval(timer);
      expect(ticks).toBeGreaterThan(0);
      expect(progress).toEqual(progress.toSorted((a, b) => a - b));
      expect(progress.at(-1)).toBe(file?.bytes.length);
      const read = valueOf(await readMesh(file?.bytes ?? new Uint8Array(), { fileName: `a${extension}` }));
      expect(read.points).toEqual(large.points);
      expect(read.triangles).toEqual(large.triangles);

      const stop = new AbortController();
      const reason = new Error("enough");
      const cancelled = { code: "cancelled", cause: reason };
      let calls = 0;
      const onProgress = () => {
        calls++;
        stop.abort(reason);
      };
      await expect(
        writeMesh(large, `a${extension}`, { signal: stop.signal, onProgress }),
      ).rejects.toMatchObject(cancelled);
      expect(calls).toBe(1);
      await expect(writeMesh(mesh, `a${extension}`, { signal: stop.signal })).rejects.toMatchObject(
        cancelled,
      );
    },
  );
});

test("docs/FORMAT.md mentions every extension", () => {
  const readme = readFileSync(fileURLToPath(new URL("../../../docs/FORMAT.md", import.meta.url)), "utf8");
  for (const { extensions } of FILE_FORMATS) {
    for (const extension of extensions) expect(readme, extension).toContain(`\`${extension}\``);
  }
});
