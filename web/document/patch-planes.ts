import type { Project } from "tetrafront/project";
import { findRecord } from "./entities";
import { loopPolygon } from "./line-samples";
import type { Position } from "./position";
import { add, areaVector, cross, dot, mean, scale, subtract, unit, zero } from "./vectors";

/** The plane of a patch. */
export interface PatchPlane {
  /** Centroid of the area within the outer loop. */
  readonly centre: Position;
  /** Where the outer loop begins. */
  readonly corner: Position;
  /** Unit normal; the outer loop is counter-clockwise around it. */
  readonly normal: Position;
  /** The unit normal, or its opposite, that points away from the middle of the model. */
  readonly outward: Position;
}

/** Returns the plane of a planar patch; undefined for other patches and for loops without area. */
export function planeOfPatch(project: Project, id: number): PatchPlane | undefined {
  const patch = findRecord(project, "patch", id);
  return patch?.type === "planar" ? planeOfLoop(project, patch.loops[0] ?? []) : undefined;
}

/** Returns the plane that fits a loop best; undefined without area. */
export function planeOfLoop(project: Project, loop: readonly number[]): PatchPlane | undefined {
  const polygon = loopPolygon(project, loop);
  const normal = unit(areaVector(polygon));
  const [corner] = polygon;
  if (!normal || !corner) return undefined;
  const centre = centroid(polygon, normal);
  const middle = mean(project.points.map(({ position }) => position));
  const outward = dot(normal, subtract(centre, middle)) < 0 ? scale(normal, -1) : normal;
  return { centre, corner, normal, outward };
}

/** Returns the centroid of the area of a polygon, as the weighted mean of the triangles around its first corner. */
function centroid(polygon: readonly Position[], normal: Position): Position {
  const [first] = polygon;
  if (!first) return zero;
  let area = 0;
  let moment = zero;
  polygon.slice(1, -1).forEach((b, i) => {
    const c = polygon[i + 2] ?? first;
    const weight = dot(cross(subtract(b, first), subtract(c, first)), normal);
    area += weight;
    moment = add(moment, scale(add(add(first, b), c), weight / 3));
  });
  return scale(moment, 1 / area);
}
