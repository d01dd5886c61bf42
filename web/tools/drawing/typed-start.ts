/** How typed coordinates begin: which keys open their field, and with which text. */
import { isReservedName, reservedNames, type NamedNumbers } from "../../expressions/expression";

/** First characters of coordinates. A space is none, because it presses buttons. */
const opensField = /^[\d@.(+-]$/;
/** Characters that continue an expression but begin none. */
const continues = /^[,;*/^<)]$/;
const isLetter = (key: string): boolean => /^[A-Za-z_]$/.test(key);

export interface TypedStart {
  /** A letter that is a hotkey and begins a name; empty without one. The next key decides what it was. */
  readonly waiting: string;
  /** The letters that were pressed in a row before and ran commands. */
  readonly letters: string;
  /** The parameters of the project. */
  readonly named: NamedNumbers;
  /** Returns whether a key runs a command. */
  readonly isHotkey: (key: string) => boolean;
}

/** What a key does while the field is closed. */
export type StartingKey =
  /** It opens the field with a text. */
  | { readonly kind: "text"; readonly text: string }
  /** It is a hotkey and begins a name: it waits for the next key. */
  | { readonly kind: "wait" }
  /** It has no meaning for coordinates. */
  | { readonly kind: "none" };

const none: StartingKey = { kind: "none" };
const text = (opening: string): StartingKey => ({ kind: "text", text: opening });

/**
 * Returns what a key does while the field is closed. `=` opens an empty field. A letter that begins a name opens it, unless
 * the letter is a hotkey, too: then it waits, and comes into the text if the next key continues the name. Otherwise, the
 * waiting letter was a hotkey. After hotkeys, a comma or operator stands alone, so that the coordinates are refused rather
 * than misread.
 */
export function startingKey(key: string, { waiting, letters, named, isHotkey }: TypedStart): StartingKey {
  if (waiting !== "" && continuesName(waiting, key, named)) return text(waiting + key);
  if (key === "=") return text("");
  if (isLetter(key)) {
    if (!beginsName(key, named)) return none;
    return isHotkey(key) ? { kind: "wait" } : text(key);
  }
  const hadLetters = letters !== "" || waiting !== "";
  return opensField.test(key) || (hadLetters && continues.test(key)) ? text(key) : none;
}

/** Returns the letters in a row after a key that was not used. */
export const lettersAfter = (letters: string, key: string): string => {
  if (isLetter(key)) return letters + key;
  return isModifier(key) ? letters : "";
};

/** Shift and the like are no interruption. */
export const isModifier = (key: string): boolean =>
  /^(?:Shift|Control|Alt|AltGraph|Meta|CapsLock)$/.test(key);

/** Returns whether a key makes a letter the beginning of an expression: of a longer name, or after a complete one. */
function continuesName(letter: string, key: string, named: NamedNumbers): boolean {
  if (/^\w$/.test(key)) return beginsName(letter + key, named);
  const isName = named.has(letter) || isReservedName(letter);
  return isName && (continues.test(key) || /^[(+-]$/.test(key));
}

/** Returns whether a text begins the name of a parameter, function or constant. */
const beginsName = (start: string, named: NamedNumbers): boolean =>
  [...named.keys()].some((name) => name.startsWith(start)) ||
  reservedNames().some((name) => name.startsWith(start.toLowerCase()));
