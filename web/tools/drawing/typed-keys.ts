import type { NamedNumbers } from "../../expressions/expression";
import type { ScreenPoint } from "../../viewer/screen";
import type { Drawing } from "./drawing";
import { isModifier, lettersAfter, startingKey } from "./typed-start";

/** The command of a hotkey. */
export interface Hotkey {
  readonly label: string;
  readonly run: () => void;
}

type Key = Pick<KeyboardEvent, "key" | "shiftKey">;

export interface TypedKeysOptions {
  readonly drawing: Drawing;
  /** Returns the parameters of the project. */
  readonly named: () => NamedNumbers;
  /** Returns the command that a key without Ctrl and Alt would run; null if there is none. */
  readonly hotkeyOf: (key: Key) => Hotkey | null;
}

/** Time after which a waiting letter counts as a hotkey, in milliseconds. */
const waitingTime = 700;
/** So does one after which the pointer moves farther than this, in CSS pixels. */
const stillness = 4;

/**
 * Passes keys to the coordinate field while it is closed, or not in the page yet. Most letters stay hotkeys. A hotkey that
 * also begins the name of a parameter, function or constant waits for the next key: if that continues the name, both open
 * the field. Otherwise, or after a moment, or by Enter, its command runs.
 */
export class TypedKeys {
  readonly #options: TypedKeysOptions;
  #waiting: { readonly letter: string; readonly hotkey: Hotkey; readonly pointer: ScreenPoint } | null = null;
  #timer: ReturnType<typeof setTimeout> | undefined;

  constructor(options: TypedKeysOptions) {
    this.#options = options;
  }

  /**
   * Returns whether coordinates use a key. Keys with Ctrl, Alt or Command must not be given. Without hotkeys, a letter that
   * begins a name opens the field at once.
   */
  use(event: Key, hasHotkeys = true): boolean {
    const { drawing } = this.#options;
    const { typed } = drawing.state.getState();
    return typed === null ? this.#start(event, hasHotkeys) : this.#continue(typed, event.key);
  }

  /** Runs the command of the waiting letter. Returns whether there was one. */
  flush(): boolean {
    const waiting = this.#waiting;
    this.drop();
    if (!waiting) return false;
    this.#options.drawing.letters = waiting.letter;
    waiting.hotkey.run();
    return true;
  }

  /** Runs the command of the waiting letter if the pointer has moved since. Returns whether it did. */
  flushAt(at: ScreenPoint): boolean {
    const from = this.#waiting?.pointer ?? at;
    return Math.hypot(at.x - from.x, at.y - from.y) > stillness && this.flush();
  }

  /** Forgets the waiting letter. Returns whether there was one. */
  drop(): boolean {
    clearTimeout(this.#timer);
    if (!this.#waiting) return false;
    this.#waiting = null;
    this.#options.drawing.state.setState({ waiting: null });
    return true;
  }

  /** The field opens with the next picture; keys pressed before belong to it. */
  #continue(typed: string, key: string): boolean {
    const { drawing } = this.#options;
    if (key.length === 1) drawing.type(typed + key);
    else if (key === "Backspace") drawing.type(typed.slice(0, -1));
    else if (key === "Escape") drawing.type(null);
    else if (key === "Enter") drawing.submit();
    else if (key === "Tab") drawing.next();
    else return false;
    return true;
  }

  #start(event: Key, hasHotkeys = true): boolean {
    const { key } = event;
    if (this.#waiting && isModifier(key)) return false;
    if (this.#waiting && (key === "Escape" || key === "Backspace")) return this.drop();
    if (this.#waiting && key === "Enter") return this.flush();
    const { drawing, named, hotkeyOf } = this.#options;
    const hotkey = hasHotkeys ? hotkeyOf(event) : null;
    const start = startingKey(key, {
      waiting: this.#waiting?.letter ?? "",
      letters: drawing.letters,
      named: named(),
      isHotkey: () => hotkey !== null,
    });
    const letter = this.#waiting?.letter ?? "";
    if (start.kind === "text" && letter !== "" && start.text.startsWith(letter)) this.drop();
    // The waiting letter was a hotkey. Its command may take another tool, to which this key then belongs.
    else if (this.flush()) return start.kind !== "none" && drawing.takesCoordinates && this.#start(event);
    if (start.kind === "text") drawing.type(start.text);
    else if (start.kind === "wait" && hotkey) this.#wait(key, hotkey);
    else drawing.letters = lettersAfter(drawing.letters, key);
    return start.kind !== "none";
  }

  #wait(letter: string, hotkey: Hotkey): void {
    const { state } = this.#options.drawing;
    this.#waiting = { letter, hotkey, pointer: state.getState().pointer };
    state.setState({ waiting: { letter, command: hotkey.label } });
    this.#timer = setTimeout(() => this.flush(), waitingTime);
  }
}
