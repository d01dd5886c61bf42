/** Finds the tags of an XML file in its bytes, which may be longer than the longest possible string. */
import { indexOf, textOf } from "./text-bytes.js";

/** A tag; its quoted values may contain ">". */
const TAG = /^<(\/?)([A-Za-z][\w:.-]*)((?:"[^"<]*"|'[^'<]*'|[^<>"'])*)>$/;
export const LESS = 60;
const [GREATER, QUOTE, APOSTROPHE] = [62, 34, 39];

export type Attributes = ReadonlyMap<string, string>;

/** Returns the line of a byte, from 1. */
export function lineAt(bytes: Uint8Array, at: number): number {
  let line = 1;
  for (let i = 0; i < at; i++) {
    const byte = bytes[i];
    if (byte === 10 || (byte === 13 && bytes[i + 1] !== 10)) line++;
  }
  return line;
}

export interface Tag {
  readonly begin: number;
  readonly end: number;
  readonly isClosing: boolean;
  readonly name: string;
  readonly rest: string;
}

const COMMENT_END = new TextEncoder().encode("-->");

/** Yields the tags of elements in order; skips comments. O(n), dominated by the search for "<". */
export function* tagsIn(bytes: Uint8Array): Generator<Tag> {
  for (let at = bytes.indexOf(LESS); at >= 0;) {
    if (bytes[at + 1] === 33 && bytes[at + 2] === 45 && bytes[at + 3] === 45) {
      const end = indexOf(bytes, COMMENT_END, at + 4);
      if (end < 0) return;
      at = bytes.indexOf(LESS, end);
      continue;
    }
    const last = tagEnd(bytes, at + 1);
    const text = textOf(bytes.subarray(at, last + 1));
    const [whole, slash, name = "", rest = ""] = TAG.exec(text) ?? [];
    if (whole !== undefined) yield { begin: at, end: last + 1, isClosing: slash === "/", name, rest };
    at = bytes.indexOf(LESS, last);
  }
}

/** Returns the offset of the next ">" outside quotes, of the next "<", or of the end. */
function tagEnd(bytes: Uint8Array, from: number): number {
  let quote = 0;
  for (let at = from; at < bytes.length; at++) {
    const byte = bytes[at] ?? 0;
    if (byte === LESS || (byte === GREATER && quote === 0)) return at;
    if (byte === quote) quote = 0;
    else if (quote === 0 && (byte === QUOTE || byte === APOSTROPHE)) quote = byte;
  }
  return bytes.length;
}

/** Parses name="value" and name='value' pairs. */
export function attributesIn(text: string): Attributes {
  const pairs = text.matchAll(/([^\s="']{1,100})\s*=\s*(?:"([^"]*)"|'([^']*)')/g);
  return new Map(
    [...pairs].map(([, name = "", double, single]) => [name, unescaped(double ?? single ?? "")]),
  );
}

export function unescaped(text: string): string {
  return text.replace(/&(lt|gt|quot|apos|amp|#\d{1,7}|#x[0-9a-fA-F]{1,6});/g, (whole, name: string) => {
    const code = name.startsWith("#") ? Number(name.replace("#x", "0x").replace("#", "")) : 0;
    if (code > 0x10ffff) return whole;
    return code > 0 ? String.fromCodePoint(code) : (CHARACTERS[name] ?? "");
  });
}

const CHARACTERS: Readonly<Record<string, string>> = {
  lt: "<",
  gt: ">",
  quot: '"',
  apos: "'",
  amp: "&",
};
