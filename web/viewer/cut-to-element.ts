import type { Elements } from "../document/mesh-quality";
import type { Position } from "../document/position";
import type { Cut, CutAxis } from "../document/selection";
import { unit } from "../document/vectors";
import { centroidsAlong, extentAlong } from "./queries/visible-faces";

const axes: readonly CutAxis[] = ["x", "y", "z"];
/** Share of the extent that a cut must leave: an element at the far side is shown with what lies beside it. */
const minRest = 0.02;
/** Smallest component of the direction to the viewer along the axis of a cut: its plane would be seen from the side. */
const minFacing = 0.25;
/** Share of the extent between a cut and the centroid of an element that it takes away: centroids have single precision. */
const margin = 1e-5;

/**
 * Returns the cut that exposes an element to a viewer in the direction `toEye`: across the axis that points most at the viewer
 * and leaves something behind the element. It takes away all elements that reach into the sight of the element and beyond its
 * far end, so that nothing covers it; the highlight draws the element itself. O(nodes + elements).
 */
export function cutToElement(mesh: Elements, element: number, toEye: Position): Cut {
  const limits = sightLimits(mesh, element, unit(toEye) ?? [0, 0, 1]);
  const facing = axes
    .map((axis, i) => ({ axis, towards: toEye[i] ?? 0, limit: limits[i] ?? 0 }))
    .toSorted((a, b) => Math.abs(b.towards) - Math.abs(a.towards));
  const cuts = facing.map(({ axis, towards, limit }) => {
    const flipped = towards < 0;
    const [low, high] = extentAlong(mesh.points, axis);
    const share = (value: number): number => (high > low ? (value - low) / (high - low) : 0.5);
    const position = Math.min(Math.max(share(limit) + (flipped ? margin : -margin), 0), 1);
    return {
      cut: { enabled: true, axis, flipped, position },
      share,
      rest: flipped ? 1 - position : position,
    };
  });
  const length = Math.hypot(...toEye);
  const seen = cuts.find(
    ({ rest }, i) => rest >= minRest && Math.abs(facing[i]?.towards ?? 0) >= minFacing * length,
  );
  if (seen) return seen.cut;
  const [first] = cuts;
  if (!first) throw new Error("There are three axes");
  const nodes = mesh.tetrahedra.subarray(4 * element, 4 * element + 4);
  const [centroid = 0] = centroidsAlong({ points: mesh.points, tetrahedra: nodes }, first.cut.axis);
  return { ...first.cut, position: first.share(centroid) };
}

/**
 * Returns per axis the coordinate beyond which, towards the viewer, elements must go that could cover an element: the far end of
 * the element, or the centroid of the farthest of those that reach into its sight and beyond its far end.
 */
function sightLimits({ points, tetrahedra }: Elements, element: number, toEye: Position): readonly number[] {
  const signs = toEye.map((x) => (x < 0 ? -1 : 1));
  const own = ballOf(points, tetrahedra, element);
  const end = (t: number, axis: number, pick: typeof Math.min): number => {
    const at = (corner: number): number =>
      (signs[axis] ?? 1) * (points[3 * (tetrahedra[4 * t + corner] ?? 0) + axis] ?? 0);
    return pick(at(0), at(1), at(2), at(3));
  };
  const ends = axes.map((_, axis) => end(element, axis, Math.min));
  const limits = ends.slice();
  for (let t = 0; 4 * t < tetrahedra.length; ++t) {
    const { centre, radius } = ballOf(points, tetrahedra, t);
    const reach = own.radius + radius;
    const [x, y, z] = [centre[0] - own.centre[0], centre[1] - own.centre[1], centre[2] - own.centre[2]];
    const ahead = x * toEye[0] + y * toEye[1] + z * toEye[2];
    if (t === element || ahead < -reach || x * x + y * y + z * z - ahead * ahead > reach * reach) continue;
    for (let axis = 0; axis < 3; axis++) {
      if (end(t, axis, Math.max) <= (ends[axis] ?? 0)) continue;
      limits[axis] = Math.min(limits[axis] ?? 0, (signs[axis] ?? 1) * (centre[axis] ?? 0));
    }
  }
  return limits.map((limit, axis) => (signs[axis] ?? 1) * limit);
}

/** Returns a ball around the centroid of a tetrahedron that holds it. */
function ballOf(points: Float64Array, tetrahedra: Uint32Array, t: number) {
  let [x, y, z] = [0, 0, 0];
  for (let i = 4 * t; i < 4 * t + 4; ++i) {
    const at = 3 * (tetrahedra[i] ?? 0);
    x += (points[at] ?? 0) / 4;
    y += (points[at + 1] ?? 0) / 4;
    z += (points[at + 2] ?? 0) / 4;
  }
  let squared = 0;
  for (let i = 4 * t; i < 4 * t + 4; ++i) {
    const at = 3 * (tetrahedra[i] ?? 0);
    const [a, b, c] = [(points[at] ?? 0) - x, (points[at + 1] ?? 0) - y, (points[at + 2] ?? 0) - z];
    squared = Math.max(squared, a * a + b * b + c * c);
  }
  const centre: Position = [x, y, z];
  return { centre, radius: Math.sqrt(squared) };
}
