/** "Be the mesher": overlaps against random samples, and fronts that close, stall, or refuse, in the plane and in space. */
import { expect, test } from "vitest";
import type { Position } from "../../../web/document/position";
import { addScaled, mean } from "../../../web/document/vectors";
import { Board, cornersOf, measuresOf } from "../../../web/teach/article/figures/mesher/board";
import { loadLevel } from "../../../web/teach/article/figures/mesher/levels";
import {
  contains,
  gapBetween,
  overlaps,
  smallestAngleOf,
} from "../../../web/teach/article/figures/mesher/simplices";
import { outlookOf } from "../../../web/teach/article/figures/mesher/outlook";
import { twistedPrism } from "../../../web/teach/article/figures/pocket/twisted-prism";
import { playWell } from "../../support/good-mesher";
import { randomSource } from "../../support/random";

const sizeAt = () => 1;

/** Returns a generator of numbers from 0 to 1. */
function random(seed: number): () => number {
  const source = randomSource(seed);
  return () => source() / 2 ** 32;
}

/** A regular polygon, with its front around the inside. */
function polygon(corners: number): Board {
  const nodes = Array.from({ length: corners }, (_none, i): Position => {
    const angle = (2 * Math.PI * i) / corners;
    return [Math.cos(angle), Math.sin(angle), 0];
  });
  return new Board({ nodes, facets: nodes.map((_node, i) => [i, (i + 1) % corners]), sizeAt });
}

const cubeNodes = Array.from({ length: 8 }, (_none, i): Position => [i & 1, (i >> 1) & 1, i >> 2]);
/** The squares of a cube, seen from inside counter-clockwise. */
const squares = [
  [0, 1, 3, 2],
  [4, 6, 7, 5],
  [0, 4, 5, 1],
  [2, 3, 7, 6],
  [0, 2, 6, 4],
  [1, 5, 7, 3],
];
const cube = (): Board =>
  new Board({
    nodes: cubeNodes,
    facets: squares.flatMap(([a = 0, b = 0, c = 0, d = 0]) => [
      [a, b, c],
      [a, c, d],
    ]),
    sizeAt,
  });

/** Makes elements as well as one can by trying all nodes, and then new ones. */
function play(board: Board, order: (nodes: readonly number[]) => readonly number[] = (nodes) => nodes): void {
  for (let i = 0; i < 40 && board.active; i++) {
    const facet = board.active;
    const node = order(board.nodesFor(facet, Infinity)).find((each) => board.judge(facet, each) === null);
    const heights = [1, 0.7, 0.5, 0.3, 0.15].map((share) => board.idealOf(facet, share));
    board.choose(node ?? heights.find((at) => board.judge(facet, at) === null) ?? [0, 0, 0]);
  }
}

const volumeOf = ([a, b, c, d]: readonly Position[]): number => {
  if (!a || !b || !c) return 0;
  const [u, v, w] = [b, c, d ?? ([a[0], a[1], 1] as const)].map((p) => p.map((x, i) => x - (a[i] ?? 0)));
  const det = (p: number[] = [], q: number[] = [], r: number[] = []): number =>
    (p[0] ?? 0) * ((q[1] ?? 0) * (r[2] ?? 0) - (q[2] ?? 0) * (r[1] ?? 0)) -
    (p[1] ?? 0) * ((q[0] ?? 0) * (r[2] ?? 0) - (q[2] ?? 0) * (r[0] ?? 0)) +
    (p[2] ?? 0) * ((q[0] ?? 0) * (r[1] ?? 0) - (q[1] ?? 0) * (r[0] ?? 0));
  return det(u, v, w) / (d ? 6 : 2);
};

test.each([3, 4, 5, 9])("a polygon of %d corners closes, and its triangles fill it", (corners) => {
  const board = polygon(corners);
  play(board);
  expect(board.isClosed).toBe(true);
  const area = board.elements.reduce((sum, each) => sum + volumeOf(board.positions(each)), 0);
  expect(area).toBeCloseTo((corners / 2) * Math.sin((2 * Math.PI) / corners), 9);
});

