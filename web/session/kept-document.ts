import { apply, type Patches } from "mutative";
import { parseProject, type Project } from "tetrafront/project";
import { documentKey } from "../document/content-keys";
import type { DocumentContent } from "../document/edit";
import { manyTetrahedra } from "../document/engine-input";
import { documentGrid } from "../document/large-grid";
import { packedGrid, type PackedGrid } from "../document/packed-grid";
import { blobOf, jsonWithout, parseWith, rememberText } from "../document/long-texts";
import { differenceOf } from "./difference";
import { newDocumentId, type OpenDocument, type ProjectFile } from "./document-store";
import { entryBytes, entryOf, goBy, startHistory, type History, type HistoryEntry } from "./history";

/** A document in the browser's storage: a small record that every write replaces, its content, and the changes since. */
export interface KeptDocument extends DocumentHead {
  readonly content: KeptContent;
  /** In the order in which they were made; those of other contents may be among them. */
  readonly changes: readonly KeptChange[];
}

export interface DocumentHead {
  readonly id: string;
  readonly name: string;
  /** Time of the last change; milliseconds since 1970. */
  readonly at: number;
  /** 1 if Recent lists the document, 0 if it is as it was opened. IndexedDB has no keys for booleans. */
  readonly listed: 0 | 1;
  readonly savedKey: string;
  readonly file: ProjectFile | null;
  /** If the document is as it was opened: opened again, the same file replaces it. Earlier versions of the app have stored none. */
  readonly isUnchanged?: boolean;
}

type LongTexts = ReadonlyMap<string, Blob>;

/** A project with its steps of undo. */
export interface KeptContent {
  /** Random, so that no two contents have the same; earlier versions of the app have stored none. */
  readonly stamp?: string;
  /** The project as JSON, without a large background grid and without long texts. */
  readonly text: string;
  /** The long texts of the project and of the steps, by their keys. */
  readonly longTexts?: LongTexts;
  /** The nodes and tetrahedra of a large background grid. */
  readonly grid?: PackedGrid;
  /** Version of the project file format that the steps refer to; a later version cannot use them. */
  readonly version: number;
  /** Steps of undo as JSON, the oldest first. */
  readonly past: readonly string[];
  /** Steps of redo as JSON, the next first. */
  readonly future: readonly string[];
}

/** What edits, undo and redo have made of the content and the changes before. */
export interface KeptChange {
  /** The stamp of the content that the change continues. */
  readonly stamp?: string;
  /** Counts the changes of a content, from 0. */
  readonly number: number;
  /** Number of steps to redo, or to undo if negative. */
  readonly move: number;
  /** New steps as JSON, in place of those that could be redone. */
  readonly steps?: readonly string[];
  /** Number of new steps that are undone again. */
  readonly undone?: number;
  /** The long texts of the new steps that the content and the changes before do not have. */
  readonly longTexts?: LongTexts;
}

/** What Recent shows of a document. */
export type DocumentSummary = Pick<DocumentHead, "id" | "name" | "at">;

/**
 * Limit of the steps stored with a content. If a step is larger, for example a new grid, it and the steps
 * beyond it are not stored.
 */
export const maxKeptHistoryBytes = 4 * 2 ** 20;

export function documentHead(
  { id, history: { past, present, future }, savedKey, file }: OpenDocument,
  at: number,
  isListed: boolean,
): DocumentHead {
  const isUnchanged = past.length === 0 && future.length === 0 && documentKey(present.project) === savedKey;
  return {
    id,
    name: present.project.name,
    at,
    listed: isListed ? 1 : 0,
    savedKey,
    file,
    isUnchanged,
  };
}

export function keptContent({ present: { project }, past, future }: History<DocumentContent>) {
  const isLarge = project.background.tetrahedra.length > manyTetrahedra;
  const texts = new Map<string, string>();
  const text = jsonWithout(isLarge ? withGrid(project, noGrid) : project, texts);
  // The steps share most long texts with the project.
  const counted = new Set(texts.values());
  const undone = keptSteps(future, maxKeptHistoryBytes, counted);
  const done = keptSteps(past.toReversed(), maxKeptHistoryBytes - undone.bytes, counted);
  for (const { longTexts } of [...undone.steps, ...done.steps])
    longTexts.forEach((long, key) => texts.set(key, long));
  return {
    stamp: newDocumentId(),
    text,
    ...blobsOf(texts),
    ...(isLarge && { grid: packedGrid(project.background) }),
    version: project.version,
    past: done.steps.map(({ json }) => json).reverse(),
    future: undone.steps.map(({ json }) => json),
  } satisfies KeptContent;
}

const noGrid = { nodes: [], tetrahedra: [] };

const withGrid = (
  project: Project,
  { nodes, tetrahedra }: Pick<Project["background"], "nodes" | "tetrahedra">,
): Project => ({ ...project, background: { ...project.background, nodes, tetrahedra } });

/** Returns long texts in the form of the storage; without any, nothing. */
export const blobsOf = (texts: ReadonlyMap<string, string>): { readonly longTexts?: LongTexts } =>
  texts.size > 0 ? { longTexts: new Map([...texts].map(([key, long]) => [key, blobOf(long)])) } : {};

