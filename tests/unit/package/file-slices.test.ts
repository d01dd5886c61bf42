/** Long work on files runs in steps; other tasks run and cancelling takes effect between them. */
import { FILE_FORMATS, readMesh, readSurface, readVolume, writeMesh, type Mesh } from "tetrafront";
import { afterEach, describe, expect, test, vi } from "vitest";

import { STEP } from "../../../wasm/src/base/steps.js";
import { piecesIn } from "../../../wasm/src/formats/bytes.js";
import { decodeArray, UnpackingBudget } from "../../../wasm/src/formats/vtk-arrays.js";
import { blockMesh } from "../../support/block-mesh.js";
import { sphereSurface } from "../../support/surfaces.js";

const block = blockMesh(20);
const sphere = sphereSurface(60);
/** A surface without tetrahedra, for surface formats. */
const surface: Mesh = {
  ...block,
  points: sphere.points,
  triangles: sphere.triangles,
  trianglePatch: new Uint32Array(sphere.triangles.length / 3),
  tetrahedra: new Uint32Array(),
  tetrahedronRegion: new Uint32Array(),
};

afterEach(() => vi.restoreAllMocks());

/** Replaces the clock by one on which every step exceeds its time slice. */
function slowClock(): void {
  let now = 0;
  vi.spyOn(performance, "now").mockImplementation(() => (now += 20));
}

const bytesOf = (text: string) => new TextEncoder().encode(text);

/** Returns a VTU file of `count` separate tetrahedra with arrays in the given encoding. */
function vtuOf(count: number, coding: "ascii" | "binary" | "appended"): Uint8Array {
  const points = new Float64Array(12 * count);
  for (let i = 0; i < count; i++) points.set([i, 0, 0, i + 1, 0, 0, i, 1, 0, i, 0, 1], 12 * i);
  const whole = (length: number, at: (i: number) => number) => Float64Array.from({ length }, (_, i) => at(i));
  const appended: string[] = [];
  let offset = 0;
  const array = (name: string, values: Float64Array) => {
    const head = `<DataArray type="Float64" Name="${name}"`;
    if (coding === "ascii") return `${head} format="ascii">${values.join(" ")}</DataArray>`;
    const bytes = Buffer.concat([
      Buffer.from(Uint32Array.of(values.byteLength).buffer),
      Buffer.from(values.buffer),
    ]).toString("base64");
    if (coding === "binary") return `${head} format="binary">${bytes}</DataArray>`;
    appended.push(bytes);
    offset += bytes.length;
    return `${head} format="appended" offset="${offset - bytes.length}"/>`;
  };
  const piece = `<Piece NumberOfPoints="${4 * count}" NumberOfCells="${count}"><Points>${array("p", points)}</Points>
<Cells>${array(
    "connectivity",
    whole(4 * count, (i) => i),
  )}${array(
    "offsets",
    whole(count, (i) => 4 * (i + 1)),
  )}${array(
    "types",
    whole(count, () => 10),
  )}</Cells></Piece>`;
  const data =
    appended.length === 0 ? "" : `<AppendedData encoding="base64">_${appended.join("")}</AppendedData>`;
  return bytesOf(
    `<VTKFile type="UnstructuredGrid" byte_order="LittleEndian"><UnstructuredGrid>${piece}</UnstructuredGrid>${data}</VTKFile>`,
  );
}

describe.each(["ascii", "binary", "appended"] as const)("a VTU file with %s arrays", (coding) => {
  const bytes = vtuOf(20_000, coding);

  test("is read in steps, and can be cancelled between them after all bytes have arrived", async () => {
    slowClock();
    const stop = new AbortController();
    let ticks = 0;
    const onProgress = (bytesRead: number) => {
      // Timers run only if the reader yields.
      if (bytesRead === bytes.length) setTimeout(() => (ticks++, stop.abort("enough")));
    };
    const reading = readVolume(bytes, { fileName: "a.vtu", onProgress, signal: stop.signal });
    await expect(reading).rejects.toMatchObject({ code: "cancelled", cause: "enough" });
    expect(ticks).toBe(1);
  });

  test("is read correctly", async () => {
    const read = await readVolume(bytes, { fileName: "a.vtu" });
    if (!read.success) throw new Error(read.errors[0].message);
    expect(read.value.tetrahedra).toHaveLength(80_000);
    expect(read.value.points.at(-1)).toBe(1);
  });
});

