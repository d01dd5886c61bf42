/** A polygon whose corners are moved, added and removed; it remembers a shape to go back to. */
import type { PlanePoint } from "../../kit/plane-view";

/** Fewest and most corners. */
const minCorners = 3;
const maxCorners = 24;

export class Polygon {
  #corners: readonly PlanePoint[];
  #sound: readonly PlanePoint[];

  constructor(corners: readonly PlanePoint[]) {
    this.#corners = corners;
    this.#sound = corners;
  }

  get corners(): readonly PlanePoint[] {
    return this.#corners;
  }

  corner(index: number): PlanePoint {
    return this.#corners[index] ?? [0, 0];
  }

  /** Returns the middle of the segment after a corner. */
  middle(index: number): PlanePoint {
    const [a, b] = [this.corner(index), this.corner((index + 1) % this.#corners.length)];
    return [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2];
  }

  move(index: number, to: PlanePoint): void {
    this.#corners = this.#corners.with(index, to);
  }

  /** Adds a corner in the middle of the segment after a corner; returns its index, or null if there are too many. */
  split(index: number): number | null {
    if (this.#corners.length >= maxCorners) return null;
    this.#corners = this.#corners.toSpliced(index + 1, 0, this.middle(index));
    return index + 1;
  }

  /** Returns whether the corner could be removed. */
  remove(index: number): boolean {
    if (this.#corners.length <= minCorners) return false;
    this.#corners = this.#corners.toSpliced(index, 1);
    return true;
  }

  /** Remembers the present shape. */
  keep(): void {
    this.#sound = this.#corners;
  }

  /** Returns the remembered shape. */
  get sound(): readonly PlanePoint[] {
    return this.#sound;
  }

  restore(corners: readonly PlanePoint[]): void {
    this.#corners = corners;
  }
}
