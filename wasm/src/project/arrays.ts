/** Converts a project, with ids and names, to the flat arrays that the engine takes. */
import { backgroundOf, type GridArrays, NOWHERE, projectGrid } from "./grid-arrays.js";
import type { LineType, PatchType, Project } from "./schema.js";

/** A drawn model as it crosses into the engine: one array per field. All references are indices. */
export interface ModelArrays {
  /** x y z per point. */
  readonly points: Float64Array;
  readonly lines: {
    /** 0 straight, 1 parabolic, 2 spline. */
    readonly type: Uint8Array;
    readonly points: Lists<Uint32Array>;
  };
  readonly patches: {
    readonly type: Uint8Array;
    readonly loops: Lists<Lists<LoopLines>>;
  };
}

/** One list per element: the length of each, and the items of all one after the other. */
export interface Lists<Items> {
  readonly lengths: Uint32Array;
  readonly items: Items;
}

/** Lines of loops; `reversed` is 1 if the loop follows the line backwards. */
export interface LoopLines {
  readonly line: Uint32Array;
  readonly reversed: Uint8Array;
}

/** A project as it crosses into the engine. */
export interface ProjectArrays {
  readonly model: ModelArrays;
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
export function projectArrays(project: Project): ProjectArrays {
  return { model: modelArrays(project), grid: projectGrid(backgroundOf(project)) };
}

function modelArrays({ points, lines, patches }: Project): ModelArrays {
  const pointAt = indexById(points);
  const lineAt = indexById(lines);
  const loops = patches.flatMap((patch) => patch.loops);
  const loopLines = loops.flat();
  return {
    points: Float64Array.from(points.flatMap((point) => point.position)),
    lines: {
      type: Uint8Array.from(lines, (line) => LINE_TYPES[line.type]),
      points: {
        lengths: lengthsOf(lines.map((line) => line.points)),
        items: Uint32Array.from(lines.flatMap((line) => line.points.map((id) => pointAt.get(id) ?? NOWHERE))),
      },
    },
    patches: {
      type: Uint8Array.from(patches, (patch) => PATCH_TYPES[patch.type]),
      loops: {
        lengths: lengthsOf(patches.map((patch) => patch.loops)),
        items: {
          lengths: lengthsOf(loops),
          items: {
            line: Uint32Array.from(loopLines, (signed) => lineAt.get(Math.abs(signed)) ?? NOWHERE),
            reversed: Uint8Array.from(loopLines, (signed) => Number(signed < 0)),
          },
        },
      },
    },
  };
}

function indexById(entities: readonly { readonly id: number }[]): ReadonlyMap<number, number> {
  return new Map(entities.map((entity, position) => [entity.id, position]));
}

function lengthsOf(lists: readonly (readonly unknown[])[]): Uint32Array {
  return Uint32Array.from(lists, (list) => list.length);
}
