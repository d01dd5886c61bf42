/** Polygons filled in the plane: the same triangles as natively, records that lead to them, and shapes that are refused. */
import { fillPlane, loadPlaneFront, type PlaneSizes } from "tetrafront/trace";
import { beforeAll, describe, expect, test } from "vitest";
import { polygonArea, storedPlanes, successOf, triangleAreas } from "../../support/planes.js";

const square = Float64Array.of(0, 0, 4, 0, 4, 4, 0, 4);
let front: Awaited<ReturnType<typeof loadPlaneFront>>;

beforeAll(async () => {
  front = await loadPlaneFront();
});

describe("fingerprints", () => {
  test.each(storedPlanes())("$name has the triangles of the native engine", (plane) => {
    const filled = successOf(front.fill(plane.loops, plane.sizes, plane.options));
    expect(filled.fingerprint).toBe(plane.fingerprint);
    const areas = triangleAreas(filled.mesh.points, filled.mesh.triangles);
    expect(Math.min(...areas)).toBeGreaterThan(0);
    expect(areas.reduce((sum, area) => sum + area, 0)).toBeCloseTo(polygonArea(plane.loops), 10);
  });

  test("a fill repeats itself, also when called without a loaded front", async () => {
    const one = successOf(await fillPlane([square], 0.5, { order: "random", seed: 5 }));
    const other = successOf(front.fill([square], 0.5, { order: "random", seed: 5 }));
    expect(other.fingerprint).toBe(one.fingerprint);
  });
});

describe("record", () => {
  test("the states lead from the boundary to the triangles of the front", () => {
    const { front: made, trace, status } = successOf(front.fill([square], 0.5, { improve: false }));
    expect(status).toBe("done");
    expect(made.end).toBe("covered");
    expect(trace.divisions).toHaveLength(4);
    const alive = (state: number) =>
      made.edgesBorn.reduce((n, b, e) => n + Number(b <= state && (made.edgesDied[e] ?? 0) > state), 0);
    expect(alive(made.firstStep)).toBe(made.boundaryNodes);
    expect(alive(trace.stepCount)).toBe(0);
    for (let step = made.firstStep; step <= trace.stepCount; step++)
      expect(alive(step)).toBe(trace.frontSizeAt(step));
    for (let step = made.firstStep + 1; step <= trace.stepCount; step++) {
      const taken = trace.stepAt(step);
      if (taken?.kind !== "edge") throw new Error(`step ${step} is no edge`);
      expect(taken.candidates.some(({ verdict }) => verdict === "accepted")).toBe(
        taken.outcome === "accepted",
      );
    }
  });

  test("the corners of the polygon are nodes, bit for bit", () => {
    const loop = Float64Array.of(0.1, 0.2, 3.3, -0.7, 2.9, 3.1, -0.2, 2.2);
    const { front: made, mesh } = successOf(front.fill([loop], 0.7));
    const at = (points: Float64Array) => {
      const keys = new Set<string>();
      for (let i = 0; i < points.length; i += 2) keys.add(`${points[i]},${points[i + 1]}`);
      return keys;
    };
    for (const corner of at(loop)) {
      expect(at(made.plane)).toContain(corner);
      expect(at(mesh.points)).toContain(corner);
    }
  });

  test("an improved fill records its triangulation, and places it in space", () => {
    const { trace, front: made, mesh } = successOf(front.fill([square], 0.4));
    expect(trace.kindAt(trace.stepCount)).toBe("improved");
    expect([...(made.improved?.triangles ?? [])]).toEqual([...mesh.triangles]);
    const placed = trace.improvedPositions(0);
    expect(placed?.length).toBe((3 * mesh.points.length) / 2);
    for (let node = 0; 2 * node < mesh.points.length; node++) {
      expect(placed?.[3 * node]).toBe(mesh.points[2 * node]);
      expect(placed?.[3 * node + 1]).toBe(mesh.points[2 * node + 1]);
    }
  });

  test("a stopped front keeps its edges", () => {
    const { status, front: made, trace, mesh } = successOf(front.fill([square], 0.5, { maxSteps: 7 }));
    expect(status).toBe("stopped");
    expect(made.end).toBe("stopped");
    expect(trace.stepCount - made.firstStep).toBe(7);
    expect(trace.frontSizeAt(trace.stepCount)).toBeGreaterThan(0);
    expect(mesh.triangles.length / 3).toBe(made.trianglesBorn.length);
    const divided = successOf(front.fill([square], 0.5, { maxSteps: 0 }));
    expect(divided.front.boundaryNodes).toBe(32);
    expect(divided.mesh.triangles).toHaveLength(0);
  });

  test("a front without relaxation may stall, which is a status", () => {
    const comb = Float64Array.of(0, 0, 9, 0, 9, 3, 8, 0.3, 6, 3, 5, 0.4, 3.2, 3, 2, 0.2, 0, 3);
    const filled = successOf(front.fill([comb], 2, { experiment: { relaxation: false } }));
    expect(filled.status).toBe("stalled");
    expect(filled.front.end).toBe("stalled");
    const relaxed = successOf(front.fill([comb], 2));
    expect(relaxed.status).toBe("done");
  });

  test("the order decides which edge is next", () => {
    const loop = Float64Array.of(0, 0, 3, 0, 3, 1, 1, 1.5, 0, 1.2);
    const lengthOf = (order: "smallest-first" | "first-in") => {
      const { trace, front: made } = successOf(front.fill([loop], 1, { order, boundary: "given" }));
      const { base } = trace.triedAt(made.firstStep + 1);
      return base;
    };
    // Segment 4 is the shortest, and segment 2 is 1.2 times as long as segment 1.
    expect(lengthOf("smallest-first")).toBe(1);
    expect(lengthOf("first-in")).toBe(0);
  });

  test("a lower height makes flatter triangles", () => {
    const heightOf = (height: number): number => {
      const { trace, front: made } = successOf(front.fill([square], 0.5, { height }));
      const step = trace.stepAt(made.firstStep + 1);
      if (step?.kind !== "edge") throw new Error("no edge");
      const [a, b] = step.nodes.map((node) => [made.plane[2 * node] ?? 0, made.plane[2 * node + 1] ?? 0]);
      const middle = [0, 1].map((axis) => ((a?.[axis] ?? 0) + (b?.[axis] ?? 0)) / 2);
      return Math.hypot(step.ideal[0] - (middle[0] ?? 0), step.ideal[1] - (middle[1] ?? 0));
    };
    expect(heightOf(0.5)).toBeCloseTo(0.5 * heightOf(1), 6);
  });
});

