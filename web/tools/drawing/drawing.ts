import { createStore, type StoreApi } from "zustand/vanilla";
import { isHeading, linesOf } from "../../document/position-list";
import type { Position } from "../../document/position";
import type { HandleMode } from "../../document/tools";
import type { ScreenPoint } from "../../viewer/screen";
import type { Snap } from "./snapping";

export interface DrawingState {
  /** The place under the pointer, or what is typed. */
  readonly snap: Snap | null;
  readonly pointer: ScreenPoint;
  /** The position under the pointer, on the work plane or where a tool would draw; null if it is not over the view. */
  readonly cursor: Position | null;
  /** Step of the work plane's grid while it is shown. */
  readonly gridStep: number | null;
  /** The text in the coordinate field; null while the field is closed. */
  readonly typed: string | null;
  /** A letter that may begin coordinates, and the command that it runs otherwise; null without one. */
  readonly waiting: { readonly letter: string; readonly command: string } | null;
  /** Why the typed text cannot be used; `refused` has the reason if the text is right, but not possible. */
  readonly mistake: Mistake | null;
  /** What is moved, rotated or scaled by what is typed; null for coordinates. */
  readonly motion: HandleMode | null;
  /** The axis along which or about which it is moved; null without a chosen one. */
  readonly axis: 0 | 1 | 2 | null;
  /** Number of places picked for what is being drawn. */
  readonly picked: number;
  /** Whether undo first takes back the place picked last. */
  readonly canTakeBack: boolean;
  /** The places of a measurement. */
  readonly measured: readonly Position[];
  /** The box or lasso that is being drawn around entities. */
  readonly outline: { readonly points: readonly ScreenPoint[]; readonly touching: boolean } | null;
  /** Where the context menu is open. */
  readonly menu: ScreenPoint | null;
  /** The position on the model under the context menu; null if it is not about an entity. */
  readonly menuPosition: Position | null;
  /** By how much a drag moves, rotates or scales, shown at the pointer; null without a drag. */
  readonly amount: string | null;
  /** Why the last action created nothing. */
  readonly refused: string | null;
}

const idle: DrawingState = {
  snap: null,
  pointer: { x: 0, y: 0 },
  cursor: null,
  gridStep: null,
  typed: null,
  waiting: null,
  mistake: null,
  motion: null,
  axis: null,
  picked: 0,
  canTakeBack: false,
  measured: [],
  outline: null,
  menu: null,
  menuPosition: null,
  amount: null,
  refused: null,
};

export type Mistake =
  | "syntax"
  | "no-last-place"
  | "no-radius"
  | "short-radius"
  | "no-motion"
  | "no-angle"
  | "no-factor"
  | "refused";

/** The field is closed, and nothing is moved. A letter may wait. */
const closed = {
  typed: null,
  mistake: null,
  motion: null,
  axis: null,
  amount: null,
  refused: null,
};

/** The tool that reads typed coordinates. */
export interface TypedInput {
  /** Whether typed coordinates have a meaning. */
  readonly takesCoordinates: boolean;
  /** Uses typed coordinates. Returns why they cannot be used; null if they were. */
  take(text: string): DrawingState["mistake"];
  /** Removes the place picked last if no step of undo has it. */
  takeBack?(): void;
  /** Ends what is being drawn, as Enter does. */
  complete?(): void;
  /** Returns where in the view the field opens; null for beside the pointer. */
  placeOfField?(): ScreenPoint | null;
  /** The text was changed. Returns the text to show. */
  edited?(text: string): string;
  /** Returns the text after Tab, with room for the next number. */
  next?(text: string): string;
  /** The field was closed, and nothing was taken. */
  closed?(): void;
}

/** What the drawing tools show beside the pointer, and the field for coordinates. */
export class Drawing {
  readonly state: StoreApi<DrawingState> = createStore<DrawingState>(() => idle);
  /** Hotkeys that were pressed in a row while the field was closed. They may have been meant as coordinates. */
  letters = "";
  #input: TypedInput | null = null;

  /** Whether typed coordinates have a meaning for the active tool. */
  get takesCoordinates(): boolean {
    return this.#input?.takesCoordinates === true;
  }

  /** Takes back the place picked last, if no step of undo has it. Returns whether there was one. */
  takeBack(): boolean {
    const { canTakeBack } = this.state.getState();
    if (canTakeBack) this.#input?.takeBack?.();
    return canTakeBack;
  }

  /** Ends what is being drawn, as Enter does in the view. */
  complete(): void {
    this.type(null);
    this.#input?.complete?.();
  }

  /** Connects the active tool. */
  begin(input: TypedInput): void {
    this.#input = input;
    this.#reset();
  }

  /** Disconnects the active tool. */
  end(): void {
    this.#input = null;
    this.#reset();
  }

  /** Connects a motion with the field. */
  beginMotion(input: TypedInput, motion: HandleMode): void {
    this.#input = input;
    this.state.setState({ ...closed, motion });
  }

  /** Disconnects a motion, unless another input has taken its place. */
  endMotion(input: TypedInput): void {
    if (this.#input !== input) return;
    this.#input = null;
    this.state.setState(closed);
  }

  /** Sets the text in the field; null closes the field. */
  type(typed: string | null): void {
    this.letters = "";
    const wasOpen = this.state.getState().typed !== null;
    const place = typed === null || wasOpen ? null : this.#input?.placeOfField?.();
    if (place) this.state.setState({ pointer: place });
    const shown = typed === null ? null : (this.#input?.edited?.(typed) ?? typed);
    this.state.setState({ typed: shown, mistake: null });
    if (typed === null && wasOpen) this.#input?.closed?.();
  }

  /** Goes on to the next number of the text. */
  next(): void {
    const { typed } = this.state.getState();
    if (typed === null) return;
    const isFull = typed.trim() === "" || /,\s*$|</.test(typed) || typed.split(",").length > 2;
    this.type(this.#input?.next ? this.#input.next(typed) : isFull ? typed : `${typed},`);
  }

  /**
   * Hands the lines of a pasted text to the tool, one place each, without a heading. Returns the first line that is no
   * position; null if there is none. Returns undefined without a tool that takes coordinates.
   */
  takeLines(text: string): string | null | undefined {
    const input = this.#input;
    if (!input?.takesCoordinates) return undefined;
    this.type(null);
    // The names of parameters are words too: a first line that the tool takes is no heading.
    const refused = linesOf(text).find(
      (line, index) => input.take(line) !== null && !(index === 0 && isHeading(line)),
    );
    return refused ?? null;
  }

  /** Hands the typed text to the tool, and closes the field if the tool has used it. */
  submit(): void {
    const { typed } = this.state.getState();
    if (typed === null || typed.trim() === "") return this.type(null);
    const mistake = this.#input?.take(typed) ?? null;
    if (mistake) this.state.setState({ mistake });
    else this.type(null);
  }

  /** The pointer stays where it is. */
  #reset(): void {
    this.state.setState(({ pointer, cursor }) => ({ ...idle, pointer, cursor }));
  }
}
