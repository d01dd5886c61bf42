import type { Project, ProjectBackground, ProjectLine, ProjectMeshing, ProjectPatch } from "tetrafront";
import { isDraft, original, type Draft } from "mutative";
import { dependentsOf, entityKey, type DrawnKind, type Entity } from "./entities";
import { entityNouns, stepNames } from "../strings";
import type { DocumentContent, ProjectEdit } from "./edit";

/**
 * All changes that a user can make to the project, as named edits for the history. An edit of a missing entity
 * changes nothing.
 */

export type Axis = 0 | 1 | 2;

/** Returns the name of an entity within a sentence: "point 12". */
const nounOf = (kind: DrawnKind, id: number): string => `${entityNouns[kind]} ${id}`;

type ProjectDraft = Draft<DocumentContent>["project"];

function listOf(project: ProjectDraft, kind: DrawnKind): { id: number; name?: string | undefined }[] {
  switch (kind) {
    case "point":
      return project.points;
    case "line":
      return project.lines;
    case "patch":
      return project.patches;
    case "background-node":
      return project.background.nodes;
    case "source":
      return project.background.sources ?? [];
  }
}

/**
 * Returns the draft of the record with an id. Searches the original list: a draft of a list makes a draft of every
 * record visited, which takes a second for a hundred thousand nodes.
 */
function recordOf<Item extends { readonly id: number }>(list: Item[], id: number): Item | undefined {
  const records = isDraft(list) ? original(list) : list;
  return list[records.findIndex((record) => record.id === id)];
}

/** Moves a point or a background node along one axis. */
export function moveEntity(
  kind: "point" | "background-node",
  id: number,
  axis: Axis,
  value: number,
): ProjectEdit {
  return {
    label: stepNames.move(nounOf(kind, id)),
    mergeKey: `move-${kind}-${id}-${axis}`,
    change: ({ project }) => {
      const record = kind === "point" ? recordOf(project.points, id) : recordOf(project.background.nodes, id);
      if (record) record.position[axis] = value;
    },
  };
}

/** Names a point, line, patch or source; an empty name removes the name. */
export function renameEntity(entity: Entity, name: string): ProjectEdit {
  return {
    label: stepNames.rename(nounOf(entity.kind, entity.id)),
    change: ({ project }) => {
      const record = recordOf(listOf(project, entity.kind), entity.id);
      if (!record) return;
      if (name === "") delete record.name;
      else record.name = name;
    },
  };
}

export function renameProject(name: string): ProjectEdit {
  return {
    label: stepNames.renameProject,
    change: ({ project }) => {
      project.name = name;
    },
  };
}

export function setLineType(id: number, type: ProjectLine["type"]): ProjectEdit {
  return {
    label: stepNames.setLineType(id),
    change: ({ project }) => {
      const line = recordOf(project.lines, id);
      if (line) line.type = type;
    },
  };
}

export function setLinePoints(id: number, points: readonly number[]): ProjectEdit {
  return {
    label: stepNames.setLinePoints(id),
    change: ({ project }) => {
      const line = recordOf(project.lines, id);
      if (line && line.points.join() !== points.join()) line.points = [...points];
    },
  };
}

export function setPatchType(id: number, type: ProjectPatch["type"]): ProjectEdit {
  return {
    label: stepNames.setPatchType(id),
    change: ({ project }) => {
      const patch = recordOf(project.patches, id);
      if (patch) patch.type = type;
    },
  };
}

/** The outer loop first; a negative id walks that line backwards. */
export function setPatchLoops(id: number, loops: readonly (readonly number[])[]): ProjectEdit {
  return {
    label: stepNames.setPatchLoops(id),
    change: ({ project }) => {
      const patch = recordOf(project.patches, id);
      if (patch && JSON.stringify(patch.loops) !== JSON.stringify(loops)) {
        patch.loops = loops.map((loop) => [...loop]);
      }
    },
  };
}

export function setNodeSize(id: number, size: number): ProjectEdit {
  return {
    label: stepNames.setNode("size", id),
    mergeKey: `size-${id}`,
    change: ({ project }) => {
      const node = recordOf(project.background.nodes, id);
      if (node) node.size = size;
    },
  };
}

export function setNodeStretching(id: number, stretching: number): ProjectEdit {
  return {
    label: stepNames.setNode("stretching", id),
    mergeKey: `stretching-${id}`,
    change: ({ project }) => {
      const node = recordOf(project.background.nodes, id);
      if (!node) return;
      node.stretching = stretching;
      node.direction ??= [1, 0, 0];
    },
  };
}

export function setNodeDirection(id: number, axis: Axis, value: number): ProjectEdit {
  return {
    label: stepNames.setNode("direction", id),
    mergeKey: `direction-${id}-${axis}`,
    change: ({ project }) => {
      const node = recordOf(project.background.nodes, id);
      if (!node) return;
      node.direction ??= [1, 0, 0];
      node.direction[axis] = value;
    },
  };
}

function sourceOf({ background }: ProjectDraft, id: number) {
  return background.sources && recordOf(background.sources, id);
}

/** A number of a source that determines sizes. */
export type SourceField = "size" | "distance" | "growth";

