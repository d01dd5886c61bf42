import { Vector2 } from "three";
import type { SelectMode } from "../document/selection";

export interface PointerEvents {
  readonly onClick: (at: Vector2, mode: SelectMode) => void;
  readonly onDoubleClick: (at: Vector2) => void;
  /** The pointer rests over a place, or has left. */
  readonly onHover: (at: Vector2 | null) => void;
}

/** A press that moves further than this, in pixels, is a drag. */
const dragThreshold = 4;
/** The pointer must rest this long before something lights up. */
const hoverDelayMs = 80;

/** Tells clicks from drags, and rests from passing by. Returns the way to stop. */
export function watchPointer(canvas: HTMLCanvasElement, events: PointerEvents): () => void {
  const stop = new AbortController();
  const { signal } = stop;
  let pressedAt: Vector2 | null = null;
  let hoverTimer: ReturnType<typeof setTimeout> | undefined;
  const place = (event: MouseEvent): Vector2 => {
    const box = canvas.getBoundingClientRect();
    return new Vector2(event.clientX - box.left, event.clientY - box.top);
  };
  const rest = (at: Vector2 | null): void => {
    clearTimeout(hoverTimer);
    if (at === null) events.onHover(null);
    else hoverTimer = setTimeout(() => events.onHover(at), hoverDelayMs);
  };
  canvas.addEventListener(
    "pointerdown",
    (event) => {
      pressedAt = event.isPrimary && event.button === 0 ? place(event) : null;
      clearTimeout(hoverTimer);
    },
    { signal },
  );
  canvas.addEventListener(
    "pointerup",
    (event) => {
      const at = place(event);
      if (pressedAt && at.distanceTo(pressedAt) <= dragThreshold) events.onClick(at, modeOf(event));
      pressedAt = null;
    },
    { signal },
  );
  canvas.addEventListener(
    "pointermove",
    (event) => {
      if (event.buttons === 0 && event.pointerType !== "touch") rest(place(event));
    },
    { signal },
  );
  canvas.addEventListener("pointerleave", () => rest(null), { signal });
  canvas.addEventListener("dblclick", (event) => events.onDoubleClick(place(event)), { signal });
  canvas.addEventListener("contextmenu", (event) => event.preventDefault(), { signal });
  return () => {
    clearTimeout(hoverTimer);
    stop.abort();
  };
}

function modeOf(event: PointerEvent): SelectMode {
  if (event.ctrlKey || event.metaKey) return "toggle";
  return event.shiftKey ? "add" : "replace";
}
