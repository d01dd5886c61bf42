import type { ProjectSource } from "tetrafront";
import { stepNames } from "../strings";
import type { Change, DocumentContent } from "./edit";
import type { Position } from "./position";

/** What a brush paints. */
export interface Brush {
  /** Element size. */
  readonly size: number;
  /** Distance from the stroke within which the size applies. */
  readonly radius: number;
}

export const strokeLabel = stepNames.paintSize;

/** Returns the sources of a stroke: a point, or segments from each position to the next. */
export function strokeSources(
  stroke: readonly Position[],
  { size, radius: distance }: Brush,
  firstId: number,
): ProjectSource[] {
  const [first, ...rest] = stroke;
  if (!first) return [];
  if (rest.length === 0) return [{ id: firstId, type: "point", positions: [first], size, distance }];
  return rest.map((to, index) => ({
    id: firstId + index,
    type: "segment",
    positions: [stroke[index] ?? first, to],
    size,
    distance,
  }));
}

/** Adds the sources of a stroke to the project. */
export function addStroke(stroke: readonly Position[], brush: Brush): Change<DocumentContent> {
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
