import { GROUP_KINDS, type Project, type ProjectGroup } from "tetrafront/project";
import { groupName, stepNames } from "../strings";
import type { ProjectEdit } from "./edit";
import { entityKey, patchEntity, type Entity } from "./entities";

/** Groups: named sets of entities with a colour. */

type Member = ProjectGroup["members"][number];
type GroupColor = NonNullable<ProjectGroup["color"]>;

/**
 * Colours of new groups, one after the other. They differ from those that mean a problem, the selection, or what lies under the
 * pointer; the first two are of the palette of Okabe and Ito (2008) for colour-blind people.
 */
const palette: readonly GroupColor[] = [
  [0, 0.62, 0.45],
  [0.8, 0.47, 0.65],
  [0.68, 0.8, 0.2],
  [0.46, 0.33, 0.72],
  [0.5, 0.35, 0.25],
  [0.78, 0.7, 0.92],
];

/** Colour that stands for groups without one. */
export const groupedColor: GroupColor = [0.5, 0.5, 0.5];

/** Returns the member that stands for an entity; undefined if groups cannot hold entities of its kind. */
function memberOf({ kind, id }: Entity): Member | undefined {
  const kindInFile = kind === "body-patch" ? "patch" : kind;
  const known = GROUP_KINDS.find((one) => one === kindInFile);
  return known && { kind: known, id };
}

/** Returns whether groups can hold an entity. */
export const isGroupable = (entity: Entity): boolean => memberOf(entity) !== undefined;

const memberKey = ({ kind, id }: Member): string => `${kind} ${id}`;

/** Returns the entities of a group. */
export function groupEntities(project: Project, { members }: ProjectGroup): Entity[] {
  return members.map(({ kind, id }) => (kind === "patch" ? patchEntity(project, id) : { kind, id }));
}

/** Returns the members that a selection would give a group, each once. O(entities). */
function groupableMembers(entities: readonly Entity[]): Member[] {
  const members = entities.flatMap((entity) => memberOf(entity) ?? []);
  return [...new Map(members.map((member) => [memberKey(member), member])).values()];
}

/** Returns the group that has exactly the selected members; undefined if there is none. */
export function groupOfSelection(project: Project, selection: readonly Entity[]): ProjectGroup | undefined {
  const selected = new Set(selection.map(entityKey));
  return project.groups?.find((group) => {
    const members = groupEntities(project, group);
    return members.length === selected.size && members.every((member) => selected.has(entityKey(member)));
  });
}

/** Makes a group of entities, with the next free id and the next colour. */
export function addGroup({ groups = [] }: Project, entities: readonly Entity[]): ProjectEdit {
  const id = groups.reduce((highest, group) => Math.max(highest, group.id), 0) + 1;
  const color = palette[(id - 1) % palette.length];
  const name = groupName(id);
  const group = { id, name, ...(color && { color }), members: groupableMembers(entities) };
  return {
    label: stepNames.addGroup(name),
    replace: { groups: [...groups, group] },
  };
}

/** Changes a group; does nothing if it is missing. */
function changeGroup(
  { groups = [] }: Project,
  id: number,
  label: (name: string) => string,
  change: (group: ProjectGroup) => ProjectGroup,
  mergeKey?: string,
): ProjectEdit {
  const name = groups.find((group) => group.id === id)?.name ?? "";
  return {
    label: label(name),
    ...(mergeKey !== undefined && { mergeKey }),
    replace: { groups: groups.map((group) => (group.id === id ? change(group) : group)) },
  };
}

export const renameGroup = (project: Project, id: number, name: string): ProjectEdit =>
  changeGroup(project, id, stepNames.renameGroup, (group) => ({ ...group, name }));

export const colorGroup = (project: Project, id: number, color: GroupColor): ProjectEdit =>
  changeGroup(project, id, stepNames.colorGroup, (group) => ({ ...group, color }), `group-color-${id}`);

/** Adds entities to a group. O(members + entities). */
export const extendGroup = (project: Project, id: number, entities: readonly Entity[]): ProjectEdit =>
  changeGroup(project, id, stepNames.extendGroup, (group) => {
    const known = new Set(group.members.map(memberKey));
    const added = groupableMembers(entities).filter((member) => !known.has(memberKey(member)));
    return added.length === 0 ? group : { ...group, members: [...group.members, ...added] };
  });

/** Takes entities out of a group. If no member is left, the group is removed. O(members + entities). */
export function reduceGroup(project: Project, id: number, entities: readonly Entity[]): ProjectEdit {
  const leaving = new Set(groupableMembers(entities).map(memberKey));
  const staysIn = ({ members }: ProjectGroup) => members.filter((member) => !leaving.has(memberKey(member)));
  const group = project.groups?.find((one) => one.id === id);
  if (group && staysIn(group).length === 0) return removeGroup(project, id);
  return changeGroup(project, id, stepNames.reduceGroup, (one) => ({ ...one, members: staysIn(one) }));
}

/** Returns how many of the entities that groups can hold belong to a group. O(members + entities). */
export function membershipIn(group: ProjectGroup, entities: readonly Entity[]): "all" | "some" | "none" {
  const known = new Set(group.members.map(memberKey));
  const members = groupableMembers(entities);
  const count = members.filter((member) => known.has(memberKey(member))).length;
  if (count === 0) return "none";
  return count === members.length ? "all" : "some";
}

/** Removes a group; its members stay in the model. */
export function removeGroup({ groups = [] }: Project, id: number): ProjectEdit {
  const rest = groups.filter((group) => group.id !== id);
  return {
    label: stepNames.removeGroup(groups.find((group) => group.id === id)?.name ?? ""),
    replace: { groups: rest.length > 0 ? rest : undefined },
  };
}

const noTints: ReadonlyMap<string, GroupColor> = new Map();
const tintsOf = new WeakMap<object, ReadonlyMap<string, GroupColor>>();

/**
 * Returns the colours of the groups, by the keys of their members; of several groups, the last one decides. The same list
 * of groups gives the same object.
 */
export function groupTints(project: Project): ReadonlyMap<string, GroupColor> {
  const { groups } = project;
  if (!groups || groups.every(({ color }) => color === undefined)) return noTints;
  let tints = tintsOf.get(groups);
  if (!tints) {
    tints = new Map(
      groups.flatMap(({ members, color }) =>
        color ? members.map((member) => [entityKey(member), color] as const) : [],
      ),
    );
    tintsOf.set(groups, tints);
  }
  return tints;
}

/** Returns a colour as in CSS: `#ff8000`. */
export const cssColor = (color: GroupColor): string =>
  `#${color
    .map((part) =>
      Math.round(255 * part)
        .toString(16)
        .padStart(2, "0"),
    )
    .join("")}`;

/** Reads a colour from CSS: `#ff8000`. */
export function colorFromCss(text: string): GroupColor {
  const part = (at: number): number => Number.parseInt(text.slice(at, at + 2), 16) / 255;
  return [part(1), part(3), part(5)];
}