test("an array in one compressed block is inflated in steps", () => {
  const values = Float64Array.from({ length: 1 << 17 }, (_, i) => Math.sin(i));
  return import("fflate").then(({ zlibSync }) => {
    const packed = zlibSync(new Uint8Array(values.buffer));
    const head = Uint32Array.of(1, values.byteLength, 0, packed.length);
    const appended = new Uint8Array(Buffer.concat([new Uint8Array(head.buffer), packed]));
    const work = decodeArray(
      {
        isLittleEndian: true,
        headerBytes: 4,
        isCompressed: true,
        appended,
        isBase64: false,
        nextOffsets: new Map(),
        budget: new UnpackingBudget(appended.length),
        fail: (message) => {
          throw new Error(message);
        },
      },
      { type: "Float64", format: "appended", offset: 0, content: new Uint8Array(), mayBeNone: false },
    );
    let steps = 0;
    let step = work.next();
    for (; step.done !== true; step = work.next()) steps++;
    expect(step.value).toEqual(values);
    // The steps of inflating, then those of decoding the numbers.
    expect(steps).toBeGreaterThan(packed.length / (1 << 14) + values.length / STEP - 1);
  });
});

const WRITABLE = FILE_FORMATS.filter(({ writable }) => writable.length > 0).map(
  (format) => [format.extensions[0], format] as const,
);

describe.each(WRITABLE)("writing a mesh as %s", (extension, format) => {
  const mesh = format.writable.includes("volume") ? block : surface;
  const rows = (mesh.points.length + mesh.triangles.length) / 3 + mesh.tetrahedra.length / 4;

  test("takes about as many steps as its progress expects, each of limited size", async () => {
    const { write, passes = 4 } = await format.load();
    let steps = 0;
    let longest = 0;
    for (const { parts } of write?.(mesh, `a${extension}`, () => undefined) ?? []) {
      for (const piece of piecesIn(parts)) {
        steps++;
        longest = Math.max(longest, piece.length);
      }
    }
    const share = steps / ((passes * rows) / STEP);
    expect(share).toBeGreaterThan(0.6);
    expect(share).toBeLessThan(1.4);
    expect(longest).toBeLessThan(3 << 20);
  });

  test("reports progress from 0 to 1 and can be cancelled at any step", async () => {
    slowClock();
    const fractions: number[] = [];
    const bytes: number[] = [];
    const files = await writeMesh(mesh, `a${extension}`, {
      onProgress: (progress) => {
        fractions.push(progress.fraction);
        bytes.push(progress.bytes);
      },
    });
    expect(fractions).toEqual(fractions.toSorted((a, b) => a - b));
    expect(fractions[0]).toBeLessThan(0.15);
    expect(fractions.at(-2)).toBeGreaterThan(0.6);
    expect(fractions.at(-1)).toBe(1);
    expect(bytes).toEqual(bytes.toSorted((a, b) => a - b));
    expect(bytes.at(-1)).toBe(files.reduce((sum, file) => sum + file.bytes.length, 0));
    for (const at of [1, Math.ceil(fractions.length / 2)]) {
      const stop = new AbortController();
      let calls = 0;
      const onProgress = () => {
        if (++calls === at) stop.abort("enough");
      };
      const writing = writeMesh(mesh, `a${extension}`, { signal: stop.signal, onProgress });
      await expect(writing).rejects.toMatchObject({ code: "cancelled", cause: "enough" });
      expect(calls).toBe(at);
    }
  });
});

test("reading other formats also yields after the last byte has arrived", async () => {
  for (const [extension, read] of [
    [".vtk", readVolume],
    [".ply", readSurface],
    [".msh", readVolume],
  ] as const) {
    const [file] = await writeMesh(extension === ".ply" ? surface : block, `a${extension}`);
    const bytes = file?.bytes ?? new Uint8Array();
    slowClock();
    const stop = new AbortController();
    const onProgress = (bytesRead: number) => {
      if (bytesRead === bytes.length) setTimeout(() => stop.abort("enough"));
    };
    const reading = read(bytes, { fileName: `a${extension}`, onProgress, signal: stop.signal });
    await expect(reading, extension).rejects.toMatchObject({ code: "cancelled" });
    vi.restoreAllMocks();
    expect((await readMesh(bytes, { fileName: `a${extension}` })).success).toBe(true);
  }
});
