import { hashText } from "./hash";

/**
 * The arrays of a body are texts of up to 20 MB, which many states of a document share. Each is hashed once, and packed
 * once for the storage.
 */

/** Texts from this length on count as long. */
export const minLongText = 20_000;

interface LongText {
  readonly key: string;
  blob: Blob | null;
}

/** Largest number of texts remembered: those of about ten bodies. */
const maxKnown = 32;

/** The texts used last are at the end. */
const known = new Map<string, LongText>();

function remember(text: string, entry: LongText): LongText {
  known.delete(text);
  known.set(text, entry);
  const [oldest] = known.keys();
  if (known.size > maxKnown && oldest !== undefined) known.delete(oldest);
  return entry;
}

function entryOf(text: string): LongText {
  return remember(text, known.get(text) ?? { key: keyOf(text), blob: null });
}

const keyOf = (text: string): string => `${text.length}-${hashText(text)}`;

/** Returns a text that is equal for equal texts only. */
export function textKey(text: string): string {
  return text.length < minLongText ? keyOf(text) : entryOf(text).key;
}

/** Notes the key and the blob of a text that a worker or the storage knows, so that the page need not make them. */
export function rememberText(text: string, key: string, blob: Blob): void {
  if (text.length >= minLongText) remember(text, { key, blob });
}

/** Returns a long text as a blob, which passes to workers and to the storage without a copy. */
export function blobOf(text: string): Blob {
  const entry = entryOf(text);
  entry.blob ??= new Blob([text]);
  return entry.blob;
}

/** Begins the text that stands for a long one; no name begins so. */
const mark = "\u0001text ";

/** Returns the JSON of a value without its long texts, which are added to `texts` under their keys. */
export function jsonWithout(value: unknown, texts: Map<string, string>): string {
  return JSON.stringify(value, (_, part: unknown) => {
    if (typeof part !== "string" || part.length < minLongText) return part;
    const key = textKey(part);
    texts.set(key, part);
    return mark + key;
  });
}

/** Parses what `jsonWithout` has returned. Throws if a text is missing. */
export function parseWith(json: string, texts: ReadonlyMap<string, string>): unknown {
  if (!json.includes(JSON.stringify(mark).slice(0, -1))) return JSON.parse(json);
  return JSON.parse(json, (_, part: unknown) => {
    if (typeof part !== "string" || !part.startsWith(mark)) return part;
    const text = texts.get(part.slice(mark.length));
    if (text === undefined) throw new Error("A part of the document is missing");
    return text;
  });
}
