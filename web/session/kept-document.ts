import { parseProject, type Project } from "tetrafront";
import type { DocumentContent } from "../document/edit";
import { manyTetrahedra } from "../document/engine-input";
import { documentGrid } from "../document/large-grid";
import { packedGrid, type PackedGrid } from "../document/packed-grid";
import type { OpenDocument, ProjectFile } from "./document-store";
import type { History, HistoryEntry } from "./history";

/** A document in the form of the browser's storage. */
export interface KeptDocument {
  readonly id: string;
  readonly name: string;
  /** Time of the last change; milliseconds since 1970. */
  readonly at: number;
  /** 1 if Recent lists the document, 0 if it is as it was opened. IndexedDB has no keys for booleans. */
  readonly listed: 0 | 1;
  /** The project as JSON. A large background grid is left out. */
  readonly text: string;
  /** The nodes and tetrahedra of a large background grid. */
  readonly grid?: PackedGrid;
  readonly savedKey: string;
  readonly file: ProjectFile | null;
  /** Version of the project file format that the steps refer to; a later version cannot use them. */
  readonly version: number;
  /** Steps of undo as JSON, the oldest first. */
  readonly past: readonly string[];
  /** Steps of redo as JSON, the next first. */
  readonly future: readonly string[];
}

/** What Recent shows of a document. */
export type DocumentSummary = Pick<KeptDocument, "id" | "name" | "at">;

/**
 * Limit of the steps stored with a document. If a step is larger, for example a new grid, it and the steps
 * beyond it are not stored.
 */
export const maxKeptHistoryBytes = 4 * 2 ** 20;

export function keptDocument(
  { id, history, savedKey, file }: OpenDocument,
  now: number,
  isListed: boolean,
): KeptDocument {
  const { project } = history.present;
  const { background, ...drawn } = project;
  const isLarge = background.tetrahedra.length > manyTetrahedra;
  const stored = isLarge ? { ...background, nodes: [], tetrahedra: [] } : background;
  const undone = textsOf(history.future, maxKeptHistoryBytes);
  const done = textsOf([...history.past].reverse(), maxKeptHistoryBytes - undone.bytes);
  return {
    id,
    name: project.name,
    at: now,
    listed: isListed ? 1 : 0,
    text: JSON.stringify({ ...drawn, background: stored }),
    ...(isLarge && { grid: packedGrid(background) }),
    savedKey,
    file,
    version: project.version,
    past: done.texts.reverse(),
    future: undone.texts,
  };
}

/** Returns the document to open, or null if its project cannot be read. */
export async function openKept(kept: KeptDocument): Promise<OpenDocument | null> {
  const read = parseProject(JSON.parse(kept.text));
  if (!read.success) return null;
  const { id, grid, savedKey, file, version, past, future } = kept;
  const { background } = read.value;
  const project: Project = grid
    ? { ...read.value, background: { ...background, ...(await documentGrid(grid)) } }
    : read.value;
  const isUsable = version === project.version;
  const history: History<DocumentContent> = {
    present: { project },
    past: isUsable ? past.map(entryOf) : [],
    future: isUsable ? future.map(entryOf) : [],
  };
  return { id, history, savedKey, file };
}

/** Entries never change, so the text of each is made only once. */
const texts = new WeakMap<HistoryEntry, string>();

/**
 * Returns the texts of entries that fit into the limit, beginning with those closest to the current state.
 */
function textsOf(entries: readonly HistoryEntry[], limit: number): { texts: string[]; bytes: number } {
  const kept: string[] = [];
  let bytes = 0;
  for (const entry of entries) {
    bytes += entry.bytes;
    if (bytes > limit) return { texts: kept, bytes: limit };
    const text = texts.get(entry) ?? JSON.stringify(entry);
    texts.set(entry, text);
    kept.push(text);
  }
  return { texts: kept, bytes };
}

/** Edits after a reload never merge into a step from before it. */
function entryOf(text: string): HistoryEntry {
  const entry = { ...(JSON.parse(text) as HistoryEntry), mergeKey: undefined };
  texts.set(entry, text);
  return entry;
}
