/** From a project, with ids and names, to the flat arrays the engine takes; and back from positions to names. */
import type {
  LineType,
  PatchType,
  Project,
  ProjectBackgroundNode,
  ProjectSource,
  SourceType,
} from "./project-schema.js";
import type { EntityKind, EntityRef } from "./types.js";

/** A model and its background grid as they cross into the engine. All references are positions. */
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
  /** 2 × position of the line, plus 1 if it is walked backwards. */
  readonly loopLines: Uint32Array;
  /** x y z, size, stretching, direction x y z per node. */
  readonly gridNodes: Float64Array;
  /** Four node positions per tetrahedron. */
  readonly gridTetrahedra: Uint32Array;
  /** 0 point, 1 segment, 2 triangle. */
  readonly sourceTypes: Uint8Array;
  /** x y z of three places (those its type lacks are 0), size, distance, growth per source. */
  readonly sourceValues: Float64Array;
  /** What this far outside the grid still counts as covered. */
  readonly overhang: number;
}

/** The engine's numbers (cpp/include/tetrafront/model.h). */
export const LINE_TYPES: Readonly<Record<LineType, number>> = { straight: 0, parabolic: 1, spline: 2 };
export const PATCH_TYPES: Readonly<Record<PatchType, number>> = {
  planar: 0,
  "isoparametric-triangle": 1,
  serendipity: 2,
  "barnhill-gregory-nielson": 3,
  coons: 4,
};
export const SOURCE_TYPES: Readonly<Record<SourceType, number>> = { point: 0, segment: 1, triangle: 2 };
/** Growth of the size per unit of distance from a source that does not say. */
export const DEFAULT_SOURCE_GROWTH = 0.3;

/** Doubles per source; the last three are size, distance and growth. */
const SOURCE_STRIDE = 12;
/** Doubles per background node. */
const NODE_STRIDE = 8;

/** The engine reports a reference to this position as `index-out-of-range`. */
const NOWHERE = 0x7fffffff;

/** Flattens a project. References that lead nowhere become positions out of range. O(size). */
export function projectArrays(project: Project): ModelArrays {
  const pointAt = positionsById(project.points);
  const lineAt = positionsById(project.lines);
  const nodeAt = positionsById(project.background.nodes);
  const sources = project.background.sources ?? [];
  const lines = flatten(project.lines.map((line) => line.points.map((id) => pointAt.get(id) ?? NOWHERE)));
  const loops = project.patches.flatMap((patch) => patch.loops);
  const loopLines = flatten(loops.map((loop) => loop.map((signed) => orientedLine(signed, lineAt))));
  return {
    points: Float64Array.from(project.points.flatMap((point) => point.at)),
    lineTypes: Uint8Array.from(project.lines, (line) => LINE_TYPES[line.type]),
    lineOffsets: lines.offsets,
    linePoints: lines.values,
    patchTypes: Uint8Array.from(project.patches, (patch) => PATCH_TYPES[patch.type]),
    patchOffsets: flatten(project.patches.map((patch) => patch.loops.map(() => 0))).offsets,
    loopOffsets: loopLines.offsets,
    loopLines: loopLines.values,
    gridNodes: gridNodes(project.background.nodes),
    gridTetrahedra: Uint32Array.from(
      project.background.tetrahedra.flatMap((tetrahedron) =>
        tetrahedron.map((id) => nodeAt.get(id) ?? NOWHERE),
      ),
    ),
    sourceTypes: Uint8Array.from(sources, (source) => SOURCE_TYPES[source.type]),
    sourceValues: sourceValues(sources),
    overhang: project.background.overhang ?? 0,
  };
}

function orientedLine(signed: number, lineAt: ReadonlyMap<number, number>): number {
  return 2 * (lineAt.get(Math.abs(signed)) ?? NOWHERE) + (signed < 0 ? 1 : 0);
}

function gridNodes(nodes: readonly ProjectBackgroundNode[]): Float64Array {
  const values = new Float64Array(NODE_STRIDE * nodes.length);
  nodes.forEach((node, i) => {
    const direction = node.direction ?? [1, 0, 0];
    values.set([...node.at, node.size, node.stretching ?? 1, ...direction], NODE_STRIDE * i);
  });
  return values;
}

function sourceValues(sources: readonly ProjectSource[]): Float64Array {
  const values = new Float64Array(SOURCE_STRIDE * sources.length);
  sources.forEach(({ places, size, distance = 0, growth = DEFAULT_SOURCE_GROWTH }, s) => {
    // No more than three: previews show drawings that nobody has checked.
    values.set(places.slice(0, 3).flat(), SOURCE_STRIDE * s);
    values.set([size, distance, growth], SOURCE_STRIDE * (s + 1) - 3);
  });
  return values;
}

function positionsById(entities: readonly { readonly id: number }[]): ReadonlyMap<number, number> {
  return new Map(entities.map((entity, position) => [entity.id, position]));
}

function flatten(lists: readonly (readonly number[])[]): { offsets: Uint32Array; values: Uint32Array } {
  const offsets = new Uint32Array(lists.length + 1);
  lists.forEach((list, i) => {
    offsets[i + 1] = (offsets[i] ?? 0) + list.length;
  });
  return { offsets, values: Uint32Array.from(lists.flat()) };
}

/** Tells what the user calls the entity at a position. */
export type EntityNamer = (kind: EntityKind, index: number) => EntityRef;

const KIND_WORDS: Readonly<Record<EntityKind, string>> = {
  point: "point",
  line: "line",
  patch: "patch",
  "background-node": "background node",
  "background-tetrahedron": "background tetrahedron",
  triangle: "triangle",
  "surface-node": "surface node",
  source: "source",
};

/** Names by number, for a given surface, whose entities nobody named. */
export const nameByPosition: EntityNamer = (kind, index) => ({
  kind,
  index,
  label: `${KIND_WORDS[kind]} ${index}`,
});

/** Names as the project has them: `line "lip"`, else by id: `line 12`. */
export function projectNamer(project: Project): EntityNamer {
  return (kind, index) => {
    const entity = entityAt(project, kind, index);
    if (entity === undefined) return nameByPosition(kind, index);
    const words = KIND_WORDS[kind];
    const label =
      entity.name === undefined || entity.name === "" ? `${words} ${entity.id}` : `${words} "${entity.name}"`;
    return { kind, index, id: entity.id, label };
  };
}

function entityAt(
  project: Project,
  kind: EntityKind,
  index: number,
): { readonly id: number; readonly name?: string | undefined } | undefined {
  switch (kind) {
    case "point":
      return project.points[index];
    case "line":
      return project.lines[index];
    case "patch":
      return project.patches[index];
    case "background-node":
      return project.background.nodes[index];
    case "source":
      return project.background.sources?.[index];
    case "background-tetrahedron":
    case "triangle":
    case "surface-node":
      return undefined;
  }
}
