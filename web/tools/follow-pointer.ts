import type { Position } from "../document/position";
import type { ViewStore } from "../document/selection";
import { isDrawingTool } from "../document/tools";
import { onPlane, roundStep, roundTo } from "../document/work-plane";
import type { ScreenPoint } from "../viewer/screen";
import type { Viewer } from "../viewer/viewer";
import type { Drawing } from "./drawing/drawing";

interface Stores {
  readonly view: ViewStore;
  readonly drawing: Drawing;
  readonly viewer: Pick<Viewer, "seenFrom" | "pixelLength">;
}

/**
 * Keeps the place under the pointer up to date: that of a drawing tool, or where the pointer meets the work plane, with as
 * many digits as pixels can tell apart. At most once per frame. Returns a function that ends this.
 */
export function followPointer(canvas: HTMLElement, { view, drawing, viewer }: Stores): () => void {
  const listening = new AbortController();
  const { signal } = listening;
  let frame: number | null = null;
  const placeAt = (pointer: ScreenPoint): Position | null => {
    const { tool, workPlane } = view.state.getState();
    const { snap } = drawing.state.getState();
    if (isDrawingTool(tool) && snap) return snap.position;
    const at = onPlane(viewer.seenFrom(pointer).ray, workPlane.frame);
    const step = roundStep(viewer.pixelLength);
    return at && (at.map((value) => roundTo(value, step)) as [number, number, number]);
  };
  const move = ({ clientX, clientY }: PointerEvent): void => {
    if (frame !== null) return;
    frame = requestAnimationFrame(() => {
      frame = null;
      const box = canvas.getBoundingClientRect();
      const pointer = { x: clientX - box.left, y: clientY - box.top };
      drawing.state.setState({ pointer, cursor: placeAt(pointer) });
    });
  };
  const leave = (): void => {
    if (frame !== null) cancelAnimationFrame(frame);
    frame = null;
    drawing.state.setState({ cursor: null });
  };
  canvas.addEventListener("pointermove", move, { signal });
  canvas.addEventListener("pointerleave", leave, { signal });
  return () => {
    listening.abort();
    leave();
  };
}
