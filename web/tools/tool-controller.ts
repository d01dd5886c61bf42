import { createStore, type StoreApi } from "zustand/vanilla";
import type { Viewer } from "../viewer/viewer";
import type { ScreenPoint } from "../viewer/screen";
import { inputMode } from "./input-mode";
import type { PointerButton, Tool, ToolPointer } from "./tool";

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
  readonly isClaimed: boolean;
  isDrag: boolean;
}

interface Click {
  readonly at: ScreenPoint;
  /** Milliseconds. */
  readonly time: number;
  readonly count: number;
}

export interface ToolState {
  readonly tool: string;
  /** True while the active tool has claimed a button. */
  readonly hasGesture: boolean;
}

/**
 * Passes pointer and key events to the active tool before the camera and the hotkeys receive them, by
 * listening in the capture phase. While a tool has claimed a button, only the tool receives keys, and Escape
 * cancels the press.
 */
export class ToolController {
  readonly state: StoreApi<ToolState>;
  readonly #canvas: HTMLElement;
  readonly #viewer: Pick<Viewer, "addLayer" | "hit">;
  readonly #listening = new AbortController();
  #tool: Tool;
  #removeOverlay: (() => void) | null;
  #press: Press | null = null;
  #lastClick: Click = { at: { x: 0, y: 0 }, time: -Infinity, count: 0 };

  constructor(canvas: HTMLElement, viewer: Pick<Viewer, "addLayer" | "hit">, tool: Tool) {
    this.#canvas = canvas;
    this.#viewer = viewer;
    this.#tool = tool;
    this.#removeOverlay = this.#addOverlay();
    this.state = createStore<ToolState>(() => ({ tool: tool.id, hasGesture: false }));
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

  /** Makes another tool the active one. */
  use(tool: Tool): void {
    this.cancel();
    this.#tool.move(null);
    this.#removeOverlay?.();
    this.#tool = tool;
    this.#removeOverlay = this.#addOverlay();
    this.state.setState({ tool: tool.id });
  }

  /** Cancels a press. */
  cancel(): void {
    if (!this.#press) return;
    this.#endPress();
    this.#tool.cancel();
  }

  dispose(): void {
    this.cancel();
    this.#tool.move(null);
    this.#removeOverlay?.();
    this.#listening.abort();
  }

  #addOverlay(): (() => void) | null {
    const overlay = this.#tool.overlay();
    return overlay && this.#viewer.addLayer(overlay);
  }

  #down(event: PointerEvent): void {
    const isSecondPointer = this.#press !== null && this.#press.pointerId !== event.pointerId;
    if (isSecondPointer && this.#press?.isClaimed === true) return event.stopImmediatePropagation();
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
    const isClaimed = this.#tool.down(this.#pointer(event, press));
    this.#press = { ...press, isClaimed };
    if (!isClaimed) return;
    event.stopImmediatePropagation();
    this.#canvas.setPointerCapture(event.pointerId);
    this.state.setState({ hasGesture: true });
  }

  #move(event: PointerEvent): void {
    const press = this.#press;
    if (!press) {
      if (event.buttons === 0 && event.pointerType !== "touch") this.#tool.move(this.#pointer(event, null));
      return;
    }
    if (event.pointerId !== press.pointerId) return;
    press.isDrag ||= distance(this.#pointOf(event), press.start) > dragThreshold;
    if (press.isClaimed) {
      event.stopImmediatePropagation();
      this.#tool.move(this.#pointer(event, press));
    } else if (press.isDrag) {
      this.cancel();
    }
  }

  #up(event: PointerEvent): void {
    const press = this.#press;
    if (event.pointerId !== press?.pointerId) return;
    if (press.isClaimed) event.stopImmediatePropagation();
    this.#endPress();
    if (!press.isDrag) this.#lastClick = { at: press.start, time: event.timeStamp, count: press.clicks };
    this.#tool.up(this.#pointer(event, press));
  }

  #leave(): void {
    // A captured pointer never leaves the view.
    if (this.#press?.isClaimed === true) return;
    this.cancel();
    this.#tool.move(null);
  }

  #lose(event: PointerEvent): void {
    if (event.pointerId === this.#press?.pointerId) this.cancel();
  }

  #key(event: KeyboardEvent): void {
    const hasGesture = this.#press?.isClaimed === true;
    const isMeant = inputMode(event.target) === "view";
    if (!hasGesture && !isMeant) return;
    const isUsed = hasGesture && event.key === "Escape" ? this.#cancelByKey() : this.#tool.key(event);
    if (isUsed) event.preventDefault();
    if (isUsed || hasGesture) event.stopImmediatePropagation();
  }

  #cancelByKey(): true {
    this.cancel();
    return true;
  }

  #endPress(): void {
    const press = this.#press;
    this.#press = null;
    if (press?.isClaimed !== true) return;
    if (this.#canvas.hasPointerCapture(press.pointerId)) this.#canvas.releasePointerCapture(press.pointerId);
    this.state.setState({ hasGesture: false });
  }

  #countClicks(event: PointerEvent, at: ScreenPoint): number {
    const { at: last, time, count } = this.#lastClick;
    const isRepeated = event.timeStamp - time <= repeatTime && distance(at, last) <= repeatDistance;
    return isRepeated ? count + 1 : 1;
  }

  #pointer(event: PointerEvent, press: Omit<Press, "isClaimed"> | null): ToolPointer {
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
