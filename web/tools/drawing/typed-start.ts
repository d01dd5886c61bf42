/** How typed coordinates begin: which keys open their field, and with which text. */
import { isReservedName, reservedNames, type NamedNumbers } from "../../expressions/expression";

/** First characters of coordinates. A space is none, because it presses buttons. */
const opensField = /^[\d@.(+-]$/;
/** Characters that continue an expression but begin none. */
const continues = /^[,;*/^<)]$/;
const isLetter = (key: string): boolean => /^[A-Za-z_]$/.test(key);

export interface TypedStart {
  /** The letters pressed before, which may have run commands. */
  readonly letters: string;
  /** The parameters of the project. */
  readonly named: NamedNumbers;
  /** Returns whether a key runs a command. */
  readonly isHotkey: (key: string) => boolean;
}

/**
 * Returns the text with which a key opens the field; null if the key does not open it. `=` opens an empty field. A letter
 * that begins a name opens it if it is no hotkey. Letters that were hotkeys but form a name come into the text. Without a
 * name, a comma or operator after letters stands alone, so that the coordinates are refused rather than misread.
 */
export function typedStart(key: string, { letters, named, isHotkey }: TypedStart): string | null {
  if (key === "=") return "";
  if (isLetter(key)) return beginsName(letters + key, named) && !isHotkey(key) ? letters + key : null;
  const isName = named.has(letters) || isReservedName(letters);
  if (opensField.test(key)) {
    // One letter is more likely the hotkey of the tool.
    const isExpression = isName && letters.length > 1 && /^[(+-]$/.test(key);
    return isExpression ? letters + key : key;
  }
  if (letters === "" || !continues.test(key)) return null;
  return isName ? letters + key : key;
}

/** Returns the letters in a row after a key. */
export const lettersAfter = (letters: string, key: string): string => {
  if (isLetter(key)) return letters + key;
  // Shift and the like are no interruption.
  return key === "Shift" ? letters : "";
};

/** Returns whether a text begins the name of a parameter, function or constant. */
const beginsName = (text: string, named: NamedNumbers): boolean =>
  [...named.keys()].some((name) => name.startsWith(text)) ||
  reservedNames().some((name) => name.startsWith(text.toLowerCase()));
