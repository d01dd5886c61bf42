import type { Hit, Layer } from "../viewer/layers/layer";
import type { ScreenPoint } from "../viewer/screen";

export type PointerButton = "left" | "middle" | "right";

/** The pointer over the view at one moment. */
export interface ToolPointer {
  /** CSS pixels from the top left corner of the view. */
  readonly at: ScreenPoint;
  /** The button that was pressed or released, or is held; null if none. */
  readonly button: PointerButton | null;
  readonly shift: boolean;
  /** Ctrl, or Command on a Mac. */
  readonly mod: boolean;
  readonly alt: boolean;
  /** A finger: it has no buttons, so that a drag moves the camera. */
  readonly touch: boolean;
  /** True if the pointer has moved more than a few pixels since the button was pressed. */
  readonly isDrag: boolean;
  /** Number of clicks in quick succession, this one included: 2 for a double click; 0 without a button. */
  readonly clicks: number;
  /** Returns what lies under the pointer. The first call runs the hit test. */
  hit(): Hit | null;
}

/**
 * One thing that the pointer and the keys can do in the view, such as dragging handles or selecting. A tool is an ordered
 * list of interactions; `ToolController` asks them in this order, by the rules that it states.
 */
export interface Interaction {
  /** A button was pressed. Returns whether the interaction claims the press. */
  down?(pointer: ToolPointer): boolean;
  /**
   * The pointer moved: during a press that the interaction has claimed, or without a button; null if the pointer left the
   * view, or belongs to another interaction. Returns whether something of the interaction lies under the pointer.
   */
  move?(pointer: ToolPointer | null): boolean;
  /** The button was released, after a claimed press or a click. Returns false to leave a click to those that follow. */
  up?(pointer: ToolPointer): boolean;
  /** The press ended otherwise, or was claimed by none and became a drag of the camera. */
  cancel?(): void;
  /** A key was pressed while no field or dialog has the focus. Returns whether the interaction used it. */
  key?(event: KeyboardEvent): boolean;
  /** Creates what the interaction draws while its tool is active. The viewer disposes it. */
  overlay?(): Layer;
}
