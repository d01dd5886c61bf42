import { describe, expect, it } from "vitest";
import { conjugateGradients, stabilizedBiconjugateGradients } from "../../../web/solve/linear-solvers";
import {
  SolveError,
  type ElasticityProblem,
  type HeatProblem,
  type Problem,
  type ScalarCondition,
  type SolvedMesh,
} from "../../../web/solve/problem";
import { SolveClient } from "../../../web/solve/solve-client";
import { solveProblem } from "../../../web/solve/solve-problem";
import { assembleScalar } from "../../../web/solve/scalar-problems";
import { assembleElasticity } from "../../../web/solve/elasticity";
import type { Message, Reply, WorkerPort } from "../../../web/workers/worker-client";

/** Six tetrahedra per cell around the diagonal of the cell. */
const sixth = [
  [0, 1, 3, 7],
  [0, 3, 2, 7],
  [0, 2, 6, 7],
  [0, 6, 4, 7],
  [0, 4, 5, 7],
  [0, 5, 1, 7],
] as const;

/**
 * A box of cells with six patches: x = 0, x = end, y = 0 …; `shake` moves the nodes inside by this share of a cell, always by
 * the same pseudorandom numbers.
 */
function box(counts: readonly [number, number, number], lengths = [1, 1, 1], shake = 0): SolvedMesh {
  const [nx, ny, nz] = counts;
  const nodeAt = (x: number, y: number, z: number): number => x + (nx + 1) * (y + (ny + 1) * z);
  const points: number[] = [];
  let seed = 7;
  const random = (): number => {
    seed = (seed * 16807) % 2147483647;
    return seed / 2147483647 - 0.5;
  };
  for (let z = 0; z <= nz; ++z)
    for (let y = 0; y <= ny; ++y)
      for (let x = 0; x <= nx; ++x) {
        const isInside = x > 0 && x < nx && y > 0 && y < ny && z > 0 && z < nz;
        [x, y, z].forEach((at, k) => {
          const cell = (lengths[k] ?? 1) / (counts[k] ?? 1);
          points.push(cell * (at + (isInside ? shake * random() : 0)));
        });
      }
  const tetrahedra: number[] = [];
  for (let z = 0; z < nz; ++z)
    for (let y = 0; y < ny; ++y)
      for (let x = 0; x < nx; ++x)
        for (const corners of sixth)
          tetrahedra.push(
            ...corners.map((corner) => nodeAt(x + (corner & 1), y + ((corner >> 1) & 1), z + (corner >> 2))),
          );
  return {
    points: Float64Array.from(points),
    tetrahedra: Uint32Array.from(tetrahedra),
    ...sidesOf(points, tetrahedra, lengths),
  };
}

/** The faces of elements in the six sides of the box. */
function sidesOf(points: number[], tetrahedra: number[], lengths: readonly number[]) {
  const triangles: number[] = [];
  const patches: number[] = [];
  for (let t = 0; t < tetrahedra.length; t += 4) {
    for (let left = 0; left < 4; ++left) {
      const face = tetrahedra.slice(t, t + 4).filter((_, k) => k !== left);
      for (let side = 0; side < 6; ++side) {
        const at = side % 2 === 0 ? 0 : (lengths[side >> 1] ?? 1);
        if (!face.every((node) => points[3 * node + (side >> 1)] === at)) continue;
        triangles.push(...face);
        patches.push(side);
      }
    }
  }
  return { triangles: Uint32Array.from(triangles), trianglePatch: Uint32Array.from(patches) };
}

const everywhere = (value: number): ReadonlyMap<number, ScalarCondition> =>
  new Map(Array.from({ length: 6 }, (_, side) => [side, { kind: "value", value }]));

const heat = (change: Partial<HeatProblem>): HeatProblem => ({
  kind: "heat",
  conductivity: 1,
  source: 0,
  conditions: new Map(),
  ...change,
});

const elastic = (change: Partial<ElasticityProblem>): ElasticityProblem => ({
  kind: "elasticity",
  youngsModulus: 200,
  poissonRatio: 0.3,
  bodyForce: [0, 0, 0],
  conditions: new Map(),
  ...change,
});

const fieldOf = (mesh: SolvedMesh, problem: Problem, index = 0): Float64Array =>
  solveProblem(mesh, problem).fields[index]?.values ?? new Float64Array();

const positionsOf = ({ points }: SolvedMesh): (readonly [number, number, number])[] =>
  Array.from({ length: points.length / 3 }, (_, n) => [
    points[3 * n] ?? 0,
    points[3 * n + 1] ?? 0,
    points[3 * n + 2] ?? 0,
  ]);

