/** Closed triangle surfaces for tests, oriented outward. */
import type { SurfaceInput } from "tetrafront";

type Triple = readonly [number, number, number];

/** Returns the surface of a box from `low` to `high` with n × n squares of two triangles per face, welded. */
export function boxSurface(n: number, low: Triple = [0, 0, 0], high: Triple = [1, 1, 1]): SurfaceInput {
  return latticeSurface(n, low, high, [0, n]);
}

/** Returns the unit cube with an interface across the middle of the x axis; n is even. */
export function dividedSurface(n: number): SurfaceInput {
  return latticeSurface(n, [0, 0, 0], [1, 1, 1], [0, n / 2, n]);
}

/** Returns the faces of a box; across x, the lattice planes at `levels`, from 0 to n. */
function latticeSurface(n: number, low: Triple, high: Triple, levels: readonly number[]): SurfaceInput {
  const builder = new SurfaceBuilder();
  const at = (i: Triple): Triple => [
    low[0] + ((high[0] - low[0]) * i[0]) / n,
    low[1] + ((high[1] - low[1]) * i[1]) / n,
    low[2] + ((high[2] - low[2]) * i[2]) / n,
  ];
  for (let axis = 0; axis < 3; axis++) {
    for (const end of axis === 0 ? levels : [0, n]) {
      // The other two axes in cyclic order: their cross product points along `axis`.
      const position = (u: number, v: number): Triple => {
        const index = [0, 0, 0];
        index[axis] = end;
        index[(axis + 1) % 3] = u;
        index[(axis + 2) % 3] = v;
        return at([index[0] ?? 0, index[1] ?? 0, index[2] ?? 0]);
      };
      for (let u = 0; u < n; u++) {
        for (let v = 0; v < n; v++) {
          builder.quad(
            [position(u, v), position(u + 1, v), position(u + 1, v + 1), position(u, v + 1)],
            end === 0,
          );
        }
      }
    }
  }
  return builder.surface();
}

/** Returns a sphere, made from a cube with n × n squares per face. */
export function sphereSurface(n: number, radius = 1, center: Triple = [0, 0, 0]): SurfaceInput {
  const { points, triangles } = boxSurface(n, [-1, -1, -1], [1, 1, 1]);
  const round = points.slice();
  for (let i = 0; i < points.length; i += 3) {
    // Equal angles instead of equal lengths give similar triangles.
    const p = [0, 1, 2].map((axis) => Math.tan(((points[i + axis] ?? 0) * Math.PI) / 4));
    const length = Math.hypot(...p);
    p.forEach((value, axis) => (round[i + axis] = (center[axis] ?? 0) + (radius * value) / length));
  }
  return { points: round, triangles };
}

/** Returns a torus around the z axis with n sections of m nodes. */
export function torusSurface(n: number, m: number, radius = 1, thickness = 0.4): SurfaceInput {
  const builder = new SurfaceBuilder();
  const at = (i: number, j: number): Triple => {
    const u = (2 * Math.PI * (i % n)) / n;
    const v = (2 * Math.PI * (j % m)) / m;
    const r = radius + thickness * Math.cos(v);
    return [r * Math.cos(u), r * Math.sin(u), thickness * Math.sin(v)];
  };
  for (let i = 0; i < n; i++) {
    for (let j = 0; j < m; j++) builder.quad([at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)], false);
  }
  return builder.surface();
}

/**
 * Returns a rotated gear whose flat faces are triangulated into needles, by always cutting off the first ear.
 */
export function needleGearSurface(teeth: number, thickness = 0.05): SurfaceInput {
  const builder = new SurfaceBuilder();
  const outline = Array.from({ length: teeth * 6 }, (_, i): readonly [number, number] => {
    const radius = [0.8, 0.8, 0.95, 1, 1, 0.9][i % 6] ?? 1;
    const angle = (Math.PI * i) / (3 * teeth);
    return [radius * Math.cos(angle), radius * Math.sin(angle)];
  });
  const corner = (i: number): readonly [number, number] => outline[i % outline.length] ?? [0, 0];
  const position = (i: number, z: number): Triple => {
    const [x, y] = corner(i);
    return [0.36 * x + 0.48 * y - 0.8 * z, -0.8 * x + 0.6 * y, 0.48 * x + 0.64 * y + 0.6 * z];
  };
  const turn = (a: number, b: number, c: number): number => {
    const [ax, ay] = corner(a);
    const [bx, by] = corner(b);
    const [cx, cy] = corner(c);
    return (bx - ax) * (cy - ay) - (by - ay) * (cx - ax);
  };
  const rest = outline.map((_, i) => i);
  while (rest.length > 2) {
    const n = rest.length;
    const ear = (i: number): [number, number, number] => [
      rest[(i + n - 1) % n] ?? 0,
      rest[i] ?? 0,
      rest[(i + 1) % n] ?? 0,
    ];
    const first = rest.findIndex((_, i) => {
      const [a, b, c] = ear(i);
      const inside = (p: number): boolean => turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0;
      return turn(a, b, c) > 1e-12 && !rest.some((p) => p !== a && p !== b && p !== c && inside(p));
    });
    const [a, b, c] = ear(first);
    builder.triangle([position(a, thickness), position(b, thickness), position(c, thickness)]);
    builder.triangle([position(a, 0), position(c, 0), position(b, 0)]);
    rest.splice(first, 1);
  }
  for (let i = 0; i < outline.length; i++) {
    builder.quad(
      [position(i, 0), position(i + 1, 0), position(i + 1, thickness), position(i, thickness)],
      false,
    );
  }
  return builder.surface();
}

