/** Lesson 8: every structure gives the answer of the list, and the heap gives the side that the engine takes. */
import { readFileSync } from "node:fs";
import { loadPlaneFront } from "tetrafront/trace";
import { describe, expect, test } from "vitest";
import { Heap, heapFilm } from "../../../web/teach/article/figures/search/heap-rules";
import { heapShape, heapSize } from "../../../web/teach/article/figures/search/heap-shape";
import {
  CellTree,
  HashGrid,
  ListSearch,
  makeFront,
  structureNames,
  structuresOf,
  type Query,
  whole,
} from "../../../web/teach/article/figures/search/search-rules";

import {
  makeSpaceFront,
  spaceStructureNames,
  spaceStructuresOf,
  wholeCube,
  type SpaceFront,
} from "../../../web/teach/article/figures/search/space-front";

/** The same random numbers every time. */
function randomNumbers(seed: number): () => number {
  let state = seed;
  return () => (state = (state * 16807) % 2147483647) / 2147483647;
}

describe("the structures", () => {
  test.each([12, 240, 960])("find what the list finds among %d nodes", (count) => {
    const structures = structuresOf(makeFront(count));
    const random = randomNumbers(count);
    for (let i = 0; i < 60; i++) {
      const circle: Query = {
        at: [random() * 1.2 - 0.1, random() * 1.2 - 0.1],
        radius: 0.005 + 0.4 * random(),
      };
      const { found, visits } = structures.list.find(circle);
      expect(visits).toHaveLength(count);
      for (const name of structureNames) {
        const answer = structures[name].find(circle);
        expect(answer.found).toEqual(found);
        const compared = answer.visits.flatMap((visit) => ("node" in visit ? [visit.node] : []));
        expect(new Set(compared).size).toBe(compared.length);
        for (const node of found) expect(compared).toContain(node);
      }
    }
  });

  test("find nodes that lie in one position, and on the border of cells", () => {
    const nodes = [...Array.from({ length: 9 }, () => [0.5, 0.5] as const), [0, 0] as const, [1, 1] as const];
    const structures = structuresOf(nodes);
    for (const name of structureNames) {
      expect(structures[name].find({ at: [0.5, 0.5], radius: 0.01 }).found).toHaveLength(9);
      expect(structures[name].find({ at: [1, 1], radius: 0 }).found).toEqual([10]);
    }
  });

  test("the front has as many nodes as are asked for, within its square", () => {
    for (const count of [60, 333, 960]) {
      const nodes = makeFront(count);
      expect(nodes).toHaveLength(count);
      for (const [x, y] of nodes) {
        expect(Math.min(x, y)).toBeGreaterThan(0);
        expect(Math.max(x, y)).toBeLessThan(1);
      }
    }
  });

  const text = readFileSync("web/lessons/8.md", "utf8");
  const rows = [...text.matchAll(/^\| (\d+) +\|(.+)\|$/gm)].map(([, count, cells = ""]) => ({
    count: Number(count),
    means: cells.split("|").map(Number),
  }));

  test("have a table of the lesson with four fronts", () => {
    expect(rows.map(({ count }) => count)).toEqual([60, 240, 960, 3840]);
  });

  test.each(rows)("make these mean visits with $count nodes", ({ count, means }) => {
    const nodes = makeFront(count);
    const side =
      nodes.reduce((sum, [x, y], i) => {
        const [u, v] = nodes[(i + 1) % count] ?? [x, y];
        return sum + Math.hypot(u - x, v - y);
      }, 0) / count;
    const structures = [new CellTree(nodes, whole), new HashGrid(nodes, 3 * side)];
    const found = structures.map((structure) =>
      Math.round(
        nodes.reduce((sum, at) => sum + structure.find({ at, radius: 2 * side }).visits.length, 0) / count,
      ),
    );
    expect([new ListSearch(nodes).find({ at: [0, 0], radius: 0 }).visits.length, ...found]).toEqual(means);
  });

  test("are dearer than a list for few nodes, as the lesson says", () => {
    const written =
      /up to (\d+) nodes, with \d+ visits against (\d+)\. With (\d+) nodes, it is \d+ against (\d+)/.exec(
        text,
      );
    const meanVisits = (count: number): number => {
      const nodes = makeFront(count);
      const side =
        nodes.reduce((sum, [x, y], i) => {
          const [u, v] = nodes[(i + 1) % count] ?? [x, y];
          return sum + Math.hypot(u - x, v - y);
        }, 0) / count;
      const tree = new CellTree(nodes, whole);
      return nodes.reduce((sum, at) => sum + tree.find({ at, radius: 2 * side }).visits.length, 0) / count;
    };
    const [few = 0, fewVisits = 0, more = 0, moreVisits = 0] = (written ?? []).slice(1).map(Number);
    expect(Math.round(meanVisits(few))).toBe(fewVisits);
    expect(Math.round(meanVisits(more))).toBe(moreVisits);
    for (let count = 5; count <= few; count++) expect(meanVisits(count)).toBeGreaterThan(count);
    for (let count = more; count < 80; count += 5) expect(meanVisits(count)).toBeLessThan(count);
  });

  test("differ in what they visit, as the tasks of the lesson ask", () => {
    const visits = (count: number, circle: Query): readonly number[] => {
      const structures = structuresOf(makeFront(count));
      return structureNames.map((name) => structures[name].find(circle).visits.length);
    };
    const [list = 0, quadtree = 0] = visits(960, { at: [0.83, 0.6], radius: 0.03 });
    expect(quadtree).toBeLessThan(0.05 * list);
    const [, tree = 0, grid = 0] = visits(960, { at: [0.3, 0.64], radius: 0.005 });
    expect(grid).toBeGreaterThan(3 * tree);
  });
});

