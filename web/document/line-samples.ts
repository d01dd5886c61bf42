import type { LineType, Project, ProjectLine } from "tetrafront/project";
import { arcThrough, circleThrough, onArc } from "./arcs";
import { findRecord } from "./entities";
import type { Position } from "./position";
import { addScaled, scale } from "./vectors";

/**
 * Positions along lines, without the engine: for planes, areas and hits of patches. Splines and Hermite lines are
 * sampled at their points only.
 */

/** Sides per curved line. */
const sides = 32;

/** Returns the positions of the points of a line. */
export function linePositions(project: Project, { points }: Pick<ProjectLine, "points">): Position[] {
  return points.flatMap((id) => {
    const point = findRecord(project, "point", id);
    return point ? [point.position] : [];
  });
}

/** Returns positions along a line through the given points, both ends included. */
export function samplesAlong(type: LineType, points: readonly Position[]): readonly Position[] {
  const [a, b, c] = points;
  switch (type) {
    case "straight":
    case "spline":
    case "hermite":
      return points;
    case "parabolic":
      if (!a || !b || !c) return points;
      return shares.map((t) => {
        const s = 1 - t;
        return addScaled(addScaled(scale(a, s * (1 - 2 * t)), b, 4 * t * s), c, t * (2 * t - 1));
      });
    case "arc":
    case "circle": {
      if (!a || !b || !c) return points;
      const arc = type === "arc" ? arcThrough(a, b, c) : circleThrough(a, b, c);
      return arc ? shares.map((t) => onArc(arc, t)) : points;
    }
  }
}

/** From 0 to 1. */
const shares = Array.from({ length: sides + 1 }, (_, i) => i / sides);

/** Returns the polygon of a loop: positions along its lines, in its direction. The first one is not repeated. */
export function loopPolygon(project: Project, loop: readonly number[]): Position[] {
  return loop.flatMap((step) => {
    const line = findRecord(project, "line", Math.abs(step));
    if (!line) return [];
    const samples = samplesAlong(line.type, linePositions(project, line));
    return (step > 0 ? samples : samples.toReversed()).slice(0, -1);
  });
}
