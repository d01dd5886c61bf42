/** Meshes of the plate by the engine's front in the plane: even, finer around a spot, or of needles; with a given number of triangles. */
import type { PlaneFront } from "tetrafront/trace";
import type { PlanePoint } from "../../kit/plane-view";
import type { TriangleMesh } from "./elasticity";
import type { Hole } from "./exact-plate";

/** The plate goes from minus these coordinates to these. */
export const plate: PlanePoint = [0.9, 0.5];
/** Limits of the half axes of the hole, and its least distance from the edges of the plate. */
export const holeLimits = { a: [0.03, 0.3], b: [0.03, 0.3], margin: 0.06 } as const;
/** Radius of the spot that is fine, and growth of the sizes around it. */
export const spotRadius = 0.05;
const spotGrowth = 0.35;

export interface MeshPlan {
  readonly hole: Hole;
  /** Number of triangles. */
  readonly count: number;
  /** The place where triangles are small, and how many times smaller than far away. */
  readonly spot?: { readonly at: PlanePoint; readonly factor: number };
  /** Length / width of all triangles, and the direction of their length, in degrees. */
  readonly needles?: { readonly stretch: number; readonly angle: number };
}

export interface PlateMesh extends TriangleMesh {
  /** Nodes on the edge of the hole. */
  readonly onHole: ReadonlySet<number>;
}

/** Returns a hole within its limits. */
export function withinPlate({ at, a, b }: Hole): Hole {
  const clamp = (x: number, min: number, max: number): number => Math.min(max, Math.max(min, x));
  const [da, db] = [clamp(a, ...holeLimits.a), clamp(b, ...holeLimits.b)];
  const [dx, dy] = [plate[0] - holeLimits.margin - da, plate[1] - holeLimits.margin - db];
  return { at: [clamp(at[0], -dx, dx), clamp(at[1], -dy, dy)], a: da, b: db };
}

/** Rounds of fills until the number of triangles is met within this share. */
const maxRounds = 5;
const closeEnough = 0.02;

/** Returns a mesh with about as many triangles as planned. */
export function meshPlate(front: PlaneFront, plan: MeshPlan): PlateMesh {
  let size = expectedSize(plan);
  let best: { readonly mesh: PlateMesh; readonly miss: number } | null = null;
  let before: { size: number; count: number } | null = null;
  for (let round = 0; round < maxRounds; round++) {
    const mesh = fillPlate(front, plan, size);
    const count = mesh.triangles.length / 3;
    const miss = Math.abs(count / plan.count - 1);
    if (!best || miss < best.miss) best = { mesh, miss };
    if (miss <= closeEnough) break;
    // Where sizes are even, the count is as size^-2; where they grow from a spot, it depends less on the size.
    const measured = before ? Math.log(count / before.count) / Math.log(size / before.size) : -2;
    const power = Math.min(-0.6, Math.max(-2.5, Number.isNaN(measured) ? -2 : measured));
    before = { size, count };
    size *= (plan.count / count) ** (1 / power);
  }
  if (!best) throw new Error("No mesh was made.");
  return best.mesh;
}

/** Returns the size at a distance from the middle of a spot, for a size far from it. */
const sizeAway = (factor: number, size: number, distance: number): number =>
  Math.min(size, size / factor + spotGrowth * Math.max(0, distance - spotRadius));

/** Returns the size at a position, for a size far from the spot. */
const sizeAt = ({ spot }: MeshPlan, size: number, [x, y]: PlanePoint): number =>
  spot ? sizeAway(spot.factor, size, Math.hypot(x - spot.at[0], y - spot.at[1])) : size;

/** Returns the size for which triangles with equal sides would be as many as planned. */
function expectedSize(plan: MeshPlan): number {
  const perArea = 4 / Math.sqrt(3);
  const even = Math.sqrt((perArea * (4 * plate[0] * plate[1])) / plan.count);
  const { spot } = plan;
  if (!spot) return even;
  const cells = [60, 34] as const;
  const step = [(2 * plate[0]) / cells[0], (2 * plate[1]) / cells[1]] as const;
  const distances = new Float64Array(cells[0] * cells[1]);
  for (let i = 0; i < distances.length; i++) {
    const x = ((i % cells[0]) + 0.5) * step[0] - plate[0];
    const y = (Math.floor(i / cells[0]) + 0.5) * step[1] - plate[1];
    distances[i] = Math.hypot(x - spot.at[0], y - spot.at[1]);
  }
  const countFor = (size: number): number => {
    let count = 0;
    for (const distance of distances) count += 1 / sizeAway(spot.factor, size, distance) ** 2;
    return perArea * step[0] * step[1] * count;
  };
  let [low, high] = [even, even * spot.factor];
  for (let round = 0; round < 14; round++) {
    const middle = Math.sqrt(low * high);
    if (countFor(middle) > plan.count) low = middle;
    else high = middle;
  }
  return Math.sqrt(low * high);
}

