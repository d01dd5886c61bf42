/**
 * A tool is an ordered list of interactions, and one tool is active. The rules:
 *
 * - Press: the interactions are asked in their order, and the first that claims the press owns it. Its moves and its release
 *   go to the owner, also outside the view, and the camera sees nothing of it. A press that none claims is a click, or
 *   becomes a drag of the camera.
 * - Release: the owner is asked, then those after it; for a click, all are. The first that returns true has used it.
 * - Hover: without a press, all are asked in their order. Those after the first that has something under the pointer see
 *   no pointer (null). While a press has an owner, the others see none either.
 * - Keys: an owner alone receives them, and Escape cancels its press. Otherwise the first that uses a key has it, and the
 *   hotkeys and the camera receive only keys that none has used. Keys in fields and dialogs are left alone.
 * - Overlays add up: while a tool is active, what each of its interactions draws is in the view.
 * - Cancel: Escape, a drag of the camera, a second finger without an owner, a lost pointer, a window that loses the focus,
 *   and another tool. All interactions are told.
 */
import { createStore, type StoreApi } from "zustand/vanilla";
import type { Viewer } from "../viewer/viewer";
import type { ScreenPoint } from "../viewer/screen";
import { inputMode } from "./input-mode";
import type { Interaction, PointerButton, ToolPointer } from "./interaction";

/** A press that moves farther than this, in CSS pixels, is a drag. */
const dragThreshold = 4;
/** A click counts as a repetition of the last one within this time, in milliseconds, and distance. */
const repeatTime = 500;
const repeatDistance = 6;

const buttons: readonly PointerButton[] = ["left", "middle", "right"];

interface Press {
  readonly pointerId: number;
  readonly button: PointerButton | null;
  readonly start: ScreenPoint;
  readonly clicks: number;
  /** The interaction that has claimed the press; null if none has. */
  readonly owner: Interaction | null;
  isDrag: boolean;
}

interface Click {
  readonly at: ScreenPoint;
  /** Milliseconds. */
  readonly time: number;
  readonly count: number;
}

export interface ToolState {
  /** True while an interaction has claimed a press. */
  readonly hasGesture: boolean;
}

/**
 * Passes pointer and key events to the interactions of the active tool before the camera and the hotkeys receive them, by
 * listening in the capture phase.
 */
export class ToolController {
  readonly state: StoreApi<ToolState>;
  readonly #canvas: HTMLElement;
  readonly #viewer: Pick<Viewer, "addLayer" | "hit">;
  readonly #listening = new AbortController();
  #tool: readonly Interaction[] = [];
  #removeOverlays: readonly (() => void)[] = [];
  #press: Press | null = null;
  #lastClick: Click = { at: { x: 0, y: 0 }, time: -Infinity, count: 0 };

