import type { Project } from "tetrafront/project";

/** Returns the groups and the problem of a project in which several patches stand for one. */
export function withHeirs(
  { groups, problem }: Pick<Project, "groups" | "problem">,
  heirs: ReadonlyMap<number, readonly number[]>,
): Partial<Pick<Project, "groups" | "problem">> {
  const heirsOf = (id: number): readonly number[] => heirs.get(id) ?? [id];
  return {
    ...(groups && {
      groups: groups.map((group) => ({
        ...group,
        members: group.members.flatMap((member) =>
          member.kind === "patch" ? heirsOf(member.id).map((id) => ({ ...member, id })) : [member],
        ),
      })),
    }),
    ...(problem && {
      problem: {
        ...problem,
        conditions: problem.conditions.flatMap((condition) =>
          heirsOf(condition.patch).map((patch) => ({ ...condition, patch })),
        ),
      },
    }),
  };
}
