import Fuse from "fuse.js";
import type { PaletteItem } from "./palette-items";

/** Entries shown per group, of those that are only found. */
const maxPerGroup = 8;
/** Share of a word that may differ: 0 for none, 1 for all. */
const tolerance = 0.34;

const wordsOf = (query: string): string[] => query.toLowerCase().split(/\s+/).filter(Boolean);

/** Returns whether a text contains all words, in any order. */
const hasWords = (text: string, words: readonly string[]): boolean =>
  words.every((word) => text.toLowerCase().includes(word));

/** Returns whether words of a text begin with all words of a query. */
const beginsWords = (text: string, words: readonly string[]): boolean => {
  const starts = text.toLowerCase().split(/[^\p{L}\p{N}]+/u);
  return words.every(
    (word) => starts.some((start) => start.startsWith(word)) || ` ${text.toLowerCase()}`.includes(` ${word}`),
  );
};

/** Returns how well an entry fits a query: 0 is best, 4 is not at all. */
function rankOf({ label, words: others }: PaletteItem, words: readonly string[]): number {
  const both = `${label} ${others}`;
  if (beginsWords(label, words)) return 0;
  if (beginsWords(both, words)) return 1;
  if (hasWords(label, words)) return 2;
  return hasWords(both, words) ? 3 : 4;
}

/**
 * Returns the entries that a query finds, the best first: those with a label whose words begin with those of the query, then
 * those with other words for them, then those that contain them within words; only without any, those that are spelled
 * similarly. Entries that can be run come before disabled ones. O(entries).
 */
export function searchPalette(
  query: string,
  listed: readonly PaletteItem[],
  found: readonly PaletteItem[],
): readonly PaletteItem[] {
  const words = wordsOf(query);
  if (words.length === 0) return listed;
  const all = [...listed, ...found];
  const ranked = all.map((item) => ({ item, rank: rankOf(item, words) })).filter(({ rank }) => rank < 4);
  const exact = ranked.toSorted((a, b) => a.rank - b.rank).map(({ item }) => item);
  const best = exact.length > 0 ? exact : similar(words, all);
  const isDisabled = ({ needs }: PaletteItem): boolean => needs !== null;
  const ordered = [...best.filter((item) => !isDisabled(item)), ...best.filter(isDisabled)];
  return limited(ordered, new Set(listed));
}

/** What a similar word counts less if it is not in the label: just enough to decide between equals. */
const otherWords = 1e-3;

/** Returns the entries with a similar word for each word of the query, the most similar first; of equals, as they are given. */
function similar(words: readonly string[], items: readonly PaletteItem[]): PaletteItem[] {
  // A word counts once, also if it is in the label and among the other words.
  const texts = items.flatMap((item) => [
    { item, text: item.label, handicap: 0 },
    { item, text: item.words, handicap: otherWords },
  ]);
  const fuse = new Fuse(texts, {
    keys: ["text"],
    // The nearest word wins, however many others there are.
    ignoreFieldNorm: true,
    threshold: tolerance,
    ignoreLocation: true,
    includeScore: true,
    minMatchCharLength: 2,
  });
  const scores = words.map((word) => {
    const best = new Map<PaletteItem, number>();
    for (const { item: found, score = 1 } of fuse.search(word)) {
      const { item, handicap } = found;
      best.set(item, Math.min(best.get(item) ?? Infinity, score + handicap));
    }
    return best;
  });
  const scoreOf = (item: PaletteItem): number =>
    scores.reduce((sum, best) => sum + (best.get(item) ?? Infinity), 0);
  return items
    .map((item) => ({ item, score: scoreOf(item) }))
    .filter(({ score }) => score < Infinity)
    .toSorted((a, b) => a.score - b.score)
    .map(({ item }) => item);
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
