/** Reading can be cancelled at any time, also while it waits for bytes; truncated files are reported. */
import vm from "node:vm";

import { createMesher, readSurface } from "tetrafront";
import { describe, expect, test } from "vitest";

import { stlBinary, stlText } from "../../support/surface-files.js";
import { boxSurface } from "../../support/surfaces.js";

const bytesOf = (text: string) => new TextEncoder().encode(text);
const NODES = bytesOf("4 3 0 0\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n");
const FACES = bytesOf("1 0\n1 1 2 3\n");
const box = boxSurface(1);
const never = () => new Promise<never>(() => undefined);

/**
 * Returns a stream that delivers some bytes and then hangs, and a function that returns whether it was cancelled.
 */
function hanging(begin: Uint8Array): { stream: ReadableStream<Uint8Array>; isCancelled: () => boolean } {
  let isCancelled = false;
  const stream = new ReadableStream<Uint8Array>({
    start: (controller) => controller.enqueue(begin),
    pull: never,
    cancel: () => {
      isCancelled = true;
    },
  });
  return { stream, isCancelled: () => isCancelled };
}

test("readSurface yields and can be cancelled between polygons that take long", async () => {
  const count = 2000;
  const polygon = Array.from({ length: count }, (_, i) => {
    const [angle, radius] = [(2 * Math.PI * i) / count, i % 2 === 0 ? 1 : 0.9];
    return `v ${radius * Math.cos(angle)} ${radius * Math.sin(angle)} 0\n`;
  });
  const face = `f ${polygon.map((_, i) => i + 1).join(" ")}\n`;
  const file = bytesOf(polygon.join("") + face.repeat(80));
  let ticks = 0;
  const timer = setInterval(() => ticks++, 1);
  const read = await readSurface(file, { fileName: "a.obj" });
  clearInterval(timer);
  expect(read.success && read.value.triangles.length).toBe(3 * 80 * (count - 2));
  expect(ticks).toBeGreaterThan(5);
  const stop = new AbortController();
  setTimeout(() => stop.abort(), 1);
  await expect(readSurface(file, { fileName: "a.obj", signal: stop.signal })).rejects.toMatchObject({
    code: "cancelled",
  });
});

describe("reading can be cancelled while it waits for bytes", () => {
  const reason = new Error("enough");
  const cancelled = { code: "cancelled", cause: reason };
  const stopping = () => {
    const stop = new AbortController();
    setTimeout(() => stop.abort(reason), 20);
    return stop.signal;
  };

  test("of a stream, which is cancelled too", async () => {
    const { stream, isCancelled } = hanging(bytesOf("solid a\n"));
    await expect(readSurface(stream, { fileName: "a.stl", signal: stopping() })).rejects.toMatchObject(
      cancelled,
    );
    expect(isCancelled()).toBe(true);
  });

  test("of an iterable", async () => {
    async function* pieces() {
      yield bytesOf("solid a\n");
      yield await never();
    }
    await expect(readSurface(pieces(), { fileName: "a.stl", signal: stopping() })).rejects.toMatchObject(
      cancelled,
    );
  });

  test("of a second file, both while that file is opened and while it is read", async () => {
    const { stream, isCancelled } = hanging(NODES.subarray(0, 12));
    for (const openOther of [never, () => Promise.resolve(stream)]) {
      const options = { fileName: "a.face", openOther, signal: stopping() };
      await expect(readSurface(FACES, options)).rejects.toMatchObject(cancelled);
    }
    expect(isCancelled()).toBe(true);
  });
});

test("progress counts the bytes of all files", async () => {
  const seen: number[] = [];
  const openOther = () => Promise.resolve(NODES);
  await readSurface(FACES, { fileName: "a.face", openOther, onProgress: (bytes) => seen.push(bytes) });
  expect(seen.at(-1)).toBe(NODES.length + FACES.length);
});

test("arrays of another realm are accepted", async () => {
  const other = (type: string, values: ArrayLike<number>) =>
    vm.runInNewContext(`new ${type}(values)`, { values: [...Array.from(values)] }) as never;
  for (const source of [
    other("Uint8Array", stlBinary(box)),
    (other("Uint8Array", stlBinary(box)) as Uint8Array<ArrayBuffer>).buffer,
  ]) {
    expect((await readSurface(source, { fileName: "a.stl" })).success).toBe(true);
  }
  const mesher = await createMesher();
  const points = other("Float64Array", box.points);
  const triangles = other("Uint32Array", box.triangles);
  expect((await mesher.fillSurface({ points, triangles }, { size: 1 })).report.status).toBe("done");
  mesher.dispose();
});

test("a text STL file without its last line is read if its triangles are closed", async () => {
  const text = new TextDecoder().decode(stlText(box));
  const withoutEnd = text.slice(0, text.lastIndexOf("endsolid"));
  const read = await readSurface(bytesOf(withoutEnd), { fileName: "a.stl" });
  expect(read.success && read.value.triangles.length).toBe(box.triangles.length);
  expect(read.success && read.value.notes).toEqual([
    'the file ends without "endsolid", but its surface is closed',
  ]);
  const facets = withoutEnd.slice(0, withoutEnd.lastIndexOf("  facet"));
  const cut = await readSurface(bytesOf(facets), { fileName: "a.stl" });
  expect(!cut.success && cut.errors[0].message).toMatch(/truncated/);
});

test("a number with a decimal comma is named", async () => {
  const text = new TextDecoder().decode(stlText(box)).replace("vertex 1 ", "vertex 1,0 ");
  const read = await readSurface(bytesOf(text), { fileName: "a.stl" });
  expect(read.success ? {} : read.errors[0]).toMatchObject({
    message: expect.stringContaining('found "1,0", which has a decimal comma') as string,
    remedy: "Export it with decimal points.",
  });
});

test("a text STL file that ends within its solid is reported as truncated", async () => {
  const facet =
    "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n";
  const whole = await readSurface(bytesOf(`solid a\n${facet}endsolid a\n`), { fileName: "a.stl" });
  expect(whole.success).toBe(true);
  const cut = await readSurface(bytesOf(`solid a\n${facet}`), { fileName: "a.stl" });
  expect(!cut.success && cut.errors[0].message).toMatch(/truncated/);
});

test("a preview names a missing point by its id", async () => {
  const mesher = await createMesher();
  const { diagnostics } = await mesher.previewProject({
    format: "tetrafront-project",
    version: 2,
    name: "",
    points: [{ id: 1, position: [0, 0, 0] }],
    lines: [{ id: 3, type: "straight", points: [1, 99] }],
    patches: [],
    background: { nodes: [], tetrahedra: [] },
  });
  expect(diagnostics.map(({ message }) => message).join()).toMatch(/refers to point 99, which/);
  mesher.dispose();
});
