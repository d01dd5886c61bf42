/** What a kind of figure offers to the text around it. The compiler checks lessons against it; it needs no page. */
export interface FigureDeclaration {
  /** Name of the figure for people who do not see it; a noun phrase. */
  readonly label: string;
  /** Inputs, which the block `figure` sets: numbers that can be dragged in the text, or one of some words. */
  readonly options: Readonly<Record<string, OptionDeclaration>>;
  /** Values that the figure computes: they can be shown, and used in conditions if they are numbers. */
  readonly values: Readonly<Record<string, "number" | "text">>;
  /** Keys of a state that the text can lead to (`go`), each with its words, and whether it takes a number. */
  readonly states: Readonly<Record<string, StateDeclaration>>;
  /** Parts that a word of the text can light (`mark`), with the role that gives the word its colour. */
  readonly marks: Readonly<Record<string, Role>>;
}

export type Role = "active" | "refused" | "new" | "plain";

export type OptionDeclaration =
  | { readonly type: "number"; readonly label: string }
  | { readonly type: "word"; readonly words: readonly string[] };

export interface StateDeclaration {
  readonly words: readonly string[];
  readonly takesNumber: boolean;
}

/** A number that a reader can change: where it begins, its limits and its step. */
export interface Range {
  readonly start: number;
  readonly min: number;
  readonly max: number;
  readonly step: number;
  readonly label: string;
}

/** A figure of a lesson as the compiler hands it to the page. */
export interface FigurePlan {
  readonly id: string;
  readonly kind: string;
  readonly ranges: Readonly<Record<string, Range>>;
  readonly words: Readonly<Record<string, string>>;
}

/** A state of a figure: `go:A step=end beat=0` has the entries `step` and `beat`. */
export interface Destination {
  readonly figure: string;
  readonly entries: Readonly<Record<string, string>>;
}

/** Returns the state that a text names, such as `A step=0 beat=4`; null if the text has another form. */
export function readDestination(text: string): Destination | null {
  const [figure = "", ...pairs] = text.trim().split(/\s+/);
  const entries = pairs.map((pair) => pair.split("="));
  const isReadable =
    /^[A-Z]$/.test(figure) && entries.every((entry) => entry.length === 2 && entry[1] !== "");
  return isReadable ? { figure, entries: Object.fromEntries(entries) as Record<string, string> } : null;
}
