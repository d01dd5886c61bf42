/**
 * Markdown with the ties of lessons: `[0.12](drag:A.size)`, `show`, `go`, `mark`, `open`, choices
 * `[[if A.size > 1: text | text]]`, and formulas between dollar signs. Ties
 * are read by rules of markdown-it of their own, because the target of a link cannot have blanks.
 */
import MarkdownIt, { type StateBlock, type StateInline, type Token } from "markdown-it";

export const tieKinds = ["drag", "show", "go", "mark", "open"] as const;
export type TieKind = (typeof tieKinds)[number];

export interface Tie {
  readonly kind: TieKind;
  readonly label: string;
  readonly target: string;
}

/** One text of a choice, and when it is shown: when no branch before it is, and its condition holds. The last one has none. */
export interface Branch {
  readonly condition: string;
  readonly text: string;
}

/** What stands in a paragraph and is neither text nor a mark of Markdown. */
export type Inline =
  | ({ readonly type: "tie" } & Tie)
  | { readonly type: "formula"; readonly tex: string; readonly isDisplayed: boolean }
  | { readonly type: "choice"; readonly branches: readonly Branch[] }
  | { readonly type: "link"; readonly address: string }
  | { readonly type: "picture"; readonly address: string }
  /** What is written like a tie, of a kind that does not exist. */
  | { readonly type: "unknown"; readonly kind: string };

/** An inline part and its line in the text, from 0. */
export interface PlacedInline {
  readonly inline: Inline;
  readonly line: number;
}

const tiePattern = /^\[([^\]]+)\]\(([a-z]+):([^)]*)\)/;
/** What is before the colon in addresses of links. */
const schemes: ReadonlySet<string> = new Set(["http", "https", "mailto"]);
const isTieKind = (kind: string): kind is TieKind => (tieKinds as readonly string[]).includes(kind);

const choicePattern = /^\[\[if\s([^]*?)\]\]/;

/** `render` returns the HTML of a tie or formula. */
export function makeMarkdown(render: (inline: Inline) => string): MarkdownIt {
  const markdown = new MarkdownIt({ html: false, typographer: true, quotes: "“”‘’" });
  markdown.inline.ruler.before("link", "choice", readChoice);
  markdown.inline.ruler.before("link", "tie", readTie);
  markdown.inline.ruler.before("escape", "formula", readFormula);
  markdown.block.ruler.before("paragraph", "formula", readDisplayedFormula, { alt: ["paragraph"] });
  const rule = (tokens: Token[], index: number): string => {
    const inline = tokens[index] && inlineOf(tokens[index]);
    return inline ? render(inline) : "";
  };
  markdown.renderer.rules["tie"] = rule;
  markdown.renderer.rules["choice"] = rule;
  markdown.renderer.rules["formula"] = rule;
  return markdown;
}

/** Returns all ties, formulas, links and pictures of a text with their lines. */
export function inlinesIn(markdown: MarkdownIt, text: string): readonly PlacedInline[] {
  return markdown.parse(text, {}).flatMap((token) => {
    const first = token.map?.[0] ?? 0;
    const own = inlineOf(token);
    if (own) return [{ inline: own, line: first }];
    let line = first;
    return (token.children ?? []).flatMap((child) => {
      if (child.type === "softbreak" || child.type === "hardbreak") line++;
      const inline = inlineOf(child);
      const placed = inline ? [{ inline, line }] : [];
      if (inline?.type === "choice") {
        placed.push(...inline.branches.flatMap(({ text }) => inlinesOf(markdown, text, line)));
        line += child.content.split("\n").length - 1;
      }
      // A label may go over two lines.
      if (inline?.type === "tie") line += inline.label.split("\n").length - 1;
      return placed;
    });
  });
}

/** Returns what stands in a branch of a choice; all of it counts as being in the line where the choice begins. */
function inlinesOf(markdown: MarkdownIt, text: string, line: number): PlacedInline[] {
  return markdown.parseInline(text, {}).flatMap(({ children }) =>
    (children ?? []).flatMap((child) => {
      const inline = inlineOf(child);
      return inline ? [{ inline, line }] : [];
    }),
  );
}

function inlineOf(token: Token): Inline | null {
  if (token.type === "tie") {
    const { kind, label, target } = token.meta as Omit<Tie, "kind"> & { readonly kind: string };
    return isTieKind(kind) ? { type: "tie", kind, label, target } : { type: "unknown", kind };
  }
  if (token.type === "formula") return { type: "formula", tex: token.content, isDisplayed: token.block };
  if (token.type === "choice") return { type: "choice", branches: token.meta as readonly Branch[] };
  if (token.type === "link_open") return { type: "link", address: token.attrGet("href") ?? "" };
  if (token.type === "image") return { type: "picture", address: token.attrGet("src") ?? "" };
  return null;
}

function readTie(state: StateInline, isSilent: boolean): boolean {
  const found = tiePattern.exec(state.src.slice(state.pos));
  if (!found) return false;
  const [whole, label = "", kind = "", target = ""] = found;
  if (schemes.has(kind)) return false;
  if (!isSilent) {
    const token = state.push("tie", "", 0);
    token.meta = { kind, label, target: target.trim() };
  }
  state.pos += whole.length;
  return true;
}

/** Reads `[[if CONDITION: text | if CONDITION: text | text]]`. */
function readChoice(state: StateInline, isSilent: boolean): boolean {
  const [whole, inner] = choicePattern.exec(state.src.slice(state.pos)) ?? [];
  if (whole === undefined || inner === undefined) return false;
  if (!isSilent) {
    const token = state.push("choice", "", 0);
    token.content = whole;
    token.meta = `if ${inner}`.split("|").map((part): Branch => {
      const [head, condition = ""] = /^\s*if\s+([^:]*):/.exec(part) ?? ["", ""];
      return { condition: condition.trim(), text: part.slice(head.length).trim() };
    });
  }
  state.pos += whole.length;
  return true;
}

function readFormula(state: StateInline, isSilent: boolean): boolean {
  const [whole, tex = ""] = /^\$((?:\\.|[^$\\])+)\$/.exec(state.src.slice(state.pos)) ?? [];
  if (whole === undefined) return false;
  if (!isSilent) state.push("formula", "", 0).content = tex;
  state.pos += whole.length;
  return true;
}

function readDisplayedFormula(state: StateBlock, first: number, last: number, isSilent: boolean): boolean {
  const lineAt = (line: number): string =>
    state.src.slice((state.bMarks[line] ?? 0) + (state.tShift[line] ?? 0), state.eMarks[line]).trim();
  if (lineAt(first) !== "$$") return false;
  let end = first + 1;
  while (end < last && lineAt(end) !== "$$") end++;
  if (end >= last) return false;
  if (isSilent) return true;
  const token = state.push("formula", "", 0);
  token.block = true;
  token.content = state.getLines(first + 1, end, 0, false);
  token.map = [first, end + 1];
  state.line = end + 1;
  return true;
}
