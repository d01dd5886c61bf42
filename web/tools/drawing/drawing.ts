import { createStore, type StoreApi } from "zustand/vanilla";
import { linesOf } from "../../document/position-list";
import type { Position } from "../../document/position";
import type { ScreenPoint } from "../../viewer/screen";
import type { Snap } from "./snapping";

export interface DrawingState {
  /** The place under the pointer. */
  readonly snap: Snap | null;
  readonly pointer: ScreenPoint;
  /** The position under the pointer, on the work plane or where a tool would draw; null if it is not over the view. */
  readonly cursor: Position | null;
  /** Step of the work plane's grid while it is shown. */
  readonly gridStep: number | null;
  /** The text in the coordinate field; null while the field is closed. */
  readonly typed: string | null;
  /** Why the typed text is no position. */
  readonly mistake: "syntax" | "no-last-place" | null;
  /** Number of places picked for what is being drawn. */
  readonly picked: number;
  /** The places of a measurement. */
  readonly measured: readonly Position[];
  /** The box or lasso that is being drawn around entities. */
  readonly outline: { readonly points: readonly ScreenPoint[]; readonly touching: boolean } | null;
  /** Where the context menu is open. */
  readonly menu: ScreenPoint | null;
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
  mistake: null,
  picked: 0,
  measured: [],
  outline: null,
  menu: null,
  amount: null,
  refused: null,
};

/** The tool that reads typed coordinates. */
export interface TypedInput {
  /** Uses typed coordinates. Returns why they cannot be used; null if they were. */
  take(text: string): DrawingState["mistake"];
}

/** What the drawing tools show beside the pointer, and the field for coordinates. */
export class Drawing {
  readonly state: StoreApi<DrawingState> = createStore<DrawingState>(() => idle);
  #input: TypedInput | null = null;

  /** Connects the active tool. */
  begin(input: TypedInput): void {
    this.#input = input;
    this.state.setState(idle);
  }

  /** Disconnects the active tool. */
  end(): void {
    this.#input = null;
    this.state.setState(idle);
  }

  type(typed: string | null): void {
    this.state.setState({ typed, mistake: null });
  }

  /**
   * Hands the lines of a pasted text to the tool, one place each. Returns the first line that is no position; null if there is
   * none. Returns undefined without a tool.
   */
  takeLines(text: string): string | null | undefined {
    if (!this.#input) return undefined;
    this.type(null);
    for (const line of linesOf(text)) if (this.#input.take(line) !== null) return line;
    return null;
  }

  /** Hands the typed text to the tool, and closes the field if the tool has used it. */
  submit(): void {
    const { typed } = this.state.getState();
    if (typed === null || typed.trim() === "") return this.type(null);
    const mistake = this.#input?.take(typed) ?? null;
    if (mistake) this.state.setState({ mistake });
    else this.type(null);
  }
}
