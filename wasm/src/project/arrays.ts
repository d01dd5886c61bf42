/** From a project, with ids and names, to the flat arrays the engine takes; and back from positions to names. */
import { backgroundOf, NOWHERE, projectGrid, type GridArrays } from "./grid-arrays.js";
import type { LineType, PatchType, Project, ProjectBackground } from "./schema.js";
import type { Diagnostic, EntityKind, EntityRef } from "../api/types.js";

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
  readonly grid: GridArrays;
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

/** Flattens a project. References that lead nowhere become positions out of range. O(size). */
export function projectArrays(project: Project): ModelArrays {
  const pointAt = positionsById(project.points);
  const lineAt = positionsById(project.lines);
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

/** What may refer to ids; a background grid that came as arrays has none. */
type Referring = Pick<Project, "points" | "lines" | "patches"> & {
  readonly background?: ProjectBackground | undefined;
};

/** The message of a reference that leads nowhere, with the id that the project has for it. */
export function withMissingId(diagnostic: Diagnostic, project: Referring): Diagnostic {
  const [entity] = diagnostic.entities;
  if (diagnostic.code !== "index-out-of-range" || entity === undefined) return diagnostic;
  const missing = missingBelow(entity, project);
  if (missing === undefined) return diagnostic;
  return { ...diagnostic, message: diagnostic.message.replace(/index \d+/, missing) };
}

function missingBelow({ kind, index, id }: EntityRef, project: Referring): string | undefined {
  const { points, lines, patches } = project;
  const among = (entities: readonly { readonly id: number }[], wanted: readonly number[]) => {
    const known = new Set(entities.map((entity) => entity.id));
    // Of drawings that are not finished, nor checked, it may be anything.
    const missing: unknown = Array.from(wanted).find((one) => !known.has(one));
    return typeof missing === "number" ? missing : undefined;
  };
  if (kind === "line") {
    const missing = among(points, lines.find((line) => line.id === id)?.points ?? []);
    return missing === undefined ? undefined : `point ${missing}`;
  }
  if (kind === "background-tetrahedron") {
    const { nodes, tetrahedra } = backgroundOf(project);
    const missing = among(nodes, tetrahedra[index] ?? []);
    return missing === undefined ? undefined : `background node ${missing}`;
  }
  if (kind !== "patch") return undefined;
  const loops = patches.find((patch) => patch.id === id)?.loops ?? [];
  const missing = among(lines, Array.from(loops).flat().map(Math.abs));
  return missing === undefined ? undefined : `line ${missing}`;
}

function orientedLine(signed: number, lineAt: ReadonlyMap<number, number>): number {
  return 2 * (lineAt.get(Math.abs(signed)) ?? NOWHERE) + (signed < 0 ? 1 : 0);
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
export const nameByPosition: EntityNamer = (kind, index) => {
  return { kind, index, label: `${KIND_WORDS[kind]} ${index}` };
};

/** As `name`, but for a background grid that came as arrays, whose nodes nobody named. */
export function gridByPosition(name: EntityNamer): EntityNamer {
  return (kind, index) =>
    kind === "background-node" || kind === "background-tetrahedron"
      ? nameByPosition(kind, index)
      : name(kind, index);
}

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
      return backgroundOf(project).nodes[index];
    case "source":
      return backgroundOf(project).sources?.[index];
    case "background-tetrahedron":
    case "triangle":
    case "surface-node":
      return undefined;
  }
}