/** Returns the mesh for a size far from the spot. */
function fillPlate(front: PlaneFront, plan: MeshPlan, size: number): PlateMesh {
  const { to, back } = stretchOf(plan);
  const spot = plan.spot;
  const [x, y] = plate;
  const walls = [
    [-x, -y],
    [x, -y],
    [x, y],
    [-x, y],
  ] as readonly PlanePoint[];
  const rim = dividedHole(plan.hole, to, (at) => sizeAt(plan, size, at));
  const sizes = {
    size,
    sources: spot
      ? [{ position: spot.at, size: size / spot.factor, distance: spotRadius, growth: spotGrowth }]
      : [],
  };
  const filled = front.fill([walls.map(to), rim.map(to)], sizes, {
    improve: plan.needles === undefined || plan.needles.stretch < 1.5,
  });
  if (!filled.success) throw new Error(filled.message);
  const points = Float64Array.from(filled.mesh.points);
  for (let i = 0; i < points.length; i += 2) points.set(back([points[i] ?? 0, points[i + 1] ?? 0]), i);
  return { points, triangles: filled.mesh.triangles, onHole: nodesOn(points, rim) };
}

/** The plate is stretched, filled with even triangles, and stretched back: what was even becomes a needle. */
function stretchOf({ needles }: MeshPlan): Record<"to" | "back", (point: PlanePoint) => PlanePoint> {
  if (!needles) return { to: (point) => point, back: (point) => point };
  const angle = (needles.angle * Math.PI) / 180;
  const [c, s] = [Math.cos(angle), Math.sin(angle)];
  const by = Math.sqrt(needles.stretch);
  const along =
    (factor: number) =>
    ([x, y]: PlanePoint): PlanePoint => {
      const [u, v] = [(x * c + y * s) / factor, (y * c - x * s) * factor];
      return [u * c - v * s, u * s + v * c];
    };
  return { to: along(by), back: along(1 / by) };
}

/** Corners of the hole for sizes of the mesh, the first one at its top: as many as fit, at least six. */
function dividedHole(
  { at, a, b }: Hole,
  to: (point: PlanePoint) => PlanePoint,
  sizeNear: (at: PlanePoint) => number,
): readonly PlanePoint[] {
  const samples = 1440;
  const point = (i: number): PlanePoint => {
    const angle = Math.PI / 2 + (2 * Math.PI * i) / samples;
    return [at[0] + a * Math.cos(angle), at[1] + b * Math.sin(angle)];
  };
  const sides = [0];
  let [last, mapped] = [point(0), to(point(0))];
  for (let i = 1; i <= samples; i++) {
    const next = point(i);
    const image = to(next);
    const size = sizeNear([(last[0] + next[0]) / 2, (last[1] + next[1]) / 2]);
    sides.push((sides.at(-1) ?? 0) + Math.hypot(image[0] - mapped[0], image[1] - mapped[1]) / size);
    [last, mapped] = [next, image];
  }
  const total = sides.at(-1) ?? 0;
  const count = Math.max(6, Math.round(total));
  const rim: PlanePoint[] = [];
  for (let i = 0; i < samples && rim.length < count; i++)
    if ((sides[i + 1] ?? 0) > (rim.length * total) / count + 1e-9 || rim.length === 0) rim.push(point(i));
  return rim;
}

function nodesOn(points: Float64Array, rim: readonly PlanePoint[]): ReadonlySet<number> {
  const found = new Set<number>();
  const [low, high] = [0, 1].map((axis) => {
    const all = rim.map((point) => point[axis] ?? 0);
    return [Math.min(...all) - 1e-6, Math.max(...all) + 1e-6] as const;
  }) as [readonly [number, number], readonly [number, number]];
  for (let node = 0; node < points.length / 2; node++) {
    const [x, y] = [points[2 * node] ?? 0, points[2 * node + 1] ?? 0];
    if (x < low[0] || x > low[1] || y < high[0] || y > high[1]) continue;
    if (rim.some((from, i) => isBetween([x, y], from, rim[(i + 1) % rim.length] ?? from))) found.add(node);
  }
  return found;
}

function isBetween([x, y]: PlanePoint, from: PlanePoint, to: PlanePoint): boolean {
  const [dx, dy] = [to[0] - from[0], to[1] - from[1]];
  const length = Math.hypot(dx, dy);
  const across = Math.abs((x - from[0]) * dy - (y - from[1]) * dx) / length;
  const along = ((x - from[0]) * dx + (y - from[1]) * dy) / (length * length);
  return across < 1e-6 && along > -1e-6 && along < 1 + 1e-6;
}