test.each([1, 2, 3, 4])("elements in a cube do not overlap, whatever the choices: order %d", (seed) => {
  const next = random(seed);
  const board = cube();
  expect(board.front).toHaveLength(12);
  play(board, (nodes) =>
    nodes
      .map((node) => [next(), node] as const)
      .toSorted()
      .map(([, node]) => node),
  );
  const volumes = board.elements.map((each) => volumeOf(board.positions(each)));
  expect(Math.min(...volumes)).toBeGreaterThan(0);
  const filled = volumes.reduce((sum, volume) => sum + volume, 0);
  if (board.isClosed) expect(filled).toBeCloseTo(1, 9);
  else expect(filled).toBeLessThan(1);
});

test("a choice is refused behind the side, across the front, around a node, and along other sides", () => {
  // An L: node 3 is the corner that points inwards.
  const nodes: Position[] = [
    [0, 0, 0],
    [2, 0, 0],
    [2, 1, 0],
    [1, 1, 0],
    [1, 2, 0],
    [0, 2, 0],
    [0, 1, 0],
  ];
  const board = new Board({ nodes, facets: nodes.map((_node, i) => [i, (i + 1) % 7]), sizeAt });
  expect(board.judge([0, 1], [1, -0.5, 0])?.fault).toBe("behind");
  expect(board.judge([1, 2], 4)?.fault).toBe("crosses");
  expect(board.judge([4, 5], 1)?.inTheWay.length).toBeGreaterThan(0);
  // Its long side lies on two sides of the front, with a node between them.
  expect(board.judge([4, 5], 0)?.fault).toBe("encloses");
  expect(board.judge([4, 5], 6)).toBeNull();
  expect(board.choose([9, 9, 0])).not.toBeNull();
  expect(board.refused).toHaveLength(1);
  expect(board.elements).toHaveLength(0);
});

test("a front in which all sides wait has stalled", () => {
  const board = polygon(5);
  for (let i = 0; i < 5; i++) board.wait();
  expect(board.isStalled).toBe(true);
  expect(board.active).toBeNull();
});

test("elements and facets overlap as random points in them say", () => {
  const next = random(11);
  const point = (dimension: number): Position => [next(), next(), dimension === 3 ? next() : 0];
  const inside = (corners: readonly Position[]): Position => {
    const weights = corners.map(() => -Math.log(next() || 1e-9));
    const sum = weights.reduce((a, b) => a + b, 0);
    return corners.reduce((at, corner, i) => addScaled(at, corner, (weights[i] ?? 0) / sum), [
      0, 0, 0,
    ] as Position);
  };
  let [apart, meeting] = [0, 0];
  for (let i = 0; i < 600; i++) {
    const dimension = 2 + (i % 2);
    const element = Array.from({ length: dimension + 1 }, () => point(dimension));
    if (Math.abs(volumeOf(element)) < 0.01) continue;
    const facet = Array.from({ length: dimension }, () => point(dimension));
    const seen = Array.from({ length: 300 }, () => inside(facet)).some((at) => contains(element, at));
    if (seen) expect(overlaps(element, facet)).toBe(true);
    if (seen) meeting++;
    else apart++;
  }
  expect(Math.min(apart, meeting)).toBeGreaterThan(50);
  const tetrahedron: Position[] = [
    [0, 0, 0],
    [1, 0, 0],
    [0, 1, 0],
    [0, 0, 1],
  ];
  // What only touches does not overlap.
  expect(
    overlaps(tetrahedron, [
      [0, 0, 0],
      [-1, 0, 0],
      [0, -1, 0],
    ]),
  ).toBe(false);
  expect(
    overlaps(tetrahedron, [
      [1, 0, 0],
      [0, 1, 0],
      [0, 0, 1],
    ]),
  ).toBe(false);
  expect(
    overlaps(tetrahedron, [
      [0.2, 0.2, -1],
      [0.2, 0.2, 1],
      [2, 2, 0],
    ]),
  ).toBe(true);
});

