import type { DocumentContent } from "../document/edit";
import type { OpenDocument } from "./document-store";
import { entryBytes, type History } from "./history";
import {
  blobsOf,
  documentHead,
  keptContent,
  maxKeptHistoryBytes,
  textOf,
  type DocumentHead,
  type KeptChange,
  type KeptContent,
} from "./kept-document";

/** What a document in the storage lacks: a content, which replaces the one before and its changes, or one more change. */
export type DocumentWrite = DocumentHead &
  ({ readonly content: KeptContent } | { readonly change: NewChange });

/** A change of a content with a stamp: each visit of the page begins with one. */
type NewChange = KeptChange & { readonly stamp: string };

/** What the storage has after a write. */
export interface Stored {
  readonly id: string;
  /** Of the content. */
  readonly stamp: string;
  readonly history: History<DocumentContent>;
  /** Numbers of stored steps before and after the present. */
  readonly past: number;
  readonly future: number;
  /** Number of changes, and their length. */
  readonly changes: number;
  readonly bytes: number;
  readonly maxBytes: number;
  /** Keys of the long texts. */
  readonly texts: ReadonlySet<string>;
}

/**
 * Changes are written until they are longer than a share of the content, within limits in bytes: opening a document makes
 * all of them again.
 */
const changesPerContent = { share: 0.25, min: 128 * 2 ** 10, max: maxKeptHistoryBytes };

/** Returns what is to be written for a document, and what the storage then has. */
export function documentWrite(
  document: OpenDocument,
  stored: Stored | null,
  now: number,
  isListed: boolean,
): { readonly write: DocumentWrite; readonly stored: Stored } {
  const { id, history } = document;
  const head = documentHead(document, now, isListed);
  const changed = stored?.id === id ? withChange(stored, history) : null;
  if (changed) return { write: { ...head, change: changed.change }, stored: changed.stored };
  const content = keptContent(history);
  return { write: { ...head, content }, stored: storedWith(id, history, content) };
}

function storedWith(
  id: string,
  history: History<DocumentContent>,
  content: ReturnType<typeof keptContent>,
): Stored {
  const { stamp, past, future, text, grid, longTexts = new Map<string, Blob>() } = content;
  const blobs = [...longTexts.values()].reduce((sum, { size }) => sum + size, 0);
  const { share, min, max } = changesPerContent;
  const size = text.length + blobs + (grid ? grid.nodes.byteLength + grid.tetrahedra.byteLength : 0);
  return {
    id,
    stamp,
    history,
    past: past.length,
    future: future.length,
    changes: 0,
    bytes: 0,
    maxBytes: Math.min(Math.max(share * size, min), max),
    texts: new Set(longTexts.keys()),
  };
}

/** Returns the change that leads from what is stored to a history; null if the stored steps do not lead there, or too many do. */
function withChange(
  stored: Stored,
  history: History<DocumentContent>,
): { readonly change: NewChange; readonly stored: Stored } | null {
  const [before, after] = [stored.history, history].map(({ past, future }) => [...past, ...future]);
  if (!before || !after) return null;
  // The oldest steps may have been dropped. Redoing makes another entry of the same change.
  const dropped = Math.max(
    0,
    before.findIndex(({ change }) => change === after[0]?.change),
  );
  const first = after.findIndex(({ change }, i) => change !== before[dropped + i]?.change);
  const isCut = first >= 0 || after.length < before.length - dropped;
  const same = first >= 0 ? first : after.length;
  const present = stored.history.past.length - dropped;
  const move = (isCut ? same : history.past.length) - present;
  const added = after.slice(same);
  const undone = isCut ? history.future.length : 0;
  const [past, future] = [stored.past + move, stored.future - move];
  if (past < 0 || future < 0 || past + added.length < undone) return null;
  const counted = new Set<string>();
  const bytes = stored.bytes + added.reduce((sum, entry) => sum + entryBytes(entry, counted), 64);
  if (bytes > stored.maxBytes) return null;
  const texts = new Map(added.flatMap((entry) => [...textOf(entry).longTexts]));
  for (const key of stored.texts) texts.delete(key);
  const steps = isCut && {
    steps: added.map((entry) => textOf(entry).json),
    ...(undone > 0 && { undone }),
    ...blobsOf(texts),
  };
  return {
    change: { stamp: stored.stamp, number: stored.changes, move, ...steps },
    stored: {
      ...stored,
      history,
      past: isCut ? past + added.length - undone : past,
      future: isCut ? undone : future,
      changes: stored.changes + 1,
      bytes,
      texts: new Set([...stored.texts, ...texts.keys()]),
    },
  };
}
