import type { LineType, PatchType } from "tetrafront/project";
import type { Position } from "./position";
import { fromFrame, type Frame } from "./vectors";

/**
 * Points, lines and patches that are not part of a project yet. They refer to each other by number instead of by id:
 * points by their index; the lines of loops by their index + 1, negative if a line is traversed backwards.
 */
export interface Shape<P = Position> {
  readonly points: readonly P[];
  readonly lines: readonly ShapeLine[];
  readonly patches: readonly ShapePatch[];
}

export interface ShapeLine {
  readonly type: LineType;
  readonly points: readonly number[];
  readonly startTangent?: Position | undefined;
  readonly endTangent?: Position | undefined;
}

export interface ShapePatch {
  readonly type: PatchType;
  readonly loops: readonly (readonly number[])[];
  /** Omitted for a patch without a name. */
  readonly name?: string;
}

/** Returns a shape with every point moved. */
export function mapPoints<P, Q>(shape: Shape<P>, move: (point: P) => Q): Shape<Q> {
  return { ...shape, points: shape.points.map(move) };
}

/** Returns a shape whose coordinates were those in a frame. */
export function placedIn(shape: Shape, frame: Frame): Shape {
  return mapPoints(shape, (position) => fromFrame(frame, position));
}

/** Builds a shape step by step, from nothing or from a shape to extend. Straight lines with the same ends are made once. */
export class ShapeBuilder<P = Position> implements Shape<P> {
  readonly points: P[];
  readonly lines: ShapeLine[];
  readonly patches: ShapePatch[];
  readonly #straight = new Map<string, number>();

  constructor({ points, lines, patches }: Shape<P> = { points: [], lines: [], patches: [] }) {
    this.points = [...points];
    this.lines = [...lines];
    this.patches = [...patches];
    for (const [index, line] of lines.entries()) {
      if (line.type === "straight") this.#straight.set(line.points.join(" "), index + 1);
    }
  }

  /** Adds a point. Returns its index. */
  point(position: P): number {
    this.points.push(position);
    return this.points.length - 1;
  }

  /** Adds a line. Returns its number, for loops. */
  line(type: LineType, points: readonly number[]): number {
    this.lines.push({ type, points });
    return this.lines.length;
  }

  /** Returns the number of the straight line from a point to another: negative if it was made the other way round. */
  straight(from: number, to: number): number {
    const back = this.#straight.get(`${to} ${from}`);
    if (back !== undefined) return -back;
    const known = this.#straight.get(`${from} ${to}`);
    if (known !== undefined) return known;
    const made = this.line("straight", [from, to]);
    this.#straight.set(`${from} ${to}`, made);
    return made;
  }

  /** Returns the loop of straight lines around a polygon. */
  polygon(points: readonly number[]): number[] {
    return points.map((from, i) => this.straight(from, points[(i + 1) % points.length] ?? from));
  }

  patch(type: PatchType, loops: readonly (readonly number[])[], name?: string): void {
    this.patches.push({ type, loops, ...(name !== undefined && { name }) });
  }

  /** Returns what was built. */
  get shape(): Shape<P> {
    const { points, lines, patches } = this;
    return { points, lines, patches };
  }
}
