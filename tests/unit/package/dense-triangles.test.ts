/** Surfaces without topology that have very different sizes, or many nodes at one place, are read and checked in seconds. */
import { createMesher, readSurface, type Mesh, type SurfaceInput } from "tetrafront";
import { expect, test } from "vitest";

import { randomSource } from "../../support/random.js";
import { stlBinary } from "../../support/surface-files.js";

const processorMs = () => process.cpuUsage().user / 1000;

/** They took minutes, or half a minute. */
const LIMIT = 10_000;

/** Loose triangles with corners of their own. */
function loose(corners: readonly (readonly [number, number, number])[]): SurfaceInput {
  return { points: Float64Array.from(corners.flat()), triangles: Uint32Array.from(corners.keys()) };
}

type Corners = [number, number, number][];

/** Triangles of a size at random places in a cube around the origin. */
function scattered(count: number, size: number, extent: number): Corners {
  const source = randomSource(7);
  const random = () => source() / 2 ** 32;
  return Array.from({ length: count }, () => {
    const [x, y, z] = [0, 0, 0].map(() => extent * (random() - 0.5)) as [number, number, number];
    return Array.from({ length: 3 }, (): [number, number, number] => [
      x + size * random(),
      y + size * random(),
      z + size * random(),
    ]);
  }).flat();
}

const triangleAt = (x: number, size: number): Corners => [
  [x, 0, 0],
  [x + size, 0, 0],
  [x, size, 0],
];

async function surfaceIn(surface: SurfaceInput): Promise<Mesh> {
  const read = await readSurface(stlBinary(surface), { fileName: "a.stl" });
  if (!read.success) throw new Error(read.errors[0].message);
  return read.value;
}

test("a scan with one triangle far away is read in seconds", async () => {
  const begin = processorMs();
  const read = await surfaceIn(loose([...scattered(10_000, 0.1, 10), ...triangleAt(1e7, 1)]));
  expect(processorMs() - begin).toBeLessThan(LIMIT);
  expect(read.triangles).toHaveLength(30_003);
});

test("heaps of triangles within rounding are read in seconds", async () => {
  const spots = Array.from({ length: 16 }, (_, spot) =>
    scattered(85, 1e-7, 1e-7).map(([x, y, z]): [number, number, number] => [x + spot * 1e-5, y, z]),
  );
  const begin = processorMs();
  await surfaceIn(loose([...spots.flat(), ...triangleAt(1, 1)]));
  expect(processorMs() - begin).toBeLessThan(LIMIT);
});

test("a cluster of small triangles beside a large one is checked in seconds", async () => {
  const mesher = await createMesher();
  try {
    const surface = loose([...scattered(16_000, 1e-5, 5e-3), ...triangleAt(1, 1)]);
    const begin = processorMs();
    await mesher.inspectSurface(surface);
    expect(processorMs() - begin).toBeLessThan(LIMIT);
  } finally {
    mesher.dispose();
  }
});
