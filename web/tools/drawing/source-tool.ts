import type { SourceType } from "tetrafront/project";
import { addSourceAt, cornersOf } from "../../document/create";
import type { Place } from "../../document/draw";
import type { Position } from "../../document/position";
import { distance } from "../../document/vectors";
import { emptySketch, type Sketch } from "../../viewer/layers/drawing-layer";
import { DrawingTool } from "./drawing-tool";

/** The type of source with a number of corners. */
const typeWith: Readonly<Record<number, SourceType>> = { 1: "point", 2: "segment", 3: "triangle" };

/** Draws sources of sizes by their corners. Enter makes a smaller source of the corners picked so far. */
export class SourceTool extends DrawingTool {
  #places: readonly Position[] = [];

  get picked(): number {
    return this.#places.length;
  }

  override overlay() {
    this.stores.view.reveal("source");
    return super.overlay();
  }

  protected pick({ position }: Place): void {
    if (this.#places.some((place) => distance(place, position) === 0)) return;
    this.#places = [...this.#places, position];
    if (this.#places.length >= cornersOf[this.stores.view.state.getState().sourceType]) this.finish();
  }

  protected last(): Position | null {
    return this.#places.at(-1) ?? null;
  }

  protected finish(): void {
    const type = typeWith[this.#places.length];
    if (type) this.create(addSourceAt(this.project, type, this.#places));
    this.#places = [];
  }

  protected removeLast(): boolean {
    const hadPlaces = this.#places.length > 0;
    this.#places = this.#places.slice(0, -1);
    return hadPlaces;
  }

  override get canTakeBack(): boolean {
    return this.#places.length > 0;
  }

  protected leave(): boolean {
    const hadPlaces = this.#places.length > 0;
    this.#places = [];
    return hadPlaces;
  }

  protected sketch(): Sketch {
    const corners = this.snap ? [...this.#places, this.snap.position] : this.#places;
    const isClosed = corners.length > 2;
    return {
      ...emptySketch,
      paths: corners.length > 1 ? [isClosed ? [...corners, ...corners.slice(0, 1)] : corners] : [],
      dots: corners,
    };
  }

  protected override end(): void {
    this.#places = [];
    super.end();
  }
}
