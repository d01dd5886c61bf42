/** The front of a patch, filled with three rulers: lengths of the unit square, of the stretched square, and of space. */
import type { PlaneFront, PlaneNode } from "tetrafront/trace";
import type { Position } from "../../../../document/position";
import type { PlanePoint } from "../../kit/plane-view";
import { filmOf, type FrontFilm } from "../front/front-film";
import { anglesOf, type Metric, type SurfaceMaps } from "./surface-maps";

export const rulers = ["square", "plane", "space"] as const;
export type Ruler = (typeof rulers)[number];

/** Length of edges in space. */
export const targetSize = 0.2;
/** Nodes in a row of the grid on which the metric is given. */
const nodesPerRow = 13;

export interface FilledPatch {
  readonly film: FrontFilm;
  /** Nodes of the film in the unit square, and in space. */
  readonly unit: readonly PlanePoint[];
  readonly space: readonly Position[];
  /** Smallest angle in space, in degrees, and its triangle. */
  readonly worst: { readonly triangle: number; readonly angle: number };
  /** Smallest angle of each triangle in space, in degrees. */
  readonly smallest: readonly number[];
  /** Means of the smallest angles of all triangles: in the unit square, in the stretched square, and in space. */
  readonly means: Readonly<Record<Ruler, number>>;
}

/** Returns the patch filled with a ruler; null if the front cannot fill it. */
export function fillPatch(front: PlaneFront, maps: SurfaceMaps, ruler: Ruler): FilledPatch | null {
  const square: readonly PlanePoint[] = [
    [0, 0],
    [1, 0],
    [1, 1],
    [0, 1],
  ];
  const area = areaOf(maps);
  const loop = ruler === "square" ? square : maps.plane;
  // Without the metric, edges have the right length on average.
  const scale = Math.sqrt(area / (ruler === "square" ? 1 : (maps.yD * (maps.xB + maps.xC - maps.xD)) / 2));
  const sizes = ruler === "space" ? { nodes: metricNodes(maps) } : targetSize / scale;
  const filled = front.fill([loop], sizes, { order: "layered", improve: false });
  if (!filled.success) return null;
  const film = filmOf(filled);
  const unit = ruler === "square" ? film.nodes : film.nodes.map((node) => maps.toUnit(node));
  const space = unit.map((node) => maps.pointAt(node).position);
  const smallestIn = (positions: readonly (readonly number[])[]): readonly number[] =>
    film.triangles.map(({ corners }) =>
      Math.min(...anglesOf(corners.map((corner) => positions[corner] ?? [0, 0, 0]))),
    );
  const smallest = smallestIn(space);
  const angle = Math.min(...smallest);
  return {
    film,
    unit,
    space,
    smallest,
    worst: { triangle: smallest.indexOf(angle), angle },
    means: {
      square: meanOf(smallestIn(unit)),
      plane: meanOf(smallestIn(unit.map((node) => maps.toPlane(node)))),
      space: meanOf(smallest),
    },
  };
}

const meanOf = (values: readonly number[]): number =>
  values.reduce((sum, value) => sum + value, 0) / Math.max(1, values.length);

/** Nodes of a grid over the stretched square, each with the ellipse whose image on the surface is a circle. */
export function metricNodes(maps: SurfaceMaps): readonly PlaneNode[] {
  const steps = Array.from({ length: nodesPerRow }, (_none, i) => i / (nodesPerRow - 1));
  return steps.flatMap((eta) =>
    steps.map((xi) => ({
      position: maps.toPlane([xi, eta]),
      ...evenEllipse(maps.planeMetricAt([xi, eta]), targetSize),
    })),
  );
}

/** Returns the ellipse of steps that all have one length by a metric. */
export function evenEllipse([xx, xy, yy]: Metric, size: number): Omit<PlaneNode, "position"> {
  const [middle, radius] = [(xx + yy) / 2, Math.hypot((xx - yy) / 2, xy)];
  // Steps are longest where the metric is smallest.
  const turn = Math.atan2(2 * xy, xx - yy) / 2 + Math.PI / 2;
  return {
    size: size / Math.sqrt(middle + radius),
    stretching: Math.sqrt((middle + radius) / Math.max(1e-12, middle - radius)),
    direction: [Math.cos(turn), Math.sin(turn)],
  };
}

function areaOf(maps: SurfaceMaps): number {
  const count = 8;
  let sum = 0;
  for (let i = 0; i < count; i++)
    for (let j = 0; j < count; j++) {
      const [xx, xy, yy] = maps.metricAt([(i + 0.5) / count, (j + 0.5) / count]);
      sum += Math.sqrt(Math.max(0, xx * yy - xy * xy)) / (count * count);
    }
  return sum;
}
