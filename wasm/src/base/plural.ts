/** Counts with their nouns, for sentences. */

/** "1 body", "2 bodies", "3 tetrahedra". The noun is one of those that sentences here count; O(1). */
export function plural(count: number | string, noun: string): string {
  return `${count} ${String(count) === "1" ? noun : pluralOf(noun)}`;
}

/** The noun in the plural. */
export function pluralOf(noun: string): string {
  if (noun.endsWith("hedron")) return `${noun.slice(0, -2)}a`;
  if (noun.endsWith("y")) return `${noun.slice(0, -1)}ies`;
  return noun.endsWith("ch") ? `${noun}es` : `${noun}s`;
}