describe("in space", () => {
  /** Mean length of the edges of a front; each edge is in two faces. */
  const meanSide = ({ nodes, faces }: SpaceFront): number =>
    faces
      .flatMap(([a, b, c]) => [a, b, c].map((node, i) => [node, [b, c, a][i] ?? a] as const))
      .reduce(
        (sum, [a, b]) => sum + Math.hypot(...(nodes[a] ?? []).map((x, i) => x - (nodes[b]?.[i] ?? 0))),
        0,
      ) /
    (3 * faces.length);

  test.each([1, 4, 12])("the front of %d parts is closed, outward, and within its cube", (parts) => {
    const { nodes, faces } = makeSpaceFront(parts);
    expect(nodes).toHaveLength(10 * parts * parts + 2);
    expect(faces).toHaveLength(20 * parts * parts);
    const edges = new Set(faces.flatMap(([a, b, c]) => [`${a} ${b}`, `${b} ${c}`, `${c} ${a}`]));
    expect(edges.size).toBe(3 * faces.length);
    expect([...edges].filter((edge) => !edges.has(edge.split(" ").reverse().join(" ")))).toEqual([]);
    let sixVolumes = 0;
    for (const face of faces) {
      const [[a, b, c] = [0, 0, 0], [d, e, f] = [0, 0, 0], [g, h, i] = [0, 0, 0]] = face.map(
        (node) => nodes[node],
      );
      sixVolumes += a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g);
    }
    expect(sixVolumes).toBeGreaterThan(0);
    for (const node of nodes) for (const x of node) expect(Math.abs(x)).toBeLessThan(0.5);
  });

  test.each([2, 8, 12])("octree and grid find what the list finds, front of %d parts", (parts) => {
    const { nodes } = makeSpaceFront(parts);
    const structures = spaceStructuresOf(nodes);
    const random = randomNumbers(parts);
    for (let i = 0; i < 60; i++) {
      const query = {
        at: [random() - 0.5, random() - 0.5, random() - 0.5] as const,
        radius: 0.01 + 0.4 * random(),
      };
      const found = [...nodes.keys()].filter(
        (node) => Math.hypot(...query.at.map((x, axis) => x - (nodes[node]?.[axis] ?? 0))) <= query.radius,
      );
      for (const name of spaceStructureNames) {
        const answer = structures[name].find(query);
        expect(answer.found).toEqual(found);
        const compared = answer.visits.flatMap((visit) => ("node" in visit ? [visit.node] : []));
        expect(new Set(compared).size).toBe(compared.length);
      }
    }
  });

  test("the lesson says how many nodes a ball holds, and how many visits find them", () => {
    const text = readFileSync("web/lessons/8.md", "utf8");
    const [, ball, circle] =
      /two sides holds about (\d+) nodes, where the circle held (\d+)/.exec(text) ?? [];
    const fronts = [4, 8, 16].map((parts) => {
      const front = makeSpaceFront(parts);
      const [tree, radius] = [new CellTree(front.nodes, wholeCube), 2 * meanSide(front)];
      const grid = new HashGrid(front.nodes, radius);
      const answers = front.nodes.map((at) => tree.find({ at, radius }));
      const mean = (of: (answer: (typeof answers)[number]) => number): number =>
        Math.round(answers.reduce((sum, answer) => sum + of(answer), 0) / answers.length);
      return {
        nodes: front.nodes.length,
        visits: mean(({ visits }) => visits.length),
        gridVisits: Math.round(
          front.nodes.reduce((sum, at) => sum + grid.find({ at, radius }).visits.length, 0) /
            front.nodes.length,
        ),
        found: mean(({ found }) => found.length),
      };
    });
    expect(fronts[1]?.found).toBe(Number(ball));
    const sentence = fronts.map(({ nodes, visits }) => [visits, nodes]);
    const written =
      /makes (\d+) visits among ([\d,]+) nodes, (\d+) among ([\d,]+), and (\d+) among ([\d,]+)\./
        .exec(text)
        ?.slice(1)
        .map((number) => Number(number.replace(",", "")));
    expect(written).toEqual(sentence.flat());
    const byGrid = /two sides wide, makes (\d+), (\d+) and (\d+)\./.exec(text)?.slice(1).map(Number);
    expect(byGrid).toEqual(fronts.map(({ gridVisits }) => gridVisits));
    const nodes = makeFront(240);
    const side =
      nodes.reduce((sum, [x, y], i) => {
        const [u, v] = nodes[(i + 1) % nodes.length] ?? [x, y];
        return sum + Math.hypot(u - x, v - y);
      }, 0) / nodes.length;
    const list = new ListSearch(nodes);
    const held = nodes.reduce((sum, at) => sum + list.find({ at, radius: 2 * side }).found.length, 0);
    expect(Math.round(held / nodes.length)).toBe(Number(circle));
  });

  test("a hollow without nodes costs the grid more than four times the visits of the octree", () => {
    const structures = spaceStructuresOf(makeSpaceFront(8).nodes);
    const query = { at: [0.06, 0, -0.04] as const, radius: 0.155 };
    const [list, octree, grid] = spaceStructureNames.map((name) => structures[name].find(query));
    expect(list?.found).toEqual([]);
    const text = readFileSync("web/lessons/8.md", "utf8");
    expect(text).toContain(`[${grid?.visits.length}](show:B.grid) visits, most of them`);
    expect(text).toContain(`against [${octree?.visits.length}](show:B.octree). The tree`);
    expect(grid?.visits.length).toBeGreaterThan(4 * (octree?.visits.length ?? Infinity));
  });
});

