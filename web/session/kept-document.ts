import { apply, type Patches } from "mutative";
import { parseProject, type Project } from "tetrafront/project";
import type { DocumentContent } from "../document/edit";
import { manyTetrahedra } from "../document/engine-input";
import { documentGrid } from "../document/large-grid";
import { packedGrid, type PackedGrid } from "../document/packed-grid";
import { blobOf, jsonWithout, parseWith, rememberText } from "../document/long-texts";
import type { OpenDocument, ProjectFile } from "./document-store";
import { differenceOf } from "./difference";
import { entryBytes, entryOf, type History, type HistoryEntry } from "./history";

/** A document in the form of the browser's storage. */
export interface KeptDocument {
  readonly id: string;
  readonly name: string;
  /** Time of the last change; milliseconds since 1970. */
  readonly at: number;
  /** 1 if Recent lists the document, 0 if it is as it was opened. IndexedDB has no keys for booleans. */
  readonly listed: 0 | 1;
  /** The project as JSON, without a large background grid and without long texts. */
  readonly text: string;
  /** The long texts of the project and of the steps, by their keys. */
  readonly longTexts?: ReadonlyMap<string, Blob>;
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
  const texts = new Map<string, string>();
  const text = jsonWithout({ ...drawn, background: stored }, texts);
  // The steps share most long texts with the project.
  const counted = new Set(texts.values());
  const undone = textsOf(history.future, maxKeptHistoryBytes, counted);
  const done = textsOf([...history.past].reverse(), maxKeptHistoryBytes - undone.bytes, counted);
  for (const { longTexts } of [undone, done]) longTexts.forEach((long, key) => texts.set(key, long));
  return {
    id,
    name: project.name,
    at: now,
    listed: isListed ? 1 : 0,
    text,
    ...(texts.size > 0 && { longTexts: new Map([...texts].map(([key, long]) => [key, blobOf(long)])) }),
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
  const { id, grid, savedKey, file, version, past, future, longTexts = new Map<string, Blob>() } = kept;
  const texts = new Map<string, string>();
  for (const [key, blob] of longTexts) {
    const text = await blob.text();
    texts.set(key, text);
    rememberText(text, key, blob);
  }
  const read = parseProject(parseWith(kept.text, texts));
  if (!read.success) return null;
  const { background } = read.value;
  const project: Project = grid
    ? { ...read.value, background: { ...background, ...(await documentGrid(grid)) } }
    : read.value;
  const isUsable = version === project.version;
  const present = { project };
  const steps = (entries: readonly string[]): StoredStep[] =>
    isUsable ? entries.map((entry) => parseWith(entry, texts) as StoredStep) : [];
  const history: History<DocumentContent> = {
    present,
    past: entriesFrom(present, steps(past).reverse(), "backward").reverse(),
    future: entriesFrom(present, steps(future), "forward"),
  };
  return { id, history, savedKey, file };
}

/** The JSON of an entry without its long texts. */
interface EntryText {
  readonly json: string;
  readonly longTexts: ReadonlyMap<string, string>;
}

/** Entries never change, so the text of each is made only once. */
const entryTexts = new WeakMap<HistoryEntry, EntryText>();

function textOf(entry: HistoryEntry): EntryText {
  let text = entryTexts.get(entry);
  if (!text) {
    const longTexts = new Map<string, string>();
    const { label, at, change } = entry;
    text = { json: jsonWithout({ label, at, change }, longTexts), longTexts };
    entryTexts.set(entry, text);
  }
  return text;
}

interface KeptEntries {
  readonly texts: string[];
  readonly bytes: number;
  readonly longTexts: ReadonlyMap<string, string>;
}

/**
 * Returns the texts of entries that fit into the limit, beginning with those closest to the current state. Long texts
 * that are already `counted` take no more room.
 */
function textsOf(entries: readonly HistoryEntry[], limit: number, counted: Set<string>): KeptEntries {
  const texts: string[] = [];
  const longTexts = new Map<string, string>();
  let bytes = 0;
  for (const entry of entries) {
    bytes += entryBytes(entry, counted);
    if (bytes > limit) return { texts, bytes: limit, longTexts };
    const text = textOf(entry);
    text.longTexts.forEach((long, key) => longTexts.set(key, long));
    texts.push(text.json);
  }
  return { texts, bytes, longTexts };
}

/** A step in the storage; earlier versions of the app have stored patches. */
type StoredStep = Pick<HistoryEntry, "label" | "at"> &
  (Pick<HistoryEntry, "change"> | { readonly forward: Patches; readonly backward: Patches });

/** Returns the entries of steps, beginning with the one next to the present. Edits after a reload never merge into them. */
function entriesFrom(
  present: DocumentContent,
  steps: readonly StoredStep[],
  direction: "forward" | "backward",
): HistoryEntry[] {
  let state = present;
  return steps.flatMap((step) => {
    const { label, at } = step;
    if ("change" in step) return entryOf({ label, mergeKey: undefined, at, change: step.change });
    const next = apply(state, step[direction]);
    const change = direction === "forward" ? differenceOf(state, next) : differenceOf(next, state);
    state = next;
    return change ? entryOf({ label, mergeKey: undefined, at, change }) : [];
  });
}