  constructor(canvas: HTMLElement, viewer: Pick<Viewer, "addLayer" | "hit">) {
    this.#canvas = canvas;
    this.#viewer = viewer;
    this.state = createStore<ToolState>(() => ({ hasGesture: false }));
    const options = { capture: true, signal: this.#listening.signal };
    canvas.addEventListener("pointerdown", (event) => this.#down(event), options);
    canvas.addEventListener("pointermove", (event) => this.#move(event), options);
    canvas.addEventListener("pointerup", (event) => this.#up(event), options);
    canvas.addEventListener("pointerleave", () => this.#leave(), options);
    for (const type of ["pointercancel", "lostpointercapture"] as const) {
      canvas.addEventListener(type, (event) => this.#lose(event), options);
    }
    canvas.addEventListener("contextmenu", (event) => event.preventDefault(), options);
    // Not in the capture phase: a press in the view takes the focus from an element, which must not cancel it.
    window.addEventListener("blur", () => this.cancel(), { signal: this.#listening.signal });
    window.addEventListener("keydown", (event) => this.#key(event), options);
  }

  /** Makes other interactions the active tool. */
  use(tool: readonly Interaction[]): void {
    this.cancel();
    this.#hover(null);
    for (const remove of this.#removeOverlays) remove();
    this.#tool = tool;
    this.#removeOverlays = tool.flatMap((interaction) => {
      const overlay = interaction.overlay?.();
      return overlay ? [this.#viewer.addLayer(overlay)] : [];
    });
  }

  /** Cancels a press. */
  cancel(): void {
    if (!this.#press) return;
    this.#endPress();
    for (const interaction of this.#tool) interaction.cancel?.();
  }

  dispose(): void {
    this.use([]);
    this.#listening.abort();
  }

  #down(event: PointerEvent): void {
    const isSecondPointer = this.#press !== null && this.#press.pointerId !== event.pointerId;
    if (isSecondPointer && this.#press?.owner) return event.stopImmediatePropagation();
    // Two fingers move the camera. A mouse whose release was missed begins a new press.
    this.cancel();
    if (isSecondPointer || !event.isPrimary) return;
    const start = this.#pointOf(event);
    const press = {
      pointerId: event.pointerId,
      button: buttons[event.button] ?? null,
      start,
      clicks: this.#countClicks(event, start),
      isDrag: false,
    };
    const pointer = this.#pointer(event, press);
    const owner = this.#tool.find((interaction) => interaction.down?.(pointer)) ?? null;
    this.#press = { ...press, owner };
    if (!owner) return;
    for (const other of this.#tool) if (other !== owner) other.move?.(null);
    event.stopImmediatePropagation();
    this.#canvas.setPointerCapture(event.pointerId);
    this.state.setState({ hasGesture: true });
  }

  #move(event: PointerEvent): void {
    const press = this.#press;
    if (!press) {
      if (event.buttons === 0 && event.pointerType !== "touch") this.#hover(this.#pointer(event, null));
      return;
    }
    if (event.pointerId !== press.pointerId) return;
    press.isDrag ||= distance(this.#pointOf(event), press.start) > dragThreshold;
    if (press.owner) {
      event.stopImmediatePropagation();
      press.owner.move?.(this.#pointer(event, press));
    } else if (press.isDrag) {
      this.cancel();
    }
  }

  #up(event: PointerEvent): void {
    const press = this.#press;
    if (event.pointerId !== press?.pointerId) return;
    if (press.owner) event.stopImmediatePropagation();
    this.#endPress();
    if (!press.isDrag) this.#lastClick = { at: press.start, time: event.timeStamp, count: press.clicks };
    const pointer = this.#pointer(event, press);
    const asked = press.owner ? this.#tool.slice(this.#tool.indexOf(press.owner)) : this.#tool;
    asked.some((interaction) => interaction.up?.(pointer));
  }

  #leave(): void {
    // A captured pointer never leaves the view.
    if (this.#press?.owner) return;
    this.cancel();
    this.#hover(null);
  }

  #hover(pointer: ToolPointer | null): void {
    let seen = pointer;
    for (const interaction of this.#tool) if (interaction.move?.(seen) === true) seen = null;
  }

  #lose(event: PointerEvent): void {
    if (event.pointerId === this.#press?.pointerId) this.cancel();
  }

  #key(event: KeyboardEvent): void {
    const owner = this.#press?.owner;
    if (!owner && inputMode(event.target) !== "view") return;
    const isCancel = owner !== undefined && owner !== null && event.key === "Escape";
    if (isCancel) this.cancel();
    const isUsed = isCancel || (owner ? [owner] : this.#tool).some((asked) => asked.key?.(event));
    if (isUsed) event.preventDefault();
    if (isUsed || owner) event.stopImmediatePropagation();
  }

  #endPress(): void {
    const press = this.#press;
    this.#press = null;
    if (!press?.owner) return;
    if (this.#canvas.hasPointerCapture(press.pointerId)) this.#canvas.releasePointerCapture(press.pointerId);
    this.state.setState({ hasGesture: false });
  }

  #countClicks(event: PointerEvent, at: ScreenPoint): number {
    const { at: last, time, count } = this.#lastClick;
    const isRepeated = event.timeStamp - time <= repeatTime && distance(at, last) <= repeatDistance;
    return isRepeated ? count + 1 : 1;
  }

  #pointer(event: PointerEvent, press: Omit<Press, "owner"> | null): ToolPointer {
    const at = this.#pointOf(event);
    let hit: ReturnType<Viewer["hit"]> | undefined;
    return {
      at,
      button: press?.button ?? null,
      shift: event.shiftKey,
      mod: event.ctrlKey || event.metaKey,
      alt: event.altKey,
      touch: event.pointerType === "touch",
      isDrag: press?.isDrag ?? false,
      clicks: press?.clicks ?? 0,
      hit: () => {
        if (hit === undefined) hit = this.#viewer.hit(at);
        return hit;
      },
    };
  }

  #pointOf(event: PointerEvent): ScreenPoint {
    const box = this.#canvas.getBoundingClientRect();
    return { x: event.clientX - box.left, y: event.clientY - box.top };
  }
}

function distance(a: ScreenPoint, b: ScreenPoint): number {
  return Math.hypot(a.x - b.x, a.y - b.y);
}
