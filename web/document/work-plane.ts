import type { Project } from "tetrafront/project";
import { findRecord, type Entity } from "./entities";
import { planeOfPatch } from "./patch-planes";
import type { Position } from "./position";
import { addScaled, cross, dot, frameAlong, scale, subtract, unit, type Frame } from "./vectors";

/** The plane in which the drawing tools place what they draw: x and y of the frame lie in it. */
export interface WorkPlane {
  /** The axes of coordinates that the plane is parallel to, or "free" for any other direction. */
  readonly kind: PrincipalPlane | "free";
  readonly frame: Frame;
}

export type PrincipalPlane = "xy" | "xz" | "yz";

export const principalPlanes: readonly PrincipalPlane[] = ["xy", "xz", "yz"];

const axes: { readonly [P in PrincipalPlane]: Omit<Frame, "origin"> } = {
  xy: { x: [1, 0, 0], y: [0, 1, 0], z: [0, 0, 1] },
  // The front view looks along +y: x to the right, z up.
  xz: { x: [1, 0, 0], y: [0, 0, 1], z: [0, -1, 0] },
  yz: { x: [0, 1, 0], y: [0, 0, 1], z: [1, 0, 0] },
};

/** Returns a plane of two axes, through a position. */
export function principalPlane(kind: PrincipalPlane, origin: Position = [0, 0, 0]): WorkPlane {
  return { kind, frame: { origin, ...axes[kind] } };
}

/**
 * Returns the plane through a position with a normal, which must not be zero. If the plane is parallel to two axes, its
 * frame has their directions. Otherwise, its origin is the position.
 */
export function planeAlong(normal: Position, through: Position): WorkPlane {
  const kind = principalPlanes.find(
    (plane) => Math.abs(dot(axes[plane].z, unit(normal) ?? normal)) > 1 - 1e-12,
  );
  // The grid of a principal plane contains round coordinates, so its origin lies on the normal through zero.
  if (kind) return principalPlane(kind, scale(axes[kind].z, dot(axes[kind].z, through)));
  return { kind: "free", frame: frameAlong(normal, through) };
}

/** Returns the plane through three positions; null if they lie on one line. */
export function planeThrough(a: Position, b: Position, c: Position): WorkPlane | null {
  const [u, v] = [subtract(b, a), subtract(c, a)];
  const normal = cross(u, v);
  const isFlat = dot(normal, normal) <= 1e-18 * dot(u, u) * dot(v, v);
  return isFlat ? null : planeAlong(normal, a);
}

/**
 * Returns the plane that a selection defines: of three points, of a planar patch, or parallel to `plane` through one
 * point; null for any other selection.
 */
export function planeOfSelection(
  project: Project,
  selection: readonly Entity[],
  plane: WorkPlane,
): WorkPlane | null {
  const [first, ...others] = selection;
  if (first?.kind === "patch" && others.length === 0) {
    const found = planeOfPatch(project, first.id);
    return found ? planeAlong(found.normal, found.corner) : null;
  }
  const positions = selection.flatMap(({ kind, id }) => {
    const point = kind === "point" ? findRecord(project, "point", id) : undefined;
    return point ? [point.position] : [];
  });
  const [a, b, c, d] = positions;
  if (positions.length !== selection.length || !a || d) return null;
  if (b && c) return planeThrough(a, b, c);
  return b ? null : { ...plane, frame: { ...plane.frame, origin: a } };
}

/** A half-line from the eye: the direction has any length above 0. */
export interface Ray {
  readonly origin: Position;
  readonly direction: Position;
}

/** Sine of the angle between ray and plane below which they count as parallel. */
const grazing = 0.01;

/** Returns where a ray meets a plane; null if it does not, or at a grazing angle. */
export function onPlane(ray: Ray, { origin, z }: Frame): Position | null {
  const direction = unit(ray.direction) ?? ray.direction;
  const slope = dot(direction, z);
  if (Math.abs(slope) < grazing) return null;
  const distance = dot(subtract(origin, ray.origin), z) / slope;
  return distance > 0 ? addScaled(ray.origin, direction, distance) : null;
}

/** Returns the place on a line that is nearest to a ray; null if they are nearly parallel. */
export function onLine(ray: Ray, through: Position, along: Position): Position | null {
  const [direction, axis] = [unit(ray.direction) ?? ray.direction, unit(along) ?? along];
  const apart = subtract(through, ray.origin);
  const cosine = dot(direction, axis);
  const sineSquared = 1 - cosine * cosine;
  if (sineSquared < grazing * grazing) return null;
  return addScaled(through, axis, (cosine * dot(apart, direction) - dot(apart, axis)) / sineSquared);
}

/** Returns the smallest of 1, 2 and 5 times a power of ten that is at least `least`. */
export function roundStep(least: number): number {
  const power = 10 ** Math.floor(Math.log10(least));
  const factor = [1, 2, 5].find((step) => step * power >= least * (1 - 1e-12)) ?? 10;
  // As a text, because 3 * 0.1 is not 0.3.
  return Number((factor * power).toPrecision(1));
}

/** Returns a multiple of a step, as the number that its shortest decimal notation stands for. */
export function roundTo(value: number, step: number): number {
  const digits = Math.max(0, -Math.floor(Math.log10(step)) + 1);
  return Number((Math.round(value / step) * step).toFixed(Math.min(100, digits))) + 0;
}
