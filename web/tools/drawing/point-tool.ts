import { addPoint } from "../../document/create";
import type { Place } from "../../document/draw";
import type { Position } from "../../document/position";
import { emptySketch, type Sketch } from "../../viewer/layers/drawing-layer";
import { DrawingTool } from "./drawing-tool";

/** Each click adds a point, or selects the point that is there. */
export class PointTool extends DrawingTool {
  readonly id = "point";
  readonly picked = 0;
  #last: Position | null = null;

  protected pick({ point, position, expressions }: Place): void {
    this.#last = position;
    if (point === null) this.create(addPoint(this.project, position, expressions));
    else this.stores.view.select({ kind: "point", id: point });
  }

  protected last(): Position | null {
    return this.#last;
  }

  protected finish(): void {
    // Each point is complete.
  }

  protected removeLast(): boolean {
    return false;
  }

  protected leave(): boolean {
    return false;
  }

  protected sketch(): Sketch {
    const { snap } = this;
    return snap && snap.kind !== "point" ? { ...emptySketch, dots: [snap.position] } : emptySketch;
  }
}
