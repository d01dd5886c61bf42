import { isDraft, original, type Draft } from "mutative";
import { entityNouns } from "../strings";
import type { DocumentContent } from "./edit";
import type { DrawnKind, Entity } from "./entities";

/** What edits need to find and to name the records that they change. */

export type Axis = 0 | 1 | 2;

/** Returns the name of an entity within a sentence: "point 12". */
export const nounOf = (kind: DrawnKind, id: number): string => `${entityNouns[kind]} ${id}`;

export type ProjectDraft = Draft<DocumentContent>["project"];

export function listOf(project: ProjectDraft, kind: DrawnKind): { id: number; name?: string | undefined }[] {
  switch (kind) {
    case "point":
      return project.points;
    case "line":
      return project.lines;
    case "patch":
      return project.patches;
    case "body":
      return project.bodies ?? [];
    case "body-patch":
      return (project.bodies ?? []).flatMap(({ patches }) => patches);
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
export function recordOf<Item extends { readonly id: number }>(list: Item[], id: number): Item | undefined {
  const records = isDraft(list) ? original(list) : list;
  return list[records.findIndex((record) => record.id === id)];
}

/** As `recordOf`, for many records: indexes the ids once. For edits that neither add nor remove records. */
export function finderIn<Item extends { readonly id: number }>(
  list: Item[],
): (id: number) => Item | undefined {
  const records = isDraft(list) ? original(list) : list;
  const indices = new Map(records.map((record, index) => [record.id, index]));
  return (id) => {
    const index = indices.get(id);
    return index === undefined ? undefined : list[index];
  };
}

type AnyRecord = ReturnType<typeof listOf>[number];

/** As `finderIn`, for records of all kinds: indexes each kind once. */
export function draftFinder(project: ProjectDraft): (entity: Entity) => AnyRecord | undefined {
  const finders = new Map<DrawnKind, (id: number) => AnyRecord | undefined>();
  return ({ kind, id }) => {
    let find = finders.get(kind);
    if (!find) finders.set(kind, (find = finderIn(listOf(project, kind))));
    return find(id);
  };
}