/** Returns a screw thread with long triangles along its flanks and `around` nodes per turn. */
export function screwThreadSurface(turns: number, around: number): SurfaceInput {
  const builder = new SurfaceBuilder();
  const depth = (turn: number): number => {
    const part = turn - Math.floor(turn);
    return Math.max(0, Math.min((part - 0.2) / 0.2, 1, (1 - part) / 0.2));
  };
  const at = (i: number, j: number): Triple => {
    const angle = (2 * Math.PI * (j % around)) / around;
    const radius = 0.5 + 0.15 * depth(i / 8 - (j % around) / around);
    return [radius * Math.cos(angle), radius * Math.sin(angle), 0.025 * i];
  };
  const rings = 8 * turns;
  for (let j = 0; j < around; j++) {
    for (let i = 0; i < rings; i++)
      builder.quad([at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j)], false);
    builder.triangle([[0, 0, 0], at(0, j + 1), at(0, j)]);
    builder.triangle([[0, 0, 0.025 * rings], at(rings, j), at(rings, j + 1)]);
  }
  return builder.surface();
}

/** Returns a cube of edge 2 around the origin with a spherical cavity. */
export function cavitySurface(n: number, cavityRadius = 0.5): SurfaceInput {
  const inside = sphereSurface(Math.max(2, Math.round((n * cavityRadius) / 1.2)), cavityRadius);
  return joined(boxSurface(n, [-1, -1, -1], [1, 1, 1]), turned(inside));
}

/**
 * Returns separate pairs of needles: triangles 2i and 2i + 1 intersect at (10 i, 0, 0) and do not intersect
 * any others.
 */
export function crossingNeedles(pairs: number): SurfaceInput {
  const pair = [0, -1, 0, 0, 1, -1e-3, 0, 1, 1e-3, -1, 0, 0, 1, -1e-3, 0, 1, 1e-3, 0];
  const points = new Float64Array(pair.length * pairs);
  for (let i = 0; i < points.length; i++) {
    const inPair = i % pair.length;
    points[i] = (pair[inPair] ?? 0) + (i % 3 === 0 ? 10 * Math.floor(i / pair.length) : 0);
  }
  return { points, triangles: Uint32Array.from({ length: points.length / 3 }, (_, node) => node) };
}

/** Returns the surface with the opposite orientation. */
export function turned({ points, triangles }: SurfaceInput): SurfaceInput {
  const other = triangles.slice();
  for (let t = 0; t < other.length; t += 3) other.subarray(t, t + 3).reverse();
  return { points: points.slice(), triangles: other };
}

/** Returns two surfaces as one, without welding them. */
export function joined(a: SurfaceInput, b: SurfaceInput): SurfaceInput {
  const shift = a.points.length / 3;
  return {
    points: Float64Array.of(...a.points, ...b.points),
    triangles: Uint32Array.of(...a.triangles, ...b.triangles.map((node) => node + shift)),
  };
}

/** Collects triangles and quads by the coordinates of their corners. */
class SurfaceBuilder {
  readonly #nodes = new Map<string, number>();
  readonly #points: number[] = [];
  readonly #triangles: number[] = [];

  triangle(corners: readonly [Triple, Triple, Triple]): void {
    this.#triangles.push(...corners.map((corner) => this.#node(corner)));
  }

  quad(corners: readonly [Triple, Triple, Triple, Triple], reversed: boolean): void {
    const [a, b, c, d] = corners.map((corner) => this.#node(corner)) as [number, number, number, number];
    this.#triangles.push(...(reversed ? [a, c, b, a, d, c] : [a, b, c, a, c, d]));
  }

  surface(): SurfaceInput {
    return { points: Float64Array.from(this.#points), triangles: Uint32Array.from(this.#triangles) };
  }

  #node(position: Triple): number {
    const key = position.map((value) => value + 0).join(" ");
    const known = this.#nodes.get(key);
    if (known !== undefined) return known;
    const node = this.#nodes.size;
    this.#nodes.set(key, node);
    this.#points.push(...position);
    return node;
  }
}

/** A block of 4 × 1 × 2 with a step across its top. */
export function steppedBlock(height: number): SurfaceInput {
  const outline = [0, 0, 4, 0, 4, 1, 2, 1, 2, 1 + height, 0, 1 + height];
  const corners = outline.length / 2;
  const points = [0, 2].flatMap((z) =>
    Array.from({ length: corners }, (_, i) => [outline[2 * i] ?? 0, outline[2 * i + 1] ?? 0, z]),
  );
  const triangles: number[] = [];
  for (let i = 0; i < corners; ++i) {
    const next = (i + 1) % corners;
    triangles.push(i, next, corners + next, i, corners + next, corners + i);
    if (i > 0 && next > 0) triangles.push(0, next, i, corners, corners + i, corners + next);
  }
  return { points: Float64Array.from(points.flat()), triangles: Uint32Array.from(triangles) };
}
