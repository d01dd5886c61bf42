/** Converts a project, with ids and names, to the flat arrays that the engine takes. */
import { backgroundOf, type GridArrays, NOWHERE, projectGrid } from "./grid-arrays.js";
import type { LineType, PatchType, Project } from "./schema.js";

/** A model and its background grid as they cross into the engine. All references are indices. */
export interface ModelArrays {
  /** x y z per point. */
  readonly points: Float64Array;
  /** 0 straight, 1 parabolic, 2 spline. */
  readonly lineTypes: Uint8Array;
  /** Line l has the points linePoints[lineOffsets[l] .. lineOffsets[l + 1] - 1]. */
  readonly lineOffsets: Uint32Array;
  readonly linePoints: Uint32Array;
  readonly patchTypes: Uint8Array;
  /** Patch p has the loops patchOffsets[p] .. patchOffsets[p + 1] - 1. */
  readonly patchOffsets: Uint32Array;
  /** Loop k walks loopLines[loopOffsets[k] .. loopOffsets[k + 1] - 1]. */
  readonly loopOffsets: Uint32Array;
  /** 2 × index of the line, plus 1 if the loop follows it backwards. */
  readonly loopLines: Uint32Array;
  readonly grid: GridArrays;
}

/** Numbers of the engine (cpp/include/tetrafront/model.h). */
export const LINE_TYPES: Readonly<Record<LineType, number>> = { straight: 0, parabolic: 1, spline: 2 };
export const PATCH_TYPES: Readonly<Record<PatchType, number>> = {
  planar: 0,
  "isoparametric-triangle": 1,
  serendipity: 2,
  "barnhill-gregory-nielson": 3,
  coons: 4,
};

/** Converts a project. References to missing entities become indices out of range. O(size). */
export function projectArrays(project: Project): ModelArrays {
  const pointAt = indexById(project.points);
  const lineAt = indexById(project.lines);
  const lines = flatten(project.lines.map((line) => line.points.map((id) => pointAt.get(id) ?? NOWHERE)));
  const loops = project.patches.flatMap((patch) => patch.loops);
  const loopLines = flatten(loops.map((loop) => loop.map((signed) => orientedLine(signed, lineAt))));
  return {
    points: Float64Array.from(project.points.flatMap((point) => point.position)),
    lineTypes: Uint8Array.from(project.lines, (line) => LINE_TYPES[line.type]),
    lineOffsets: lines.offsets,
    linePoints: lines.values,
    patchTypes: Uint8Array.from(project.patches, (patch) => PATCH_TYPES[patch.type]),
    patchOffsets: flatten(project.patches.map((patch) => patch.loops.map(() => 0))).offsets,
    loopOffsets: loopLines.offsets,
    loopLines: loopLines.values,
    grid: projectGrid(backgroundOf(project)),
  };
}

function orientedLine(signed: number, lineAt: ReadonlyMap<number, number>): number {
  return 2 * (lineAt.get(Math.abs(signed)) ?? NOWHERE) + (signed < 0 ? 1 : 0);
}

function indexById(entities: readonly { readonly id: number }[]): ReadonlyMap<number, number> {
  return new Map(entities.map((entity, position) => [entity.id, position]));
}

function flatten(lists: readonly (readonly number[])[]): { offsets: Uint32Array; values: Uint32Array } {
  const offsets = new Uint32Array(lists.length + 1);
  lists.forEach((list, i) => {
    offsets[i + 1] = (offsets[i] ?? 0) + list.length;
  });
  return { offsets, values: Uint32Array.from(lists.flat()) };
}