export function setSourceField(id: number, field: SourceField, value: number): ProjectEdit {
  return {
    label: stepNames.setSource(field, id),
    mergeKey: `source-${field}-${id}`,
    change: ({ project }) => {
      const source = sourceOf(project, id);
      if (source) source[field] = value;
    },
  };
}

/** Moves one corner of a source along one axis. */
export function moveSource(id: number, corner: number, axis: Axis, value: number): ProjectEdit {
  return {
    label: stepNames.move(nounOf("source", id)),
    mergeKey: `move-source-${id}-${corner}-${axis}`,
    change: ({ project }) => {
      const position = sourceOf(project, id)?.positions[corner];
      if (position) position[axis] = value;
    },
  };
}

/** Returns the settings with a new value in one field. Null removes the field; without fields, the result is undefined. */
function changed<Field extends keyof ProjectMeshing>(
  { meshing }: Project,
  field: Field,
  value: ProjectMeshing[Field] | null,
): ProjectMeshing | undefined {
  const { [field]: _, ...others } = meshing ?? {};
  const settings = value === null ? others : { ...others, [field]: value };
  return Object.keys(settings).length > 0 ? settings : undefined;
}

/** Changes a mesh setting of the project; null removes it, so that the default applies. */
export function setMeshing<Field extends keyof ProjectMeshing>(
  field: Field,
  value: ProjectMeshing[Field] | null,
): ProjectEdit {
  return {
    label: field === "size" && value === null ? stepNames.removeUniformSize : stepNames.setMeshing[field],
    ...(typeof value === "number" && { mergeKey: `meshing-${field}` }),
    change: (draft) => {
      const settings = changed(draft.project as Project, field, value);
      if (settings === undefined) delete draft.project.meshing;
      else draft.project.meshing = settings;
    },
  };
}

/** Replaces the sources and keeps the background grid. A uniform size stays in force. */
export function replaceSources(label: string, background: ProjectBackground): ProjectEdit {
  return { label, replace: [[["project", "background"], background]] };
}

/** Replaces the background grid with its sources. It also replaces a uniform size. */
export function replaceBackground(
  label: string,
  project: Project,
  background: ProjectBackground,
): ProjectEdit {
  return {
    label,
    replace: [
      [["project", "background"], background],
      [["project", "meshing"], changed(project, "size", null)],
    ],
  };
}

/** Multiplies all sizes: of background nodes, of sources, and the uniform one. Above 1, the mesh gets coarser. */
export function scaleSizes({ background, meshing }: Project, factor: number): ProjectEdit {
  const scaled = <Item extends { readonly size: number }>(list: readonly Item[]): readonly Item[] =>
    list.map((item) => ({ ...item, size: factor * item.size }));
  return {
    label: factor < 1 ? stepNames.refineSizes : stepNames.coarsenSizes,
    replace: [
      [["project", "background", "nodes"], scaled(background.nodes)],
      ...(background.sources
        ? [[["project", "background", "sources"], scaled(background.sources)] as const]
        : []),
      ...(meshing?.size === undefined
        ? []
        : [[["project", "meshing"], { ...meshing, size: factor * meshing.size }] as const]),
    ],
  };
}

/** Returns the given entities and all that depend on them, directly or indirectly. */
export function withDependents(project: Project, entities: readonly Entity[]): Entity[] {
  const found = new Map<string, Entity>();
  const visit = (entity: Entity): void => {
    if (found.has(entityKey(entity))) return;
    found.set(entityKey(entity), entity);
    dependentsOf(project, entity).forEach(visit);
  };
  entities.forEach(visit);
  return [...found.values()];
}

/** Deletes entities and everything that depends on them, so that no reference becomes invalid. */
export function deleteEntities(project: Project, entities: readonly Entity[]): ProjectEdit {
  const doomed = withDependents(project, entities);
  const [first] = entities;
  const subject =
    entities.length === 1 && first ? nounOf(first.kind, first.id) : stepNames.entities(entities.length);
  const idsOf = (of: DrawnKind): ReadonlySet<number> =>
    new Set(doomed.flatMap(({ kind, id }) => (kind === of ? [id] : [])));
  /** Returns the same list if nothing is removed, so that unchanged lists stay shared. */
  const without = <Item>(list: readonly Item[], goes: (item: Item) => boolean): readonly Item[] =>
    list.some(goes) ? list.filter((item) => !goes(item)) : list;
  const rest = <Item extends { readonly id: number }>(list: readonly Item[], kind: DrawnKind) => {
    const ids = idsOf(kind);
    return without(list, ({ id }) => ids.has(id));
  };
  const { background } = project;
  const nodes = idsOf("background-node");
  return {
    label: stepNames.delete(subject, doomed.length - entities.length),
    replace: [
      [["project", "points"], rest(project.points, "point")],
      [["project", "lines"], rest(project.lines, "line")],
      [["project", "patches"], rest(project.patches, "patch")],
      [["project", "background", "nodes"], rest(background.nodes, "background-node")],
      [
        ["project", "background", "tetrahedra"],
        nodes.size === 0
          ? background.tetrahedra
          : without(background.tetrahedra, (corners) => corners.some((id) => nodes.has(id))),
      ],
      ...(background.sources
        ? [[["project", "background", "sources"], rest(background.sources, "source")] as const]
        : []),
    ],
  };
}
