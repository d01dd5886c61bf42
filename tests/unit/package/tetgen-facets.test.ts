/** Facets of TetGen files: nested polygons, holes, and the points that mark holes and regions. */
import { createMesher, readSurface, type Mesher, type Mesh } from "tetrafront";
import { afterAll, beforeAll, describe, expect, test } from "vitest";

import { enclosedVolume } from "../../support/check-mesh.js";

let mesher: Mesher;
beforeAll(async () => {
  mesher = await createMesher();
});
afterAll(() => mesher.dispose());

type Position = readonly [number, number, number];

interface Facet {
  readonly rings: readonly (readonly number[])[];
  readonly holes?: readonly Position[];
}

/** Returns a `.poly` file whose nodes are numbered from 0. */
function polyFile(positions: readonly Position[], facets: readonly Facet[], marks = "0\n0\n"): Uint8Array {
  const rows = facets.flatMap(({ rings, holes = [] }) => [
    `${rings.length} ${holes.length} 1`,
    ...rings.map((ring) => `${ring.length} ${ring.join(" ")}`),
    ...holes.map((hole, h) => `${h + 1} ${hole.join(" ")}`),
  ]);
  const nodes = positions.map((position, n) => `${n} ${position.join(" ")}`);
  return new TextEncoder().encode(
    [`${positions.length} 3 0 0`, ...nodes, `${facets.length} 1`, ...rows, marks].join("\n"),
  );
}

async function surfaceOf(file: Uint8Array): Promise<Mesh> {
  const read = await readSurface(file, { fileName: "a.poly" });
  if (!read.success) throw new Error(`${read.errors[0].message}. ${read.errors[0].remedy}`);
  return read.value;
}

/** Returns the corners of each box in turn: x runs fastest, then y, then z. */
function boxes(...given: readonly (readonly [low: Position, high: Position])[]): Position[] {
  return given.flatMap(([low, high]) =>
    Array.from({ length: 8 }, (_, i): Position => [
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

/** Rotates a position, so that no plane contains two of the coordinate axes. */
function rotated([x, y, z]: Position): Position {
  return [0.36 * x + 0.48 * y - 0.8 * z, -0.8 * x + 0.6 * y, 0.48 * x + 0.64 * y + 0.6 * z];
}

const cube: readonly [Position, Position] = [
  [0, 0, 0],
  [4, 4, 1],
];
const square = (x: number, y: number): readonly [Position, Position] => [
  [x, y, 0],
  [x + 1, y + 1, 1],
];

describe("facets of a .poly file", () => {
  const positions = boxes(cube, square(0.5, 0.5), square(2.5, 0.5), square(1.5, 2));
  const rings = (ring: readonly number[]) => [ring, ...[1, 2, 3].map((box) => shifted(ring, box))];
  const within = (z: number): Position[] => [
    [1, 1, z],
    [3, 1, z],
    [2, 2.5, z],
  ];
  const walls = [1, 2, 3].flatMap((box) => SIDES.map((ring) => ({ rings: [shifted(ring, box)] })));
  const outside = SIDES.map((ring) => ({ rings: [ring] }));

  test.each([
    ["", (position: Position) => position],
    [", rotated in space", rotated],
  ])("omit the areas marked as holes: a plate with three tubes%s", async (_, move) => {
    const caps = [
      { rings: rings(BOTTOM), holes: within(0).map(move) },
      { rings: rings(TOP), holes: within(1).map(move) },
    ];
    const surface = await surfaceOf(polyFile(positions.map(move), [...caps, ...outside, ...walls]));
    const { mesh: oriented } = await mesher.repairSurface(surface);
    const found = await mesher.inspectSurface(oriented);
    expect(found).toMatchObject({ isFillable: true, regions: 1, cavities: 0 });
    // The plate without the tubes has area 13. The edges of the tubes divide the faces around them.
    expect(enclosedVolume(oriented)).toBeCloseTo(13, 12);
    expect(found.area).toBeCloseTo(2 * 13 + 16 + 12, 12);
  });

  test("are divided by an inner polygon that is not a hole", async () => {
    const caps = [{ rings: rings(BOTTOM), holes: [] }, { rings: rings(TOP) }];
    const surface = await surfaceOf(polyFile(positions, [...caps, ...outside]));
    const found = await mesher.inspectSurface(surface);
    expect(found).toMatchObject({ isFillable: true, regions: 1, nodes: 32 });
    expect(enclosedVolume(surface)).toBeCloseTo(16, 12);
  });

  test("keep an island inside a hole", async () => {
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

  test("are rejected by index, with a remedy, if their polygons intersect", async () => {
    const crossing = boxes(cube, square(3.5, 1));
    const file = polyFile(crossing, [{ rings: [BOTTOM, shifted(BOTTOM, 1)], holes: [[3.7, 1.5, 0]] }]);
    await expect(surfaceOf(file)).rejects.toThrow(
      /facet 0 \(counted from 0\) .* intersect or have no area\. Save it as polygons that do not intersect/,
    );
  });
});

test("hole and region points of a .poly file are read with their numbers, attributes and volumes", async () => {
  const positions = boxes(square(0, 0));
  const facets = [BOTTOM, TOP, ...SIDES].map((ring) => ({ rings: [ring] }));
  const marks = "1\n4 .5 .5 .5\n2\n1 .1 .1 .1 7 .25\n2 .2 .2 .2 -8.5 -1\n";
  expect((await surfaceOf(polyFile(positions, facets, marks))).regionPoints).toEqual({
    holes: [{ number: 4, position: [0.5, 0.5, 0.5] }],
    regions: [
      { number: 1, position: [0.1, 0.1, 0.1], tag: 7, name: undefined, maxVolume: 0.25 },
      { number: 2, position: [0.2, 0.2, 0.2], tag: -8.5, name: undefined, maxVolume: undefined },
    ],
  });
  const none = { holes: [], regions: [] };
  expect((await surfaceOf(polyFile(positions, facets))).regionPoints).toEqual(none);
  expect((await surfaceOf(polyFile(positions, facets, ""))).regionPoints).toEqual(none);
});