describe("sizes", () => {
  const edgeLengths = (
    sizes: PlaneSizes,
  ): { readonly middle: readonly number[]; readonly length: number }[] => {
    const { points, triangles } = successOf(front.fill([square], sizes)).mesh;
    const edges = [];
    for (let t = 0; t < triangles.length; t += 3) {
      for (let i = 0; i < 3; i++) {
        const [a = 0, b = 0] = [triangles[t + i], triangles[t + ((i + 1) % 3)]];
        const [ax = 0, ay = 0] = points.subarray(2 * a, 2 * a + 2);
        const [bx = 0, by = 0] = points.subarray(2 * b, 2 * b + 2);
        edges.push({ middle: [(ax + bx) / 2, (ay + by) / 2], length: Math.hypot(bx - ax, by - ay) });
      }
    }
    return edges;
  };
  const mean = (numbers: readonly number[]) => numbers.reduce((sum, n) => sum + n, 0) / numbers.length;

  test("grow from sources", () => {
    const edges = edgeLengths({
      size: 1,
      sources: [{ position: [0, 0], size: 0.1, distance: 0.5, growth: 0.2 }],
    });
    for (const {
      middle: [x = 0, y = 0],
      length,
    } of edges) {
      const target = Math.min(1, 0.1 + 0.2 * Math.max(0, Math.hypot(x, y) - 0.5));
      expect(length).toBeLessThan(1.9 * target);
      expect(length).toBeGreaterThan(0.45 * target);
    }
  });

  test("are interpolated between nodes", () => {
    const edges = edgeLengths({
      nodes: [
        { position: [0, 2], size: 0.15 },
        { position: [4, 2], size: 0.6 },
      ],
    });
    const near = (x: number) =>
      mean(edges.filter((e) => Math.abs((e.middle[0] ?? 0) - x) < 0.4).map((e) => e.length));
    expect(near(0.4)).toBeGreaterThan(0.15);
    expect(near(0.4)).toBeLessThan(0.28);
    expect(near(3.6)).toBeGreaterThan(0.45);
    expect(near(3.6)).toBeLessThan(0.65);
  });

  test("are stretched along a direction", () => {
    const {
      mesh,
      trace,
      front: made,
    } = successOf(
      front.fill([square], { nodes: [{ position: [2, 2], size: 0.2, stretching: 4, direction: [1, 1] }] }),
    );
    const spread = (axis: readonly [number, number]): number => {
      const { points, triangles } = mesh;
      const widths = Array.from({ length: triangles.length / 3 }, (_, t) => {
        const along = [...triangles.subarray(3 * t, 3 * t + 3)].map(
          (node) => (points[2 * node] ?? 0) * axis[0] + (points[2 * node + 1] ?? 0) * axis[1],
        );
        return Math.max(...along) - Math.min(...along);
      });
      return mean(widths) / Math.SQRT2;
    };
    expect(spread([1, 1]) / spread([1, -1])).toBeGreaterThan(3);
    const step = trace.stepAt(made.firstStep + 1);
    // G has the eigenvalues 1 / 0.2² across and 1 / 0.8² along the diagonal.
    if (step?.kind !== "edge") throw new Error("no edge");
    const [xx, xy, yy] = step.metric;
    expect(xx + yy + 2 * xy).toBeCloseTo(2 / 0.64, 3);
    expect(xx + yy - 2 * xy).toBeCloseTo(2 / 0.04, 2);
  });
});

