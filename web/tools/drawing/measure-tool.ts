import type { Place } from "../../document/draw";
import type { Position } from "../../document/position";
import { emptySketch, type Sketch } from "../../viewer/layers/drawing-layer";
import { DrawingTool } from "./drawing-tool";

/** Measures the distance of two places, and with a third one the angle at the second. The next place begins again. */
export class MeasureTool extends DrawingTool {
  #places: readonly Position[] = [];

  get picked(): number {
    return this.#places.length;
  }

  protected pick({ position }: Place): void {
    this.#set(this.#places.length < 3 ? [...this.#places, position] : [position]);
  }

  protected last(): Position | null {
    return this.#places.at(-1) ?? null;
  }

  protected finish(): void {
    this.#set([]);
  }

  protected removeLast(): boolean {
    const hadPlaces = this.#places.length > 0;
    this.#set(this.#places.slice(0, -1));
    return hadPlaces;
  }

  protected leave(): boolean {
    const hadPlaces = this.#places.length > 0;
    this.#set([]);
    return hadPlaces;
  }

  protected sketch(): Sketch {
    const next = this.#places.length < 3 && this.snap ? [this.snap.position] : [];
    const path = [...this.#places, ...(this.#places.length > 0 ? next : [])];
    return { ...emptySketch, paths: path.length > 1 ? [path] : [], dots: [...this.#places, ...next] };
  }

  /** Places that are no longer shown must not be part of the next measurement. */
  protected override end(): void {
    this.#set([]);
    super.end();
  }

  #set(places: readonly Position[]): void {
    this.#places = places;
    this.stores.drawing.state.setState({ measured: places });
  }
}
