import type { Viewer } from "../viewer/viewer";

/** Degrees per key press. */
const rotationStep = 10;
/** Share of the distance to the target per key press. */
const panStep = 0.05;
const zoomStep = 1.15;

const arrows: Readonly<Record<string, readonly [right: number, down: number]>> = {
  ArrowLeft: [-1, 0],
  ArrowRight: [1, 0],
  ArrowUp: [0, -1],
  ArrowDown: [0, 1],
};

/** Moves the camera: arrow keys rotate, with Shift they pan, + and - zoom. Returns whether the key was used. */
export function navigate(viewer: Pick<Viewer, "pan" | "rotate" | "zoom">, event: KeyboardEvent): boolean {
  if (event.ctrlKey || event.metaKey || event.altKey) return false;
  const arrow = arrows[event.key];
  if (arrow) {
    const [right, down] = arrow;
    if (event.shiftKey) viewer.pan(-right * panStep, -down * panStep);
    else viewer.rotate(right * rotationStep, down * rotationStep);
    return true;
  }
  const zoom = { "+": zoomStep, "=": zoomStep, "-": 1 / zoomStep }[event.key];
  if (zoom !== undefined) viewer.zoom(zoom);
  return zoom !== undefined;
}
