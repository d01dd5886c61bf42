/** Names and ids of a project's entities, for messages. */
import type { Diagnostic, EntityRef } from "../diagnostics/diagnostic.js";
import { entityLabel, type EntityNamer, KIND_WORDS, nameByIndex } from "../diagnostics/entity-names.js";
import type { EntityKind } from "../generated/constants.js";
import { backgroundOf } from "./grid-arrays.js";
import { patchesOf, type Project, type ProjectBackground } from "./project-types.js";

/** The parts of a project that refer to ids. A background grid given as arrays has no ids. */
type Referring = Pick<Project, "points" | "lines" | "patches"> & {
  readonly background?: ProjectBackground | undefined;
};

/** Names the id of the missing entity in the message of an invalid reference. */
export function withMissingId(diagnostic: Diagnostic, project: Referring): Diagnostic {
  const [entity] = diagnostic.entities;
  if (diagnostic.code !== "index-out-of-range" || entity === undefined) return diagnostic;
  const missing = missingBelow(entity, project);
  if (missing === undefined) return diagnostic;
  return { ...diagnostic, message: diagnostic.message.replace(/index \d+/, missing) };
}

function missingBelow({ kind, index, id }: EntityRef, project: Referring): string | undefined {
  const { points, lines, patches } = project;
  const among = (entities: readonly { readonly id: number }[], ids: readonly number[]) => {
    const known = new Set(entities.map((entity) => entity.id));
    // In an unfinished project, which was not checked, it may have any type.
    const missing: unknown = Array.from(ids).find((one) => !known.has(one));
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

/** Names entities as the project does: `line "lip"`, or by id: `line 12`. */
export function projectNamer(project: Project): EntityNamer {
  return (kind, index) => {
    const entity = entityAt(project, kind, index);
    if (entity === undefined) return nameByIndex(kind, index);
    return { kind, index, id: entity.id, label: entityLabel(KIND_WORDS[kind], entity) };
  };
}

/** As `name`, but names triangles with their patches: `triangle 7 of patch "wing"`. */
export function withPatchOfTriangle(name: EntityNamer, trianglePatch: Uint32Array): EntityNamer {
  return (kind, index) => {
    const named = name(kind, index);
    const patch = kind === "triangle" ? trianglePatch[index] : undefined;
    return patch === undefined
      ? named
      : { ...named, label: `${named.label} of ${name("patch", patch).label}` };
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
      return project.patches[index] ?? patchesOf(project)[index];
    case "background-node":
      return backgroundOf(project).nodes[index];
    case "source":
      return backgroundOf(project).sources?.[index];
    case "background-tetrahedron":
    case "triangle":
    case "surface-node":
    case "node":
    case "tetrahedron":
      return undefined;
  }
}
