/** A part of a document: a heading with the text below it, up to the next heading. */
export interface HelpSection {
  /** Id of the document. */
  readonly document: string;
  /** Number of the section in the document, from 0. */
  readonly index: number;
  readonly title: string;
  /** Markdown, with the heading. */
  readonly text: string;
  /** Other words that find it. */
  readonly words?: string;
}

/** Divides a document at its headings. Lines in code are no headings. */
export function sectionsOf(document: string, markdown: string): readonly HelpSection[] {
  const parts: string[][] = [];
  let isCode = false;
  for (const line of markdown.split("\n")) {
    if (line.trimStart().startsWith("```")) isCode = !isCode;
    const isHeading = !isCode && /^#{1,4} /.test(line);
    if (isHeading || parts.length === 0) parts.push([]);
    parts.at(-1)?.push(line);
  }
  return parts.map((lines, index) => ({
    document,
    index,
    title: plainText(lines[0] ?? ""),
    text: lines.join("\n"),
  }));
}

/** Returns a line of Markdown as it is read: without signs for headings, code, emphasis and links. */
export const plainText = (markdown: string): string =>
  markdown
    .replace(/^#+\s*/, "")
    .replaceAll(/!?\[([^\]]*)\]\([^)]*\)/g, "$1")
    .replaceAll(/[`*_|]/g, "")
    .trim();

/** The id of a heading in an address, as GitHub makes it. */
export const headingId = (title: string): string =>
  title
    .toLowerCase()
    .replaceAll(/[^\p{L}\p{N}\s-]/gu, "")
    .replaceAll(/\s/g, "-");

/** Letters of a result around the words that were found. */
const excerptLetters = 140;

export interface HelpResult {
  readonly section: HelpSection;
  readonly excerpt: string;
}

/**
 * Returns the sections that have, or are found by, words which begin with each word of a query: those with all of them in
 * the title first, then in the order of the documents. O(letters).
 */
export function searchHelp(query: string, sections: readonly HelpSection[]): readonly HelpResult[] {
  const words = query.toLowerCase().split(/\s+/).filter(Boolean);
  if (words.length === 0) return [];
  const begins = (text: string, word: string): number => {
    const lower = text.toLowerCase();
    for (let at = lower.indexOf(word); at >= 0; at = lower.indexOf(word, at + 1))
      if (at === 0 || !/[\p{L}\p{N}]/u.test(lower[at - 1] ?? "")) return at;
    return -1;
  };
  const hasAll = (text: string): boolean => words.every((word) => begins(text, word) >= 0);
  const found = sections.filter(({ title, text, words = "" }) => hasAll(`${title}\n${text}\n${words}`));
  const ordered = [
    ...found.filter(({ title }) => hasAll(title)),
    ...found.filter(({ title }) => !hasAll(title)),
  ];
  return ordered.map((section) => {
    const text = plainText(section.text.split("\n").slice(1).join(" ").replaceAll(/\s+/g, " "));
    const at = Math.max(0, begins(text, words[0] ?? ""));
    const from = Math.max(0, text.lastIndexOf(" ", Math.max(0, at - excerptLetters / 3)));
    return { section, excerpt: `${from > 0 ? "…" : ""}${text.slice(from, from + excerptLetters).trim()}…` };
  });
}
