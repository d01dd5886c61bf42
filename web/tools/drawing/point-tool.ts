import { addPoint } from "../../document/create";
import { quantitiesAt, type Place } from "../../document/draw";
import type { QuantityPosition } from "../../document/quantity-positions";
import { emptySketch, type Sketch } from "../../viewer/layers/drawing-layer";
import { DrawingTool } from "./drawing-tool";

/** Each click adds a point, or selects the point that is there. */
export class PointTool extends DrawingTool {
  readonly picked = 0;
  #last: QuantityPosition | null = null;

  protected pick(place: Place): void {
    const { point, position, expressions } = place;
    this.#last = quantitiesAt(this.project, place);
    if (point === null) this.create(addPoint(this.project, position, expressions));
    else this.stores.view.select({ kind: "point", id: point });
  }

  protected last(): QuantityPosition | null {
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
