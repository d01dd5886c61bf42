import type { Position } from "../position";
import { cornerOf, windingNumber, type Triangles } from "../winding-number";
import { boxOf } from "../vectors";

/** Orients closed surfaces. */

export interface OrientedSurface {
  /** Counter-clockwise as seen from outside the solid: the triangles of an inner shell, from its cavity. */
  readonly triangles: Uint32Array;
  /** Whether a component lies within another. */
  readonly hasInnerShells: boolean;
  /** Whether a component within another one was given facing the same way: both bound bodies. */
  readonly hasInnerBodies: boolean;
}

/**
 * Orients the boundary of a solid; null if the surface is not closed, or not every edge has exactly two triangles. Each
 * component is turned outward by the sign of its own volume, then those at an odd depth of nesting are turned inward.
 * O(triangles) per component within the boxes of others.
 */
export function orientedSurface(points: Float64Array, triangles: Uint32Array): OrientedSurface | null {
  const count = triangles.length / 3;
  const neighbours = neighboursOf(triangles);
  if (count === 0 || !neighbours) return null;
  const oriented = triangles.slice();
  const visited = new Uint8Array(count);
  const components: number[][] = [];
  const facesInward: boolean[] = [];
  for (let seed = 0; seed < count; ++seed) {
    if (visited[seed]) continue;
    const component = orientedFrom(seed, triangles, oriented, neighbours, visited);
    if (!component) return null;
    const volume = component.reduce((sum, triangle) => sum + volumeBelow(points, oriented, triangle), 0);
    facesInward.push(volume < 0);
    if (volume < 0) for (const triangle of component) flip(oriented, triangle);
    components.push(component);
  }
  const depths = depthsOf(components.map((component) => shellOf(points, oriented, component)));
  components.forEach((component, index) => {
    if ((depths[index] ?? 0) % 2 === 1) for (const triangle of component) flip(oriented, triangle);
  });
  const isInverted = facesInward[depths.indexOf(0)];
  return {
    triangles: oriented,
    hasInnerShells: depths.some((depth) => depth > 0),
    hasInnerBodies: depths.some((depth, index) => depth % 2 === 1 && facesInward[index] === isInverted),
  };
}

/** A component, with its own nodes only. */
function shellOf(points: Float64Array, triangles: Uint32Array, component: readonly number[]): Triangles {
  const corners = component.flatMap((triangle) => [...triangles.subarray(3 * triangle, 3 * triangle + 3)]);
  const own = Float64Array.from(corners.flatMap((node) => cornerOf(points, node)));
  return { points: own, triangles: Uint32Array.from(corners, (_, corner) => corner) };
}

/** Returns within how many of the others each shell lies. All shells are oriented outward and do not cross. */
function depthsOf(shells: readonly Triangles[]): number[] {
  const boxes = shells.map(({ points }) => boxOf(points));
  return shells.map((shell, inner) => {
    // In the middle of a triangle: another shell may touch a node.
    const place = middleOfFirst(shell);
    return shells.filter((other, index) => {
      const box = boxes[index];
      if (index === inner || !box) return false;
      const isWithinBox = place.every((x, k) => x > (box.low[k] ?? x) && x < (box.high[k] ?? x));
      return isWithinBox && windingNumber(other, place) > 0.5;
    }).length;
  });
}

const middleOfFirst = ({ points }: Triangles): Position => {
  const [a, b, c] = [0, 1, 2].map((node) => cornerOf(points, node));
  return [0, 1, 2].map((k) => ((a?.[k] ?? 0) + (b?.[k] ?? 0) + (c?.[k] ?? 0)) / 3) as [
    number,
    number,
    number,
  ];
};

/** Returns the triangle beyond each edge, by 3 · triangle + edge; null if an edge has not exactly two triangles. */
function neighboursOf(triangles: Uint32Array): Int32Array | null {
  const open = new Map<string, number>();
  const neighbours = new Int32Array(triangles.length).fill(-1);
  const closed = new Set<string>();
  for (let half = 0; half < triangles.length; ++half) {
    const [a, b] = endsOf(triangles, half);
    const key = a < b ? `${a} ${b}` : `${b} ${a}`;
    if (closed.has(key) || a === b) return null;
    const other = open.get(key);
    if (other === undefined) open.set(key, half);
    else {
      open.delete(key);
      closed.add(key);
      neighbours[half] = other;
      neighbours[other] = half;
    }
  }
  return open.size === 0 ? neighbours : null;
}

function endsOf(triangles: Uint32Array, half: number): readonly [number, number] {
  const base = 3 * Math.floor(half / 3);
  return [triangles[half] ?? 0, triangles[base + ((half + 1) % 3)] ?? 0];
}

/** Orients the component of a triangle like it. Returns its triangles; null if it has only one side. */
function orientedFrom(
  seed: number,
  given: Uint32Array,
  oriented: Uint32Array,
  neighbours: Int32Array,
  visited: Uint8Array,
): number[] | null {
  const flipped = new Set<number>();
  const component = [seed];
  visited[seed] = 1;
  for (const triangle of component) {
    for (let edge = 0; edge < 3; ++edge) {
      const half = 3 * triangle + edge;
      const across = neighbours[half] ?? 0;
      const other = Math.floor(across / 3);
      // In the same direction, the two triangles have opposite orientations.
      const isOpposite = endsOf(given, half)[0] === endsOf(given, across)[0];
      const isFlipped = flipped.has(triangle) !== isOpposite;
      if (visited[other]) {
        if (flipped.has(other) !== isFlipped) return null;
        continue;
      }
      visited[other] = 1;
      if (isFlipped) flipped.add(other);
      component.push(other);
    }
  }
  for (const triangle of flipped) flip(oriented, triangle);
  return component;
}

function flip(triangles: Uint32Array, triangle: number): void {
  const [b = 0, c = 0] = triangles.subarray(3 * triangle + 1, 3 * triangle + 3);
  triangles[3 * triangle + 1] = c;
  triangles[3 * triangle + 2] = b;
}

/** Six times the signed volume between a triangle and the origin. */
function volumeBelow(points: Float64Array, triangles: Uint32Array, triangle: number): number {
  const at = (corner: number, k: number): number =>
    points[3 * (triangles[3 * triangle + corner] ?? 0) + k] ?? 0;
  return (
    at(0, 0) * (at(1, 1) * at(2, 2) - at(1, 2) * at(2, 1)) +
    at(0, 1) * (at(1, 2) * at(2, 0) - at(1, 0) * at(2, 2)) +
    at(0, 2) * (at(1, 0) * at(2, 1) - at(1, 1) * at(2, 0))
  );
}
