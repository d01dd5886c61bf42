/** Numbers with nouns, for sentences. */

/**
 * Returns a number with its noun: "1 body", "2 bodies", "3 tetrahedra". The rules cover only the nouns of
 * Tetrafront's sentences.
 */
export function plural(count: number | string, noun: string): string {
  return `${count} ${String(count) === "1" ? noun : pluralOf(noun)}`;
}

/** Returns the plural of a noun. */
export function pluralOf(noun: string): string {
  if (noun.endsWith("hedron")) return `${noun.slice(0, -2)}a`;
  if (noun.endsWith("y")) return `${noun.slice(0, -1)}ies`;
  return noun.endsWith("ch") ? `${noun}es` : `${noun}s`;
}
