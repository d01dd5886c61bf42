/** Converts a project, with ids and names, to the flat arrays that the engine takes. */
import { numbersOf } from "../base/enums.js";
import { type GridArrays, LINE_TYPES, type ModelArrays, PATCH_TYPES } from "../generated/constants.js";
import { bodyBox } from "./bodies.js";
import { backgroundOf, NOWHERE, projectGrid } from "./grid-arrays.js";
import type { Project, ProjectPatch } from "./project-types.js";

/** A project as it crosses into the engine. */
export interface ProjectArrays {
  readonly model: ModelArrays;
  readonly grid: GridArrays;
}

const LINE_TYPE_NUMBERS = numbersOf(LINE_TYPES);
const PATCH_TYPE_NUMBERS = numbersOf(PATCH_TYPES);

/** A tangent that is not given. */
const NO_TANGENT = [0, 0, 0] as const;

/** Converts a project. References to missing entities become indices out of range. O(size). */
export function projectArrays(project: Project): ProjectArrays {
  return { model: modelArrays(project), grid: projectGrid(backgroundOf(project)) };
}

/** Converts the points, lines and patches of a project, as `projectArrays`. O(size). */
export function modelArrays({ points, lines, patches }: Project): ModelArrays {
  const pointAt = indexById(points);
  const lineAt = indexById(lines);
  const orientedLines = (signed: readonly number[]) => ({
    line: Uint32Array.from(signed, (id) => lineAt.get(Math.abs(id)) ?? NOWHERE),
    reversed: Uint8Array.from(signed, (id) => Number(id < 0)),
  });
  const loopsOf = (patch: ProjectPatch) => (patch.type === "loft" ? patch.loops.slice(0, 1) : patch.loops);
  const sectionsOf = (patch: ProjectPatch) => (patch.type === "loft" ? patch.loops.slice(1).flat() : []);
  const loops = patches.flatMap(loopsOf);
  return {
    points: Float64Array.from(points.flatMap((point) => point.position)),
    lines: {
      type: Uint8Array.from(lines, (line) => LINE_TYPE_NUMBERS[line.type]),
      points: {
        lengths: lengthsOf(lines.map((line) => line.points)),
        items: Uint32Array.from(lines.flatMap((line) => line.points.map((id) => pointAt.get(id) ?? NOWHERE))),
      },
      startTangent: Float64Array.from(lines.flatMap((line) => line.startTangent ?? NO_TANGENT)),
      endTangent: Float64Array.from(lines.flatMap((line) => line.endTangent ?? NO_TANGENT)),
    },
    patches: {
      type: Uint8Array.from(patches, (patch) => PATCH_TYPE_NUMBERS[patch.type]),
      loops: {
        lengths: lengthsOf(patches.map(loopsOf)),
        items: { lengths: lengthsOf(loops), items: orientedLines(loops.flat()) },
      },
      sections: {
        lengths: lengthsOf(patches.map(sectionsOf)),
        items: orientedLines(patches.flatMap(sectionsOf)),
      },
    },
  };
}

/**
 * As `modelArrays`, with the diagonal of the box of each body as one more line: for tools that need only the extent of
 * the project besides what is drawn.
 */
export function modelWithBodyBoxes(project: Project): ModelArrays {
  const { bodies = [], points, lines } = project;
  const box = (end: 0 | 1) =>
    bodies.map((body, b) => ({ id: -1 - 2 * b - end, position: bodyBox(body)[end] }));
  const ends = [...box(0), ...box(1)];
  const diagonals = bodies.map((_, b) => ({
    id: -1 - b,
    type: "straight" as const,
    points: [-1 - 2 * b, -2 - 2 * b],
  }));
  return modelArrays({ ...project, points: [...points, ...ends], lines: [...lines, ...diagonals] });
}

function indexById(entities: readonly { readonly id: number }[]): ReadonlyMap<number, number> {
  return new Map(entities.map((entity, index) => [entity.id, index]));
}

function lengthsOf(lists: readonly (readonly unknown[])[]): Uint32Array {
  return Uint32Array.from(lists, (list) => list.length);
}