test("angles and gaps", () => {
  const corners: Position[] = [
    [1, 1, 1],
    [1, -1, -1],
    [-1, 1, -1],
    [-1, -1, 1],
  ];
  expect(smallestAngleOf(corners)).toBeCloseTo(70.53, 2);
  expect(
    smallestAngleOf([
      [0, 0, 0],
      [3, 0, 0],
      [0, 3, 0],
    ]),
  ).toBeCloseTo(45, 9);
  expect(
    gapBetween(
      [
        [0, 0, 0],
        [1, 0, 0],
      ],
      [
        [0.5, -1, 2],
        [0.5, 1, 2],
      ],
    ),
  ).toBeCloseTo(2, 9);
  expect(
    gapBetween(
      [
        [0, 0, 0],
        [1, 0, 0],
      ],
      [
        [3, 0, 0],
        [4, 0, 0],
      ],
    ),
  ).toBeCloseTo(2, 9);
  const { angle, worst } = measuresOf(
    [...corners, mean(corners)],
    [
      [0, 1, 2, 3],
      [0, 1, 2, 4],
    ],
    4,
  );
  expect(worst).toBe(1);
  expect(angle).toBeLessThan(70);
});

test.each(["five", "boot", "fine", "stretched"] as const)(
  "the level %s begins with the program's front, and can be closed",
  async (name) => {
    const level = await loadLevel(name);
    const { board } = playWell(level);
    expect(board.isClosed).toBe(true);
    const { nodes, elements } = level.program;
    const areaOf = (corners: readonly Position[]): number => Math.abs(volumeOf(corners));
    const [filled, expected] = [
      board.elements.reduce((sum, each) => sum + areaOf(board.positions(each)), 0),
      elements.reduce((sum, each) => sum + areaOf(cornersOf(nodes, each)), 0),
    ];
    expect(filled).toBeCloseTo(expected, 9);
    const [mine, theirs] = [board, level.program].map((mesh) => measuresOf(mesh.nodes, mesh.elements, 0));
    expect(mine?.angle).toBeGreaterThan((theirs?.angle ?? 90) - 0.5);
  },
);

test("who plays well fills a cube with five tetrahedra", () => {
  const facets = cube().front;
  // Diagonals that leave a regular tetrahedron in the middle.
  const around = squares.flatMap(([a = 0, b = 0, c = 0, d = 0]) =>
    [a, c].every((node) => [0, 3, 5, 6].includes(node))
      ? [
          [a, b, c],
          [a, c, d],
        ]
      : [
          [b, c, d],
          [b, d, a],
        ],
  );
  expect(around).toHaveLength(facets.length);
  const { board, choices } = playWell({ nodes: cubeNodes, facets: around, sizeAt });
  expect(board.isClosed).toBe(true);
  expect(choices).toHaveLength(5);
  expect(measuresOf(board.nodes, board.elements, 8).angle).toBeCloseTo(54.74, 2);
});

test("none of its own nodes fills a turned prism, and one new node does", () => {
  const { corners, faces } = twistedPrism(20);
  const start = { nodes: corners, facets: faces, sizeAt };
  const board = new Board(start);
  for (const facet of board.front)
    for (const node of board.nodesFor(facet, Infinity)) expect(board.judge(facet, node)).not.toBeNull();
  const played = playWell(start);
  expect(played.board.isClosed).toBe(true);
  expect(played.board.elements).toHaveLength(8);
  expect(played.choices.filter((choice) => choice === "new")).toHaveLength(1);
});

test("undo takes choices back one by one, and an outlook leaves the board as it was", () => {
  const board = polygon(6);
  const seen: string[] = [];
  const state = (): string => JSON.stringify([board.nodes, board.elements, board.front, board.active]);
  for (let i = 0; i < 3 && board.active; i++) {
    seen.push(state());
    const facet = board.active;
    for (const node of board.nodesFor(facet, 8)) outlookOf(board, node);
    expect(state()).toBe(seen.at(-1));
    if (i === 1) board.wait();
    else board.choose(board.nodesFor(facet, 8).find((node) => !board.judge(facet, node)) ?? -1);
  }
  while (board.canUndo) {
    board.undo();
    expect(state()).toBe(seen.pop());
  }
  expect(seen).toEqual([]);
});

test("an outlook tells the sharpest corner that a choice leaves", () => {
  // A right-angled corner of which the choice leaves 90° - 63.4°.
  const nodes: Position[] = [
    [0, 0, 0],
    [1, 0, 0],
    [1, 2, 0],
    [0, 2, 0],
  ];
  const board = new Board({ nodes, facets: nodes.map((_node, i) => [i, (i + 1) % 4]), sizeAt });
  expect(board.active).toEqual([0, 1]);
  const outlook = outlookOf(board, 2);
  expect(outlook?.angle).toBeCloseTo(26.57, 2);
  expect(outlook?.left).toBeCloseTo(26.57, 2);
});