describe("refused", () => {
  const refused = (loops: readonly Float64Array[], sizes: PlaneSizes = 1) => {
    const result = front.fill(loops, sizes);
    if (result.success) throw new Error("was filled");
    return result;
  };

  test("a loop that crosses itself, with its segments", () => {
    const bow = Float64Array.of(0, 0, 4, 4, 4, 0, 0, 4);
    expect(refused([bow])).toMatchObject({
      code: "crossing",
      message: "the outer loop crosses itself: segments 0 and 2 meet",
      segments: [
        { loop: 0, segment: 0 },
        { loop: 0, segment: 2 },
      ],
    });
  });

  test("loops that cross each other, and misplaced holes", () => {
    const hole = (x: number, y: number, r: number) => Float64Array.of(x - r, y - r, x + r, y - r, x, y + r);
    expect(refused([square, hole(2, 2, 0.5), hole(4, 2, 0.5)])).toMatchObject({
      code: "crossing",
      loops: [0, 2],
      segments: [
        { loop: 0, segment: 1 },
        { loop: 2, segment: 0 },
      ],
    });
    expect(refused([square, hole(8, 2, 0.5)])).toMatchObject({ code: "hole-outside", loops: [1] });
    expect(refused([square, hole(2, 2, 0.2), hole(2, 2, 1)])).toMatchObject({
      code: "nested-holes",
      message: "hole 1 is inside hole 2",
      loops: [1, 2],
    });
  });

  test("polygons and positions that are none", () => {
    expect(refused([])).toMatchObject({ code: "no-polygon" });
    expect(refused([Float64Array.of(0, 0, 1, 1)])).toMatchObject({ code: "no-polygon", loops: [0] });
    expect(refused([Float64Array.of(0, 0, 1, 1, 2)])).toMatchObject({ code: "no-polygon" });
    expect(refused([Float64Array.of(0, 0, 1, NaN, 2, 2)])).toMatchObject({ code: "invalid-position" });
    expect(refused([Float64Array.of(0, 0, 1, 0, 1, 0, 0, 1)])).toMatchObject({
      code: "same-corner",
      message: "corners 1 and 2 of the outer loop are at the same position",
    });
    expect(refused([Float64Array.of(0, 0, 1, 0, 2, 0)])).toMatchObject({ code: "crossing" });
  });

  test("sizes out of range, and sizes that ask for too many sides", () => {
    for (const size of [0, -1, NaN, Infinity]) expect(refused([square], size).code).toBe("invalid-size");
    expect(refused([square], { nodes: [] }).code).toBe("invalid-size");
    const node = { position: [0, 0], size: 1 } as const;
    expect(refused([square], { nodes: [{ ...node, stretching: 0.5 }] }).code).toBe("invalid-size");
    expect(refused([square], { nodes: [{ ...node, direction: [0, 0] }] }).code).toBe("invalid-size");
    expect(refused([square], { size: 1, sources: [{ ...node, growth: -1 }] }).code).toBe("invalid-size");
    expect(refused([square], 1e-6)).toMatchObject({ code: "too-many-sides" });
  });

  test("more segments than sides are permitted, without a walk through them", () => {
    const circle = Float64Array.from({ length: 300_000 }, (_, i) => {
      const angle = (2 * Math.PI * Math.floor(i / 2)) / 150_000;
      return i % 2 === 0 ? Math.cos(angle) : Math.sin(angle);
    });
    const node = { position: [0, 0], size: 1 } as const;
    expect(front.fill([circle], { nodes: [node] }, { boundary: "given" })).toMatchObject({
      code: "too-many-sides",
    });
  });

  test("loops and sizes of another kind are errors of the program", () => {
    expect(() => front.fill(undefined as never, 1)).toThrow(/argument loops is invalid/);
    expect(() => front.fill([[[0, 0, 0]]] as never, 1)).toThrow(/argument loops\[0\]\[0\] is invalid/);
    expect(() => front.fill([square], null as never)).toThrow(/argument sizes is invalid/);
    expect(() => front.fill([square], "1" as never)).toThrow(/argument sizes is invalid/);
    expect(() => front.fill([square], { size: "1" } as never)).toThrow(/argument sizes.size is invalid/);
    const source = { position: [1], size: 1 };
    expect(() => front.fill([square], { size: 1, sources: [source] } as never)).toThrow(/sizes.sources\[0\]/);
  });

  test("unknown options are errors of the program", () => {
    expect(() => front.fill([square], 1, { order: "largest" as "random" })).toThrow(
      /options.order is invalid/,
    );
    expect(() => front.fill([square], 1, { height: 0 })).toThrow(/options.height/);
    expect(() => front.fill([square], 1, { hight: 1 } as object)).toThrow(/no key "hight"|no key hight/);
  });
});
