/** Conditions on steps, written as text, such as `size < 0.02 and refused: crosses`: where playing pauses, and jumps lead. */
import type { EdgeRefusal } from "tetrafront/trace";
import { edgeRefusals } from "./refusals";

/** What a condition can name by its number: as the app shows it, so that patches and lines count from 1. */
const things = ["face", "edge", "node", "element", "patch", "line"] as const;
/** What a condition can compare with a number. */
const quantities = ["size", "layer", "candidates", "front"] as const;
const relations = ["<=", ">=", "<", ">", "="] as const;
/** What can happen in a step. */
const happenings = ["accepted", "postponed", "new node", "recovery"] as const;

export type Condition =
  /** Every part holds, or at least one. */
  | { readonly kind: "all" | "any"; readonly parts: readonly Condition[] }
  | { readonly kind: "is"; readonly thing: (typeof things)[number]; readonly index: number }
  | {
      readonly kind: "compare";
      readonly quantity: (typeof quantities)[number];
      readonly relation: (typeof relations)[number];
      readonly value: number;
    }
  | { readonly kind: "happens"; readonly what: (typeof happenings)[number] }
  /** A candidate is refused; for any reason if the reason is null. */
  | { readonly kind: "refused"; readonly reason: EdgeRefusal | null };

/** Why a text is no condition. */
export interface ConditionError {
  readonly expected: "condition" | "number" | "index" | "relation" | "reason" | "end";
  /** The word found instead; empty at the end of the text. */
  readonly found: string;
  /** Where it begins in the text, from 0. */
  readonly at: number;
}

export type ParsedCondition =
  | { readonly success: true; readonly condition: Condition }
  | { readonly success: false; readonly error: ConditionError };

interface Word {
  readonly text: string;
  readonly at: number;
}

/**
 * Returns the condition that a text describes, or the first word that does not fit. `and` binds closer than `or`; case does
 * not matter.
 *
 *     parseCondition("refused: crosses or face 214")
 */
export function parseCondition(text: string): ParsedCondition {
  try {
    return { success: true, condition: new Parser(text).parse() };
  } catch (error) {
    if (error instanceof Mismatch) return { success: false, error: error.error };
    throw error;
  }
}

class Mismatch extends Error {
  constructor(readonly error: ConditionError) {
    super(error.expected);
  }
}

class Parser {
  readonly #words: readonly Word[];
  readonly #end: Word;
  #next = 0;

  constructor(text: string) {
    const pattern =
      /[a-z]+(?:-[a-z]+)*|\d{1,3}(?:,\d{3})+(?![\d.,])|[-+]?(?:\d+\.?\d*|\.\d+)(?:e[-+]?\d+)?|<=|>=|\S/giu;
    this.#words = Array.from(text.matchAll(pattern), (match) => ({
      text: match[0].toLowerCase(),
      at: match.index,
    }));
    this.#end = { text: "", at: text.length };
  }

  parse(): Condition {
    const condition = this.#joined("or", "any", () => this.#joined("and", "all", () => this.#term()));
    if (this.#word.text !== "") this.#fail("end");
    return condition;
  }

  #joined(word: string, kind: "all" | "any", part: () => Condition): Condition {
    const parts = [part()];
    while (this.#takes(word)) parts.push(part());
    return parts.length === 1 && parts[0] ? parts[0] : { kind, parts };
  }

  #term(): Condition {
    const thing = this.#oneOf(things);
    if (thing) return { kind: "is", thing, index: this.#number("index") };
    const quantity = this.#oneOf(quantities);
    if (quantity) {
      const relation = this.#oneOf(relations) ?? this.#fail("relation");
      return { kind: "compare", quantity, relation, value: this.#number("number") };
    }
    if (this.#takes("refused"))
      return { kind: "refused", reason: this.#takes(":") ? (this.#reason() ?? this.#fail("reason")) : null };
    const what = happenings.find((words) => this.#takesAll(words));
    if (what) return { kind: "happens", what };
    return { kind: "refused", reason: this.#reason() ?? this.#fail("condition") };
  }

  #reason(): EdgeRefusal | undefined {
    return edgeRefusals.find((reason) => this.#takes(reason) || this.#takesAll(reason.replace("-", " ")));
  }

  #number(expected: "index" | "number"): number {
    // The app itself separates thousands by commas.
    const value = Number(this.#word.text.replaceAll(/(?<=\d),(?=\d)/gu, ""));
    const isValid =
      this.#word.text !== "" && (expected === "number" ? Number.isFinite(value) : isIndex(value));
    if (!isValid) this.#fail(expected);
    this.#next++;
    return value;
  }

  #oneOf<T extends string>(choices: readonly T[]): T | undefined {
    return choices.find((choice) => this.#takes(choice));
  }

  #takes(text: string): boolean {
    if (this.#word.text !== text) return false;
    this.#next++;
    return true;
  }

  /** Takes words separated by blanks, or none of them. */
  #takesAll(text: string): boolean {
    const words = text.split(" ");
    if (!words.every((word, i) => this.#words[this.#next + i]?.text === word)) return false;
    this.#next += words.length;
    return true;
  }

  get #word(): Word {
    return this.#words[this.#next] ?? this.#end;
  }

  #fail(expected: ConditionError["expected"]): never {
    throw new Mismatch({ expected, found: this.#word.text, at: this.#word.at });
  }
}

const isIndex = (value: number): boolean => Number.isInteger(value) && value >= 0;