/**
 * Returns the document to open, or null if the project of its content cannot be read. If a change cannot be made, or leads to
 * a project that cannot be read, the document is as before that change.
 */
export async function openKept(kept: KeptDocument): Promise<OpenDocument | null> {
  const { id, file, content } = kept;
  const texts = new Map<string, string>();
  await readTexts(content, texts);
  const project = parseWith(content.text, texts) as Project;
  const grid = content.grid && (await documentGrid(content.grid));
  const stored = historyOf({ project: grid ? withGrid(project, grid) : project }, content, texts);
  const changes = continuing(kept);
  // The content may have an earlier version, which the changes refer to: only the result can be brought to the present one.
  const readLast = ({ present: { project: last } }: History<DocumentContent>): Project | null => {
    const read = parseProject(grid ? withGrid(last, noGrid) : last);
    return read.success ? (grid ? withGrid(read.value, last.background) : read.value) : null;
  };
  let history = await historyWith(stored, changes, texts, () => true);
  // Reading the project after each change takes long, and is seldom necessary.
  if (!readLast(history))
    history = await historyWith(stored, changes, texts, (next) => readLast(next) !== null);
  const value = readLast(history);
  if (!value) return null;
  const present = { project: value };
  // An earlier version of the app may have made other keys.
  const savedKey = kept.listed === 1 ? kept.savedKey : documentKey(present.project);
  const isUsable = content.version === value.version;
  return { id, history: isUsable ? { ...history, present } : startHistory(present), savedKey, file };
}

/** Returns the changes that continue the content, without a gap. */
function continuing({ content, changes }: KeptDocument): readonly KeptChange[] {
  const own = changes.filter(({ stamp }) => stamp === content.stamp);
  const gap = own.findIndex(({ number }, i) => number !== i);
  return gap < 0 ? own : own.slice(0, gap);
}

/** Returns the history after the changes before the first that cannot be made, or whose result is not accepted. */
async function historyWith(
  stored: History<DocumentContent>,
  changes: readonly KeptChange[],
  texts: Map<string, string>,
  accepts: (history: History<DocumentContent>) => boolean,
): Promise<History<DocumentContent>> {
  let history = stored;
  try {
    for (const change of changes) {
      await readTexts(change, texts);
      const next = historyAfter(history, change, texts);
      if (!accepts(next)) return history;
      history = next;
    }
  } catch {
    // The content and the changes before are sound.
  }
  return history;
}

async function readTexts(
  { longTexts = new Map<string, Blob>() }: { readonly longTexts?: LongTexts },
  texts: Map<string, string>,
): Promise<void> {
  for (const [key, blob] of longTexts) {
    const text = await blob.text();
    texts.set(key, text);
    rememberText(text, key, blob);
  }
}

type Texts = ReadonlyMap<string, string>;

function historyOf(
  present: DocumentContent,
  { past, future }: KeptContent,
  texts: Texts,
): History<DocumentContent> {
  return {
    present,
    past: entriesFrom(present, stepsOf(past, texts).reverse(), "backward").reverse(),
    future: entriesFrom(present, stepsOf(future, texts), "forward"),
  };
}

function historyAfter(
  before: History<DocumentContent>,
  { move, steps, undone = 0 }: KeptChange,
  texts: Texts,
): History<DocumentContent> {
  if (-move > before.past.length || move > before.future.length) throw new Error("A step is missing");
  const moved = goBy(before, move);
  if (!steps) return moved;
  const future = entriesFrom(moved.present, stepsOf(steps, texts), "forward");
  return goBy({ ...moved, future }, future.length - undone);
}

/** The JSON of an entry without its long texts. */
interface EntryText {
  readonly json: string;
  readonly longTexts: ReadonlyMap<string, string>;
}

/** Entries never change, so the text of each is made only once. */
const entryTexts = new WeakMap<HistoryEntry, EntryText>();

export function textOf(entry: HistoryEntry): EntryText {
  let text = entryTexts.get(entry);
  if (!text) {
    const longTexts = new Map<string, string>();
    const { label, at, change } = entry;
    text = { json: jsonWithout({ label, at, change }, longTexts), longTexts };
    entryTexts.set(entry, text);
  }
  return text;
}

/**
 * Returns the texts of entries that fit into the limit, beginning with those closest to the current state, and how much of it
 * they take. Long texts that are already `counted` take no more room.
 */
function keptSteps(
  entries: readonly HistoryEntry[],
  limit: number,
  counted: Set<string>,
): { readonly steps: readonly EntryText[]; readonly bytes: number } {
  const steps: EntryText[] = [];
  let bytes = 0;
  for (const entry of entries) {
    bytes += entryBytes(entry, counted);
    if (bytes > limit) return { steps, bytes: limit };
    steps.push(textOf(entry));
  }
  return { steps, bytes };
}

/** A step in the storage; earlier versions of the app have stored patches. */
type StoredStep = Pick<HistoryEntry, "label" | "at"> &
  (Pick<HistoryEntry, "change"> | { readonly forward: Patches; readonly backward: Patches });

const stepsOf = (steps: readonly string[], texts: Texts): StoredStep[] =>
  steps.map((step) => parseWith(step, texts) as StoredStep);

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