function largestDifference(a: ArrayLike<number>, b: ArrayLike<number>): number {
  return Math.max(...Array.from(a, (value, i) => Math.abs(value - (b[i] ?? 0))));
}

/** Returns a sum over the elements with the midpoints of their edges, exact for quadratic functions. */
function l2Error(mesh: SolvedMesh, values: Float64Array, exact: (p: readonly number[]) => number): number {
  const { points, tetrahedra } = mesh;
  let sum = 0;
  for (let t = 0; t < tetrahedra.length; t += 4) {
    const corners = [...tetrahedra.subarray(t, t + 4)].map((n) => ({
      p: [...points.subarray(3 * n, 3 * n + 3)],
      u: values[n] ?? 0,
    }));
    const [a = [], b = [], c = [], d = []] = corners.map(({ p }) => p);
    const edge = (q: number[]): number[] => q.map((x, k) => x - (a[k] ?? 0));
    const [[bx = 0, by = 0, bz = 0], [cx = 0, cy = 0, cz = 0], [dx = 0, dy = 0, dz = 0]] = [
      edge(b),
      edge(c),
      edge(d),
    ];
    const volume = (bx * (cy * dz - cz * dy) + by * (cz * dx - cx * dz) + bz * (cx * dy - cy * dx)) / 6;
    let mean = 0;
    for (let i = 0; i < 4; ++i)
      for (let j = i + 1; j < 4; ++j) {
        const [from, to] = [corners[i], corners[j]];
        const middle = from?.p.map((x, k) => (x + (to?.p[k] ?? 0)) / 2) ?? [];
        mean += (((from?.u ?? 0) + (to?.u ?? 0)) / 2 - exact(middle)) ** 2 / 6;
      }
    sum += volume * mean;
  }
  return Math.sqrt(sum);
}

describe("heat", () => {
  it("is linear between two given temperatures, on any mesh", () => {
    const mesh = box([4, 3, 3], [2, 1, 1], 0.4);
    const conditions = new Map<number, ScalarCondition>([
      [0, { kind: "value", value: 10 }],
      [1, { kind: "value", value: 30 }],
    ]);
    const solution = solveProblem(mesh, heat({ conductivity: 5, conditions }));
    const expected = positionsOf(mesh).map(([x]) => 10 + 10 * x);
    expect(largestDifference(solution.fields[0]?.values ?? [], expected)).toBeLessThan(1e-7);
    const flux = solution.fields[1]?.values ?? new Float64Array();
    expect(
      largestDifference(
        flux,
        positionsOf(mesh).flatMap(() => [-50, 0, 0]),
      ),
    ).toBeLessThan(1e-5);
  });

  it("takes an inward flux", () => {
    const mesh = box([3, 3, 5], [1, 1, 2], 0.3);
    const conditions = new Map<number, ScalarCondition>([
      [4, { kind: "value", value: 0 }],
      [5, { kind: "flux", value: 6 }],
    ]);
    const expected = positionsOf(mesh).map(([, , z]) => 3 * z);
    expect(largestDifference(fieldOf(mesh, heat({ conductivity: 2, conditions })), expected)).toBeLessThan(
      1e-7,
    );
  });

  it("has an error in L2 of order 2", () => {
    // −Δu = 3π² u with u = sin πx sin πy sin πz.
    const exact = ([x = 0, y = 0, z = 0]: readonly number[]): number =>
      Math.sin(Math.PI * x) * Math.sin(Math.PI * y) * Math.sin(Math.PI * z);
    const errors = [3, 6, 12].map((count) => {
      const mesh = box([count, count, count]);
      const { system, unknowns } = assembleScalar(mesh, heat({ conditions: everywhere(0) }), null);
      // The source of a node is its value times the volume around the node.
      const volume = assembleScalar(mesh, heat({ source: 1 }), null).system.rightSide;
      positionsOf(mesh).forEach((p, n) => {
        system.rightSide[n] = 3 * Math.PI ** 2 * exact(p) * (volume[n] ?? 0);
      });
      conjugateGradients(system, unknowns);
      return l2Error(mesh, unknowns, exact);
    });
    const orders = errors.slice(1).map((error, i) => Math.log2((errors[i] ?? 0) / error));
    expect(orders.at(-1)).toBeGreaterThan(1.8);
    expect(orders.at(-1)).toBeLessThan(2.3);
  });

  it("refuses a mesh without a given temperature, or with a piece without one", () => {
    const conditions = new Map<number, ScalarCondition>([[0, { kind: "flux", value: 1 }]]);
    const mesh = box([1, 1, 1]);
    const failure = (given: SolvedMesh, map: typeof conditions): unknown => {
      try {
        return solveProblem(given, heat({ conditions: map }));
      } catch (error) {
        return error instanceof SolveError ? error.failure : error;
      }
    };
    expect(failure(mesh, conditions)).toBe("not-held");
    const count = mesh.points.length / 3;
    const twice: SolvedMesh = {
      ...mesh,
      points: Float64Array.from([...mesh.points, ...mesh.points.map((x) => x + 5)]),
      tetrahedra: Uint32Array.from([...mesh.tetrahedra, ...mesh.tetrahedra.map((n) => n + count)]),
    };
    expect(failure(twice, new Map([[0, { kind: "value", value: 1 }]]))).toBe("not-held");
    expect(() => solveProblem(mesh, heat({ conductivity: 0, conditions: everywhere(1) }))).toThrow(
      "bad-material",
    );
    expect(() => solveProblem({ ...mesh, tetrahedra: new Uint32Array() }, heat({}))).toThrow("no-elements");
  });

  it("needs fewer steps from a similar start", () => {
    const mesh = box([6, 6, 6]);
    const problem = heat({ source: 1, conditions: everywhere(0) });
    const first = solveProblem(mesh, problem);
    const start = first.fields[0]?.values.slice() ?? null;
    expect(first.iterations).toBeGreaterThan(5);
    expect(solveProblem(mesh, problem, start).iterations).toBeLessThan(3);
  });
});

