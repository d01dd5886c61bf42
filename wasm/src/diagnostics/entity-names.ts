/** Labels of entities in messages. */
import type { EntityKind, EntityRef } from "./diagnostic.js";

/** Tells what the user calls the entity at a position. */
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
};

/** Names by number, for a given surface, whose entities nobody named. */
export const nameByIndex: EntityNamer = (kind, index) => {
  return { kind, index, label: `${KIND_WORDS[kind]} ${index}` };
};

/** As `name`, but for a background grid that came as arrays, whose nodes nobody named. */
export function gridByIndex(name: EntityNamer): EntityNamer {
  return (kind, index) =>
    kind === "background-node" || kind === "background-tetrahedron"
      ? nameByIndex(kind, index)
      : name(kind, index);
}
