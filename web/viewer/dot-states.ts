import { entityKey, sameEntity, type DrawnKind } from "../document/entities";
import type { ViewState } from "../document/selection";
import type { DotState } from "./layers/dots-layer";

/**
 * How the records of one kind are drawn. Where nothing of the kind is marked or hidden, as mostly with
 * the many nodes of a grid, nothing is looked up.
 */
export function dotStates(
  records: readonly { readonly id: number }[],
  kind: DrawnKind,
  { hover, hidden }: ViewState,
  selected: ReadonlySet<string>,
): readonly DotState[] {
  const prefix = entityKey({ kind, id: 0 }).slice(0, -1);
  const isConcerned = (keys: Iterable<string>): boolean => [...keys].some((key) => key.startsWith(prefix));
  if (hover?.kind !== kind && !isConcerned(hidden) && !isConcerned(selected)) {
    return new Array<DotState>(records.length).fill("normal");
  }
  return records.map(({ id }) => {
    const key = entityKey({ kind, id });
    if (hidden.has(key)) return "hidden";
    if (selected.has(key)) return "selected";
    return sameEntity(hover, { kind, id }) ? "hover" : "normal";
  });
}
