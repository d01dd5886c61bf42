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
 * Defines what the pointer does in the view. One tool is active at a time; `ToolController` calls it. A press
 * of a button calls `down`, `move` any number of times, and `up`, or ends early with `cancel`.
 */
export interface Tool {
  readonly id: string;
  /**
   * A button was pressed. Returns whether the tool claims it. The camera does not see a claimed press, and
   * the tool receives its moves, also outside the view. Any other press is a click or moves the camera.
   */
  down(pointer: ToolPointer): boolean;
  /** The pointer moved, with a claimed button or none; null if it left the view. */
  move(pointer: ToolPointer | null): void;
  /** The button was released, after a claimed press or a click. */
  up(pointer: ToolPointer): void;
  /** The press ended otherwise: by Escape, a camera drag, a second finger, a lost pointer or another tool. */
  cancel(): void;
  /** A key was pressed while no field or dialog has the focus. Returns whether the tool used it. */
  key(event: KeyboardEvent): boolean;
  /** Creates what the tool draws while it is active; null for nothing. The viewer disposes it. */
  overlay(): Layer | null;
}
