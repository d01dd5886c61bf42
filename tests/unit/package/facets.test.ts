/** Facets of TetGen's files: polygons within polygons, holes, and what marks spaces. */
import { createMesher, readSurface, type Mesher, type SurfaceFile } from "tetrafront";
import { afterAll, beforeAll, describe, expect, test } from "vitest";

import { enclosedVolume } from "../../support/check-mesh.js";

let mesher: Mesher;
beforeAll(async () => {
  mesher = await createMesher();
});
afterAll(() => mesher.dispose());

type Place = readonly [number, number, number];

interface Facet {
  readonly rings: readonly (readonly number[])[];
  readonly holes?: readonly Place[];
}

/** A `.poly`, with corners counted from 0. */
function polyFile(places: readonly Place[], facets: readonly Facet[], marks = "0\n0\n"): Uint8Array {
  const rows = facets.flatMap(({ rings, holes = [] }) => [
    `${rings.length} ${holes.length} 1`,
    ...rings.map((ring) => `${ring.length} ${ring.join(" ")}`),
    ...holes.map((hole, h) => `${h + 1} ${hole.join(" ")}`),
  ]);
  const nodes = places.map((place, n) => `${n} ${place.join(" ")}`);
  return new TextEncoder().encode(
    [`${places.length} 3 0 0`, ...nodes, `${facets.length} 1`, ...rows, marks].join("\n"),
  );
}

async function surfaceOf(file: Uint8Array): Promise<SurfaceFile> {
  const read = await readSurface(file, { fileName: "a.poly" });
  if (!read.success) throw new Error(`${read.errors[0].message}. ${read.errors[0].remedy}`);
  return read.value;
}

/** Corners of boxes one after another: x fastest, then y, then z. */
function boxes(...given: readonly (readonly [low: Place, high: Place])[]): Place[] {
  return given.flatMap(([low, high]) =>
    Array.from({ length: 8 }, (_, i): Place => [
      (i & 1 ? high : low)[0],
      (i & 2 ? high : low)[1],
      (i & 4 ? high : low)[2],
    ]),
  );
}

const BOTTOM = [0, 2, 3, 1];
const TOP = [4, 5, 7, 6];
const SIDES = [
  [0, 1, 5, 4],
  [1, 3, 7, 5],
  [3, 2, 6, 7],
  [2, 0, 4, 6],
];
const shifted = (ring: readonly number[], box: number) => ring.map((corner) => corner + 8 * box);

/** Turned in space, so that planes are none of two axes. */
function turned([x, y, z]: Place): Place {
  return [0.36 * x + 0.48 * y - 0.8 * z, -0.8 * x + 0.6 * y, 0.48 * x + 0.64 * y + 0.6 * z];
}

const cube: readonly [Place, Place] = [
  [0, 0, 0],
  [4, 4, 1],
];
const square = (x: number, y: number): readonly [Place, Place] => [
  [x, y, 0],
  [x + 1, y + 1, 1],
];

describe("facets of a .poly", () => {
  const places = boxes(cube, square(0.5, 0.5), square(2.5, 0.5), square(1.5, 2));
  const rings = (ring: readonly number[]) => [ring, ...[1, 2, 3].map((box) => shifted(ring, box))];
  const within = (z: number): Place[] => [
    [1, 1, z],
    [3, 1, z],
    [2, 2.5, z],
  ];
  const walls = [1, 2, 3].flatMap((box) => SIDES.map((ring) => ({ rings: [shifted(ring, box)] })));
  const outside = SIDES.map((ring) => ({ rings: [ring] }));

  test.each([
    ["", (place: Place) => place],
    [", turned in space", turned],
  ])("leave out what is marked: three tubes through a plate%s", async (_, move) => {
    const caps = [
      { rings: rings(BOTTOM), holes: within(0).map(move) },
      { rings: rings(TOP), holes: within(1).map(move) },
    ];
    const surface = await surfaceOf(polyFile(places.map(move), [...caps, ...outside, ...walls]));
    const { surface: oriented } = await mesher.repairSurface(surface);
    const found = await mesher.inspectSurface(oriented);
    expect(found).toMatchObject({ isFillable: true, regions: 1, cavities: 0 });
    // 16 of the plate without the tubes, and the tubes' edges divide what is around them.
    expect(enclosedVolume(oriented)).toBeCloseTo(13, 12);
    expect(found.area).toBeCloseTo(2 * 13 + 16 + 12, 12);
  });

  test("are cut where a ring within another is no hole", async () => {
    const caps = [{ rings: rings(BOTTOM), holes: [] }, { rings: rings(TOP) }];
    const surface = await surfaceOf(polyFile(places, [...caps, ...outside]));
    const found = await mesher.inspectSurface(surface);
    expect(found).toMatchObject({ isFillable: true, regions: 1, nodes: 32 });
    expect(enclosedVolume(surface)).toBeCloseTo(16, 12);
  });

  test("fill an island in a hole", async () => {
    const nested = boxes(
      cube,
      [
        [1, 1, 0],
        [3, 3, 1],
      ],
      square(1.5, 1.5),
    );
    const file = polyFile(nested, [
      { rings: [BOTTOM, shifted(BOTTOM, 1), shifted(BOTTOM, 2)], holes: [[1.2, 1.2, 0]] },
    ]);
    const { area } = await mesher.inspectSurface(await surfaceOf(file));
    expect(area).toBeCloseTo(16 - 4 + 1, 12);
  });

  test("of polygons that cross are refused by number, with what to do", async () => {
    const crossing = boxes(cube, square(3.5, 1));
    const file = polyFile(crossing, [{ rings: [BOTTOM, shifted(BOTTOM, 1)], holes: [[3.7, 1.5, 0]] }]);
    await expect(surfaceOf(file)).rejects.toThrow(
      /facet 0 \(counted from 0\) .* intersect or have no area\. Save it as polygons that do not intersect/,
    );
  });
});

test("points that mark holes and regions of the whole are told with what stands for them", async () => {
  const places = boxes(square(0, 0));
  const facets = [BOTTOM, TOP, ...SIDES].map((ring) => ({ rings: [ring] }));
  const { notes } = await surfaceOf(
    polyFile(places, facets, "1\n1 .5 .5 .5\n2\n1 .1 .1 .1 7 0\n2 .2 .2 .2 8 0\n"),
  );
  expect(notes).toMatchObject([
    expect.stringMatching(/^1 hole point ignored: .*leave out the facets/),
    expect.stringMatching(/^2 region points ignored: regions are numbered$/),
  ]);
  expect((await surfaceOf(polyFile(places, facets))).notes).toBeUndefined();
  expect((await surfaceOf(polyFile(places, facets, ""))).notes).toBeUndefined();
});