describe("given values", () => {
  it("of two patches at a node do not depend on the order of the triangles", () => {
    const mesh = box([2, 2, 2]);
    const reversed: SolvedMesh = {
      ...mesh,
      triangles: mesh.triangles.toReversed(),
      trianglePatch: mesh.trianglePatch.toReversed(),
    };
    const conditions = new Map<number, ScalarCondition>(
      [0, 1, 2, 3, 4, 5].map((side) => [side, { kind: "value", value: 10 + side }]),
    );
    const values = fieldOf(mesh, heat({ conditions }));
    expect(fieldOf(reversed, heat({ conditions }))).toEqual(values);
    // The first node is a corner of the patches 0, 2 and 4.
    expect(values[0]).toBe(14);
  });

  it("of zero have the solution zero, whatever the start", () => {
    const mesh = box([3, 3, 3]);
    const start = Float64Array.from({ length: mesh.points.length / 3 }, (_, n) => n + 1);
    for (const problem of [
      heat({ conditions: everywhere(0) }),
      {
        kind: "advection",
        diffusivity: 1,
        velocity: [1, 0, 0],
        source: 0,
        conditions: everywhere(0),
      } as const,
    ]) {
      const { fields, iterations } = solveProblem(mesh, problem, start);
      expect(new Set(fields[0]?.values)).toEqual(new Set([0]));
      expect(iterations).toBe(0);
    }
  });
});

describe("the matrices", () => {
  /** Returns the product with unit vectors: the columns of the matrix. */
  const dense = ({ matrix }: ReturnType<typeof assembleScalar>["system"]): number[][] =>
    Array.from({ length: matrix.order }, (_, j) => {
      const unit = new Float64Array(matrix.order);
      unit[j] = 1;
      const column = new Float64Array(matrix.order);
      matrix.multiply(unit, column);
      return [...column];
    });

  /** Returns whether a Cholesky factorization exists. */
  function isPositive(matrix: number[][]): boolean {
    const a = matrix.map((row) => [...row]);
    for (let k = 0; k < a.length; ++k) {
      const pivot = a[k]?.[k] ?? 0;
      if (!(pivot > 1e-12)) return false;
      for (let i = k + 1; i < a.length; ++i) {
        const factor = (a[i]?.[k] ?? 0) / pivot;
        for (let j = k; j < a.length; ++j)
          (a[i] as number[])[j] = (a[i]?.[j] ?? 0) - factor * (a[k]?.[j] ?? 0);
      }
    }
    return true;
  }

  it.each([
    ["heat", (mesh: SolvedMesh) => assembleScalar(mesh, heat({ conditions: everywhere(0) }), null)],
    [
      "elasticity",
      (mesh: SolvedMesh) =>
        assembleElasticity(mesh, elastic({ conditions: new Map([[0, { kind: "fixed" }]]) }), null),
    ],
  ])("of %s are symmetric, and positive where nothing is given", (_, assemble) => {
    const { system } = assemble(box([2, 2, 3], [1, 2, 1], 0.3));
    const columns = dense(system);
    const scale = Math.max(...columns.flat());
    columns.forEach((column, j) =>
      column.forEach((entry, i) =>
        expect(Math.abs(entry - (columns[i]?.[j] ?? 0))).toBeLessThan(1e-12 * scale),
      ),
    );
    const free = columns
      .filter((_column, j) => system.isGiven[j] === 0)
      .map((column) => column.filter((_entry, i) => system.isGiven[i] === 0));
    expect(free.length).toBeGreaterThan(1);
    expect(isPositive(free)).toBe(true);
    // With nothing given, a constant is in the kernel.
    expect(isPositive(columns)).toBe(false);
  });
});

