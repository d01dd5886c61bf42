/** Labels of entities in messages. */
import type { EntityKind } from "../generated/constants.js";
import type { EntityRef } from "./diagnostic.js";

/** Returns the label, and if it has one the id, of the entity with this index. */
export type EntityNamer = (kind: EntityKind, index: number) => EntityRef;

export const KIND_WORDS: Readonly<Record<EntityKind, string>> = {
  point: "point",
  line: "line",
  patch: "patch",
  "background-node": "background node",
  "background-tetrahedron": "background tetrahedron",
  triangle: "triangle",
  "surface-node": "surface node",
  source: "source",
  node: "node",
  tetrahedron: "tetrahedron",
};

/** Returns what messages call an entity of a project: `line "lip"` or, without a name, `line 12`. */
export function entityLabel(
  word: string,
  { id, name = "" }: { readonly id: number; readonly name?: string | undefined },
): string {
  return name === "" ? `${word} ${id}` : `${word} "${name}"`;
}

/** Names entities by index, for a given surface, whose entities have no names. */
export const nameByIndex: EntityNamer = (kind, index) => {
  return { kind, index, label: `${KIND_WORDS[kind]} ${index}` };
};

/** As `name`, but names the nodes and tetrahedra of the background grid by index, for a grid given as arrays. */
export function gridByIndex(name: EntityNamer): EntityNamer {
  return (kind, index) =>
    kind === "background-node" || kind === "background-tetrahedron"
      ? nameByIndex(kind, index)
      : name(kind, index);
}