describe("the heap", () => {
  test("gives its entries in their order", () => {
    const random = randomNumbers(3);
    const heap = new Heap();
    const lengths = Array.from({ length: 300 }, () => Math.round(random() * 40));
    lengths.forEach((length, side) => heap.push({ side, pass: 0, length }));
    for (let side = 0; side < 300; side += 3) heap.remove(side);
    const taken: number[] = [];
    while (heap.top) {
      taken.push(heap.top.length);
      heap.remove(heap.top.side);
    }
    const left = lengths.filter((_length, side) => side % 3 !== 0).sort((a, b) => a - b);
    expect(taken).toEqual(left);
  });

  test("takes its first entry out with at most the comparisons of the lesson, and puts one in", () => {
    const text = readFileSync("web/lessons/8.md", "utf8");
    const [, count, rows, taken, put] =
      /with ([\d,]+) sides, the heap has (\d+) rows: .+ at most (\d+) comparisons, .+ at most (\d+)\./
        .exec(text)
        ?.map((number) => Number(number.replace(",", ""))) ?? [];
    const heap = new Heap();
    for (let side = 0; side < (count ?? 0); side++) heap.push({ side, pass: 0, length: side });
    expect(Math.floor(Math.log2(heap.size)) + 1).toBe(rows);
    let most = 0;
    const random = randomNumbers(8);
    for (let i = 0; i < 300; i++) {
      heap.comparisons = 0;
      heap.remove(heap.top?.side ?? 0);
      most = Math.max(most, heap.comparisons);
      heap.push({ side: 5000 + i, pass: 0, length: 4000 * random() });
    }
    expect(most).toBeLessThanOrEqual(taken ?? 0);
    expect(most).toBeGreaterThan((taken ?? 0) - 4);
    heap.comparisons = 0;
    heap.push({ side: 9000, pass: 0, length: -1 });
    expect(heap.comparisons).toBe(put);
  });

  test("has on top the side that the engine takes, in every step, and the sides of the front", async () => {
    const made = heapFilm(await loadPlaneFront(), heapShape, heapSize);
    expect(made?.film.sizes.at(-1)).toBe(0);
    made?.steps.forEach(({ base, states }, k) => {
      expect(states[0]?.[0]).toBe(base);
      expect(states[0]).toHaveLength(made.film.sizes[k] ?? NaN);
      expect(states[4]).toHaveLength(made.film.sizes[k + 1] ?? NaN);
    });
    const cheaper = made?.steps.filter(({ comparisons, listComparisons }) => listComparisons < comparisons);
    expect(cheaper?.length).toBeGreaterThan(0);
  });
});
