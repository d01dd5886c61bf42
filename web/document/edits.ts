import type { Project, ProjectLine, ProjectPatch } from "tetrafront/project";
import { stepNames } from "../strings";
import { finderIn, listOf, nounOf, recordOf, type Axis, type ProjectDraft } from "./draft-records";
import type { DraftEdit, ProjectEdit } from "./edit";
import { pointsForType, runsThroughMany } from "./line-types";
import { dependentFinder, entityKey, type DrawnKind, type Entity } from "./entities";

/**
 * Changes of the project's name and of its entities, as named edits for the history. An edit of a missing entity
 * changes nothing.
 */

/** Moves a point or a background node along one axis. */
export function moveEntity(
  kind: "point" | "background-node",
  id: number,
  axis: Axis,
  value: number,
): DraftEdit {
  return {
    label: stepNames.move(nounOf(kind, id)),
    mergeKey: `move-${kind}-${id}-${axis}`,
    change: ({ project }) => {
      const record = kind === "point" ? recordOf(project.points, id) : recordOf(project.background.nodes, id);
      if (record) record.position[axis] = value;
    },
  };
}

/** Names an entity; an empty name removes the name. Background nodes have no names: nothing changes. */
export function renameEntity(entity: Entity, name: string): ProjectEdit {
  return {
    label: stepNames.rename(nounOf(entity.kind, entity.id)),
    change: ({ project }) => {
      const record = recordOf(listOf(project, entity.kind), entity.id);
      if (!record || entity.kind === "background-node") return;
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

export function setLineType(id: number, type: ProjectLine["type"]): DraftEdit {
  return {
    label: stepNames.setLineType(id),
    change: ({ project }) => changeLineTypes(project, [id], type),
  };
}

/** Changes the type of lines in a draft. O(ids + lines). */
export function changeLineTypes(
  project: ProjectDraft,
  ids: readonly number[],
  type: ProjectLine["type"],
): void {
  const find = finderIn(project.lines);
  for (const id of ids) {
    const line = find(id);
    if (!line) continue;
    line.points = [...pointsForType(line.points, line.type, type)];
    line.type = type;
    if (runsThroughMany(type)) continue;
    delete line.startTangent;
    delete line.endTangent;
  }
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

/** Gives an end of a spline or Hermite line a tangent; null removes it. */
export function setTangent(
  id: number,
  end: "startTangent" | "endTangent",
  tangent: readonly [number, number, number] | null,
): ProjectEdit {
  return {
    label: stepNames.setTangent(id),
    mergeKey: `tangent-${id}-${end}`,
    change: ({ project }) => {
      const line = recordOf(project.lines, id);
      if (!line) return;
      if (tangent) line[end] = [...tangent];
      else delete line[end];
    },
  };
}

export function setPatchType(id: number, type: ProjectPatch["type"]): DraftEdit {
  return {
    label: stepNames.setPatchType(id),
    change: ({ project }) => changePatchTypes(project, [id], type),
  };
}

/** Changes the type of patches in a draft. O(ids + patches). */
export function changePatchTypes(
  project: ProjectDraft,
  ids: readonly number[],
  type: ProjectPatch["type"],
): void {
  const find = finderIn(project.patches);
  for (const id of ids) {
    const patch = find(id);
    if (patch) patch.type = type;
  }
}

/** The outer loop first; a negative id traverses its line backwards. */
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

/** Returns the given entities and all that depend on them, directly or indirectly. O(entities + lines + patches). */
export function withDependents(project: Project, entities: readonly Entity[]): Entity[] {
  const found = new Map<string, Entity>();
  const dependentsOf = dependentFinder(project);
  const visit = (entity: Entity): void => {
    if (found.has(entityKey(entity))) return;
    found.set(entityKey(entity), entity);
    dependentsOf(entity).forEach(visit);
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
    replace: {
      points: rest(project.points, "point"),
      lines: rest(project.lines, "line"),
      patches: rest(project.patches, "patch"),
      ...(project.bodies && { bodies: rest(project.bodies, "body") }),
      background: {
        ...background,
        nodes: rest(background.nodes, "background-node"),
        tetrahedra:
          nodes.size === 0
            ? background.tetrahedra
            : without(background.tetrahedra, (corners) => corners.some((id) => nodes.has(id))),
        ...(background.sources && { sources: rest(background.sources, "source") }),
      },
    },
  };
}