describe("elasticity", () => {
  it("stretches a bar as Hooke's law says", () => {
    // Only u_x is given at x = 0 in theory; with all displacements given there and no lateral contraction the law is exact.
    const mesh = box([6, 2, 2], [3, 1, 1], 0.3);
    const problem = elastic({
      poissonRatio: 0,
      conditions: new Map([
        [0, { kind: "fixed" }],
        [1, { kind: "traction", traction: [10, 0, 0] }],
      ]),
    });
    const expected = positionsOf(mesh).flatMap(([x]) => [(10 / 200) * x, 0, 0]);
    expect(largestDifference(fieldOf(mesh, problem), expected)).toBeLessThan(1e-7);
    expect(
      largestDifference(
        fieldOf(mesh, problem, 1),
        positionsOf(mesh).map(() => 10),
      ),
    ).toBeLessThan(1e-5);
  });

  it("reproduces any linear displacement that is given at the boundary", () => {
    const mesh = box([3, 3, 3], [1, 1, 1], 0.4);
    const { system } = assembleElasticity(mesh, elastic({}), null);
    const linear = ([x, y, z]: readonly [number, number, number]): number[] => [
      0.1 * x - 0.2 * y + 0.05,
      0.3 * z + 0.1 * x,
      -0.15 * x + 0.2 * y - 0.3 * z,
    ];
    const expected = positionsOf(mesh).flatMap(linear);
    const isOnSide = positionsOf(mesh).map((p) => p.some((x) => x === 0 || x === 1));
    const isGiven = Uint8Array.from(expected, (_, i) => Number(isOnSide[Math.floor(i / 3)]));
    const x = Float64Array.from(expected, (value, i) => (isGiven[i] === 1 ? value : 0));
    conjugateGradients({ ...system, isGiven }, x);
    expect(isGiven.includes(0)).toBe(true);
    expect(largestDifference(x, expected)).toBeLessThan(1e-8);
  });

  it("bends a cantilever towards the beam's deflection as the mesh is refined", () => {
    const [length, load] = [8, 0.02];
    // Euler and Bernoulli: F L³ / 3EI with I = 1/12, plus the shear of Timoshenko: F L / (5/6 G).
    const beam = (load * length ** 3) / (3 * 200 * (1 / 12)) + (load * length) / ((5 / 6) * 100);
    const tip = (n: number): number => {
      const mesh = box([8 * n, n, n], [length, 1, 1]);
      const problem = elastic({
        poissonRatio: 0,
        conditions: new Map([
          [0, { kind: "fixed" }],
          [1, { kind: "traction", traction: [0, 0, -load] }],
        ]),
      });
      return -Math.min(...fieldOf(mesh, problem));
    };
    const [coarse, middle, fine] = [tip(1), tip(2), tip(4)];
    // Linear elements are too stiff in bending: the deflection grows towards the limit, and the error falls by four.
    expect(coarse).toBeLessThan(middle);
    expect(middle).toBeLessThan(fine);
    expect(fine / beam).toBeGreaterThan(0.8);
    expect(fine / beam).toBeLessThan(1.01);
    expect((beam - middle) / (beam - fine)).toBeGreaterThan(2.5);
  });

  it("does not solve a body that can move", () => {
    const conditions = new Map([[1, { kind: "traction", traction: [1, 0, 0] } as const]]);
    expect(() => solveProblem(box([1, 1, 1]), elastic({ conditions }))).toThrow("not-held");
    const held = new Map([[1, { kind: "fixed" } as const]]);
    expect(() => solveProblem(box([1, 1, 1]), elastic({ poissonRatio: 0.5, conditions: held }))).toThrow(
      "bad-material",
    );
  });
});

