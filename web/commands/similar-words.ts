/** Fewest letters of a word that may have one mistake, or two. */
const minLetters = { one: 4, two: 8 } as const;
/** Fewest letters of a word that may have a wrong letter: a short one is then another word, as print and point. */
const minReplaced = 6;

/** Number of mistakes that a word of this length may have. */
const maxMistakes = (letters: number): number =>
  letters >= minLetters.two ? 2 : letters >= minLetters.one ? 1 : 0;

/**
 * Returns whether a typed word is another word with a mistake: a wrong, missing or additional letter, or two letters in the
 * wrong order. Short words may have no wrong letter, and shorter ones must be right, except for a missing letter after the first. O(product of the lengths).
 */
export function isSimilarWord(typed: string, word: string): boolean {
  if (typed[0] !== word[0] && typed.length < minLetters.two) return false;
  const isReplaced = typed.length === word.length && sorted(typed) !== sorted(word);
  if (isReplaced && word.length < minReplaced) return false;
  const most = maxMistakes(word.length);
  return Math.abs(typed.length - word.length) <= most && mistakes(typed, word) <= most;
}

const sorted = (word: string): string => [...word].sort().join("");

/**
 * Returns the optimal string alignment distance: like that of Levenshtein (1966), but letters that are exchanged with the
 * next one count once, as by Damerau (1964).
 */
function mistakes(a: string, b: string): number {
  let [before, last]: [number[], number[]] = [[], Array.from({ length: b.length + 1 }, (_, j) => j)];
  for (let i = 1; i <= a.length; ++i) {
    const row = [i];
    for (let j = 1; j <= b.length; ++j) {
      const [above = 0, diagonal = 0, left = 0] = [last[j], last[j - 1], row[j - 1]];
      const isExchanged = a[i - 1] === b[j - 2] && a[i - 2] === b[j - 1];
      const exchanged = isExchanged ? (before[j - 2] ?? Infinity) + 1 : Infinity;
      row.push(Math.min(above + 1, left + 1, diagonal + Number(a[i - 1] !== b[j - 1]), exchanged));
    }
    [before, last] = [last, row];
  }
  return last.at(-1) ?? 0;
}
