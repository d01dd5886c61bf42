import type { PaletteItem } from "./palette-items";
import { isSimilarWord } from "./similar-words";

/** Entries shown per group, of those that are only found. */
const maxPerGroup = 8;

const wordsOf = (text: string): string[] => text.toLowerCase().split(/\s+/).filter(Boolean);

const partsOf = (text: string): string[] => text.toLowerCase().split(/[^\p{L}\p{N}]+/u);

/** Returns whether words of a text begin with all words of a query. */
const beginsWords = (text: string, words: readonly string[]): boolean => {
  const starts = partsOf(text);
  return words.every(
    (word) => starts.some((start) => start.startsWith(word)) || ` ${text.toLowerCase()}`.includes(` ${word}`),
  );
};

/** Returns whether a text has all words of a query as whole words. */
const hasWholeWords = (text: string, words: readonly string[]): boolean => {
  const parts = partsOf(text);
  return words.every((word) => parts.includes(word));
};

/** Returns whether a text has a word like each word of a query, which may be mistyped. */
const hasSimilarWords = (text: string, words: readonly string[]): boolean => {
  const parts = partsOf(text);
  return words.every((word) => parts.some((part) => part.startsWith(word) || isSimilarWord(word, part)));
};

/** Returns how well an entry fits a query: 0 is best, 3 is not at all. */
function rankOf({ label, words: others }: PaletteItem, words: readonly string[]): number {
  const both = `${label} ${others}`;
  if (beginsWords(label, words)) return 0;
  if (hasWholeWords(both, words)) return 1;
  return beginsWords(both, words) ? 2 : 3;
}

/**
 * Returns the entries that a query finds, the best first: those with a label whose words begin with those of the query, then
 * those with other words that do; only without any, those with words that differ by a mistake in typing. Nothing is better than a loose match. Entries that can be run come before disabled ones. O(entries).
 */
export function searchPalette(
  query: string,
  listed: readonly PaletteItem[],
  found: readonly PaletteItem[],
): readonly PaletteItem[] {
  const words = wordsOf(query);
  if (words.length === 0) return listed;
  const all = [...listed, ...found];
  const ranked = all.map((item) => ({ item, rank: rankOf(item, words) })).filter(({ rank }) => rank < 3);
  const exact = ranked.toSorted((a, b) => a.rank - b.rank).map(({ item }) => item);
  const best = exact.length > 0 ? exact : similar(words, all);
  const isDisabled = ({ needs }: PaletteItem): boolean => needs !== null;
  const ordered = [...best.filter((item) => !isDisabled(item)), ...best.filter(isDisabled)];
  return limited(ordered, new Set(listed));
}

/** Returns the entries that have a similar word for each word of the query: those with all of them in the label first. */
function similar(words: readonly string[], items: readonly PaletteItem[]): PaletteItem[] {
  const isIn = (text: string): boolean => hasSimilarWords(text, words);
  const inLabel = items.filter(({ label }) => isIn(label));
  const elsewhere = items.filter(({ label, words: others }) => !isIn(label) && isIn(`${label} ${others}`));
  return [...inLabel, ...elsewhere];
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
