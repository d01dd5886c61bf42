import type { PaletteItem } from "./palette-items";
import { isSimilarWord } from "./similar-words";

/** Entries shown per group, of those that are only found. */
const maxPerGroup = 10;

const wordsOf = (text: string): string[] => text.toLowerCase().split(/\s+/).filter(Boolean);

const partsOf = (text: string): string[] => text.toLowerCase().split(/[^\p{L}\p{N}]+/u);

/** Returns whether words of a text begin with all words of a query. */
const beginsWords = (text: string, words: readonly string[]): boolean => {
  const starts = partsOf(text);
  return words.every(
    (word) => starts.some((start) => start.startsWith(word)) || ` ${text.toLowerCase()}`.includes(` ${word}`),
  );
};

/** Returns whether a text has all words of a query as whole words, in the singular or the plural. */
const hasWholeWords = (text: string, words: readonly string[]): boolean => {
  const parts = partsOf(text);
  return words.every((word) => parts.some((part) => singular(part) === singular(word)));
};

const singular = (word: string): string => (word.length > 2 ? word.replace(/s$/, "") : word);

/** Returns whether a text has a word like each word of a query, which may be mistyped. */
const hasSimilarWords = (text: string, words: readonly string[]): boolean => {
  const parts = partsOf(text);
  return words.every((word) => parts.some((part) => part.startsWith(word) || isSimilarWord(word, part)));
};

/** Rank of entries that a query does not find. */
const unranked = 4;

/** Returns how well an entry fits a query: 0 is best. */
function rankOf({ label, words: others }: PaletteItem, words: readonly string[]): number {
  const both = `${label} ${others}`;
  if (hasWholeWords(label, words)) return 0;
  if (hasWholeWords(both, words)) return 1;
  if (beginsWords(label, words)) return 2;
  return beginsWords(both, words) ? 3 : unranked;
}

/**
 * Returns the entries that a query finds, the best first: those with its words in the label, those with its words in all, and
 * those with words that begin with its words; disabled ones one rank later. Of equal ones, those come first that can be run,
 * then those that are listed without a query, of which first those whose label begins with it or whose group has this name. Only
 * without any, those with words that differ by a mistake in typing. Nothing is better than a loose match. O(entries).
 */
export function searchPalette(
  query: string,
  listed: readonly PaletteItem[],
  found: readonly PaletteItem[],
): readonly PaletteItem[] {
  const words = wordsOf(query);
  if (words.length === 0) return listed;
  const isListed = new Set(listed);
  const all = [...listed, ...found].map((item) => ({ item, rank: rankOf(item, words) }));
  const exact = all.filter(({ rank }) => rank < unranked);
  const best = exact.length > 0 ? exact : similar(words, all);
  const sorted = best
    .map(({ item, rank }) => {
      const { label, group } = item;
      const isDisabled = Number(item.needs !== null);
      const begins = label.toLowerCase().startsWith(words.join(" ")) || hasWholeWords(group, words);
      const place = !isListed.has(item) ? 2 : begins ? 0 : 1;
      return { item, order: [rank + isDisabled, isDisabled, place] };
    })
    .toSorted((a, b) => compared(a.order, b.order))
    .map(({ item }) => item);
  return limited(sorted, isListed);
}

/** Compares two lists of numbers by the first in which they differ. */
const compared = (a: readonly number[], b: readonly number[]): number =>
  a.map((value, i) => value - (b[i] ?? 0)).find((difference) => difference !== 0) ?? 0;

interface Ranked {
  readonly item: PaletteItem;
  readonly rank: number;
}

/** Returns the entries that have a similar word for each word of the query: those with all of them in the label rank first. */
function similar(words: readonly string[], all: readonly Ranked[]): readonly Ranked[] {
  return all.flatMap(({ item }) => {
    const { label, words: others } = item;
    if (hasSimilarWords(label, words)) return [{ item, rank: 0 }];
    return hasSimilarWords(`${label} ${others}`, words) ? [{ item, rank: 1 }] : [];
  });
}

/** Keeps all commands, disabled ones too, and the first entries of each group of others. */
function limited(items: readonly PaletteItem[], listed: ReadonlySet<PaletteItem>): readonly PaletteItem[] {
  const counts = new Map<string, number>();
  return items.filter((item) => {
    if (listed.has(item) || item.needs !== null) return true;
    const count = counts.get(item.group) ?? 0;
    counts.set(item.group, count + 1);
    return count < maxPerGroup;
  });
}

/** Returns the entries in groups, in the order of their best entries. */
export function inGroups(
  items: readonly PaletteItem[],
): readonly { readonly group: string; readonly items: readonly PaletteItem[] }[] {
  const groups = new Map<string, PaletteItem[]>();
  for (const item of items) groups.set(item.group, [...(groups.get(item.group) ?? []), item]);
  return [...groups].map(([group, members]) => ({ group, items: members }));
}