describe("advection and diffusion", () => {
  const ends = new Map<number, ScalarCondition>([
    [0, { kind: "value", value: 0 }],
    [1, { kind: "value", value: 1 }],
  ]);

  it("has the exact layer at nodes of a fine mesh", () => {
    const mesh = box([32, 1, 1], [1, 0.1, 0.1]);
    const problem = {
      kind: "advection",
      diffusivity: 0.1,
      velocity: [1, 0, 0],
      source: 0,
      conditions: ends,
    } as const;
    const expected = positionsOf(mesh).map(([x]) => Math.expm1(x / 0.1) / Math.expm1(10));
    expect(largestDifference(fieldOf(mesh, problem), expected)).toBeLessThan(0.02);
  });

  it("hardly oscillates in front of a layer that the mesh does not resolve", () => {
    const mesh = box([10, 2, 2], [1, 0.2, 0.2]);
    const problem = {
      kind: "advection",
      diffusivity: 1e-4,
      velocity: [1, 0, 0],
      source: 0,
      conditions: ends,
    } as const;
    const values = fieldOf(mesh, problem);
    const before = positionsOf(mesh).flatMap(([x], n) => (x < 0.85 ? [values[n] ?? 0] : []));
    // Without upwinding, the values in front of the layer are as large as those in it.
    expect(Math.max(...before.map(Math.abs))).toBeLessThan(0.2);
  });

  it("carries a linear concentration with its source exactly", () => {
    const mesh = box([3, 3, 3], [1, 1, 1], 0.3);
    const conditions = new Map<number, ScalarCondition>([[0, { kind: "value", value: 0 }]]);
    // v·∇c = 2 for c = x, and the outflow has the diffusive flux k.
    conditions.set(1, { kind: "flux", value: 0.5 });
    const problem = {
      kind: "advection",
      diffusivity: 0.5,
      velocity: [2, 0, 0],
      source: 2,
      conditions,
    } as const;
    const expected = positionsOf(mesh).map(([x]) => x);
    expect(largestDifference(fieldOf(mesh, problem), expected)).toBeLessThan(1e-7);
  });

  it("agrees with conjugate gradients where both apply", () => {
    const mesh = box([4, 4, 4], [1, 1, 1], 0.3);
    const { system, unknowns } = assembleScalar(mesh, heat({ source: 3, conditions: everywhere(2) }), null);
    const other = unknowns.slice();
    conjugateGradients(system, unknowns);
    stabilizedBiconjugateGradients(system, other);
    expect(largestDifference(unknowns, other)).toBeLessThan(1e-8);
  });
});

describe("the solver's worker", () => {
  const mesh = box([2, 2, 2]);
  const request = { mesh, problem: heat({ source: 1, conditions: everywhere(0) }), start: null };

  /** A worker in this thread, which answers after a turn, or never. */
  function port(isSilent = false): WorkerPort & { terminated: number } {
    const worker: WorkerPort & { terminated: number } = {
      terminated: 0,
      onmessage: null,
      onerror: null,
      terminate: () => void worker.terminated++,
      postMessage: (message: Message) => {
        if (isSilent || !("name" in message)) return;
        const { id, argument } = message;
        const { problem, start, mesh: given } = argument as typeof request;
        let reply: Reply;
        try {
          reply = { kind: "answer", id, answer: solveProblem(given, problem, start) };
        } catch (error) {
          reply = { kind: "failure", id, message: String((error as Error).message) };
        }
        setTimeout(() => {
          worker.onmessage?.call(worker as unknown as Worker, new MessageEvent("message", { data: reply }));
        });
      },
    };
    return worker;
  }

  it("answers as the solver does, and leaves the mesh to the caller", async () => {
    const client = new SolveClient(() => port());
    const { fields } = await client.solve(request, new AbortController().signal);
    expect(fields[0]?.values).toEqual(fieldOf(mesh, request.problem));
    expect(mesh.points.length).toBe(81);
  });

  it("rejects with why a problem has no solution", async () => {
    const client = new SolveClient(() => port());
    const free = { ...request, problem: heat({ source: 1 }) };
    const failed = client.solve(free, new AbortController().signal);
    await expect(failed).rejects.toThrow(SolveError);
    await expect(failed).rejects.toMatchObject({ failure: "not-held" });
  });

  it("stops at once if it is cancelled", async () => {
    const silent = port(true);
    const client = new SolveClient(() => silent);
    const abort = new AbortController();
    const solving = client.solve(request, abort.signal);
    setTimeout(() => abort.abort(new Error("stopped by the user")), 20);
    await expect(solving).rejects.toThrow("stopped by the user");
    expect(silent.terminated).toBe(1);
  });
});
