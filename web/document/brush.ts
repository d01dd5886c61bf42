import type { SurfaceInspection } from "tetrafront";
import type { ProjectBody, ProjectSource } from "tetrafront/project";
import { stepNames } from "../strings";
import type { Change } from "./edit";
import type { Position } from "./position";

/** What a brush paints. */
export interface Brush {
  /** Element size. */
  readonly size: number;
  /** Distance from the stroke within which the size applies. */
  readonly radius: number;
}

/** Size and radius of a new brush, as shares of the largest automatic size and of the extent. */
const sizeShare = 0.25;
const extentShare = 0.05;

const rounded = (value: number): number => Number(value.toPrecision(2));

/**
 * Returns a brush that refines a body. `box`: that of its given triangles; `largest`: the largest automatic size, if it is
 * known.
 */
export function newBrush({ placement }: ProjectBody, box: SurfaceInspection["box"], largest?: number): Brush {
  const extent = box ? Math.max(...box.high.map((high, k) => high - (box.low[k] ?? 0))) : 1;
  const placed = extent * (placement?.scale ?? 1);
  return { size: rounded(sizeShare * (largest ?? placed / 20)), radius: rounded(extentShare * placed) };
}

export const strokeLabel = stepNames.paintSize;

/** A position of a stroke. */
export interface StrokePosition {
  readonly position: Position;
  /** The body there; null on a drawn patch. */
  readonly body: number | null;
}

/**
 * Returns the sources of a stroke: a point, or segments from each position to the next. A source belongs to the body at
 * its last position.
 */
export function strokeSources(
  stroke: readonly StrokePosition[],
  { size, radius: distance }: Brush,
  firstId: number,
): ProjectSource[] {
  const [first, ...rest] = stroke;
  if (!first) return [];
  const bodyAt = ({ body }: StrokePosition) => body !== null && { body };
  if (rest.length === 0) {
    return [{ id: firstId, type: "point", positions: [first.position], size, distance, ...bodyAt(first) }];
  }
  return rest.map((to, index) => ({
    id: firstId + index,
    type: "segment",
    positions: [(stroke[index] ?? first).position, to.position],
    size,
    distance,
    ...bodyAt(to),
  }));
}

/** Adds the sources of a stroke to the project. */
export function addStroke(stroke: readonly StrokePosition[], brush: Brush): Change {
  return {
    change: ({ project }) => {
      project.background.sources ??= [];
      const { sources } = project.background;
      const firstId = sources.reduce((highest, { id }) => Math.max(highest, id), 0) + 1;
      const added = strokeSources(stroke, brush, firstId);
      sources.push(
        ...(added.map((source) => ({
          ...source,
          positions: source.positions.map((at) => [...at]),
        })) as typeof sources),
      );
    },
  };
}
