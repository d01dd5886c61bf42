import type { Project } from "tetrafront/project";
import { formatCount } from "../../strings/format";

/** What lines and patches of a recorded model are called after their noun: their name in quotes, or their id. By index. */
export interface EntityLabels {
  readonly lines: readonly string[];
  readonly patches: readonly string[];
}

export function entityLabels({ lines, patches }: Project): EntityLabels {
  return { lines: lines.map(labelOf), patches: patches.map(labelOf) };
}

/** Returns the label of an index; without labels, which a trace from a file lacks, entities count from 1. */
export function labelAt(labels: readonly string[] | undefined, index: number): string {
  return labels?.[index] ?? formatCount(index + 1);
}

function labelOf({ id, name = "" }: { readonly id: number; readonly name?: string | undefined }): string {
  return name.trim() === "" ? formatCount(id) : `“${name}”`;
}
