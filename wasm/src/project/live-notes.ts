/** The notes and the problem of a project after entities were removed. */
import { Subjects } from "./notes.js";
import type { Project } from "./project-types.js";

/**
 * Returns the groups, expressions and problem of a project without references to entities that do not exist: after entities were
 * removed, the project is valid with these. Lists and groups that do not change are the same objects. O(size).
 */
export function liveNotes(project: Project): Pick<Project, "groups" | "expressions" | "problem"> {
  const { groups, expressions, problem } = project;
  if (groups === undefined && expressions === undefined && problem === undefined) return {};
  const subjects = new Subjects(project);
  const live = <Item>(list: readonly Item[], isLive: (item: Item) => boolean): readonly Item[] =>
    list.every(isLive) ? list : list.filter(isLive);
  const shrunk = groups?.map((group) => {
    const members = live(group.members, ({ kind, id: member }) => subjects.has(kind, member));
    return members === group.members ? group : { ...group, members };
  });
  const areGroupsLive = groups?.every((group, g) => group === shrunk?.[g]) === true;
  const conditions = problem && live(problem.conditions, ({ patch }) => subjects.has("patch", patch));
  return {
    ...(problem &&
      conditions && { problem: conditions === problem.conditions ? problem : { ...problem, conditions } }),
    ...(groups && { groups: areGroupsLive ? groups : shrunk }),
    ...(expressions && {
      expressions: live(expressions, (one) => subjects.hasSubject(one) && subjects.hasNumber(one)),
    }),
  };
}
