/**
 * Traces without an engine: a small front that joins a star-shaped surface to its centre, and writes its steps as the
 * engine does. It has an encoder of its own (docs/TRACE.md), so that errors of the reader show.
 */
import type { SurfaceInput } from "tetrafront";
import { randomSource } from "./random.js";

export interface StarTrace {
  readonly bytes: Uint8Array<ArrayBuffer>;
  /** States by replay: sorted corner triples of the front, from state 0. */
  readonly fronts: readonly (readonly string[])[];
  /** Four nodes per element of the last state, in order. */
  readonly tetrahedra: readonly number[];
  /** x y z per node. */
  readonly points: readonly number[];
}

export interface StarOptions {
  /** Node number of the surface per corner, counter-clockwise seen from inside. */
  readonly triangles: readonly number[];
  readonly points: readonly number[];
  readonly seed?: number;
  /** Every n-th step is postponed; 0: none. */
  readonly postponeEvery?: number;
  /** After this step, recovery removes the last element and undoes it. */
  readonly reopenAfter?: number;
  /** Also return the fronts, which takes O(steps * faces). */
  readonly withFronts?: boolean;
}

/** Returns a surface as the first front sees it: from inside. */
export function starSurface({ points, triangles }: SurfaceInput): StarOptions {
  const inward: number[] = [];
  for (let i = 0; i < triangles.length; i += 3) {
    const [a = 0, b = 0, c = 0] = triangles.subarray(i, i + 3);
    inward.push(a, c, b);
  }
  return { points: [...points], triangles: inward };
}

type Triple = [number, number, number];

/** Writes little-endian numbers. */
export class TraceBytes {
  readonly #bytes: number[] = [];
  readonly #view = new DataView(new ArrayBuffer(8));

  byte(value: number): this {
    this.#bytes.push(value);
    return this;
  }
  varint(value: number): this {
    for (let rest = value; ; rest = Math.floor(rest / 128)) {
      if (rest < 128) return this.byte(rest);
      this.byte(128 + (rest % 128));
    }
  }
  zigzag(value: number): this {
    return this.varint(value >= 0 ? 2 * value : -2 * value - 1);
  }
  float(value: number): this {
    this.#view.setFloat32(0, value, true);
    for (let i = 0; i < 4; i++) this.byte(this.#view.getUint8(i));
    return this;
  }
  /** The upper half of a float. */
  score(value: number): this {
    this.#view.setFloat32(0, value, true);
    return this.byte(this.#view.getUint8(2)).byte(this.#view.getUint8(3));
  }
  double(value: number): this {
    this.#view.setFloat64(0, value, true);
    for (let i = 0; i < 8; i++) this.byte(this.#view.getUint8(i));
    return this;
  }
  event(kind: number, detail = 0): this {
    return this.byte(kind + 8 * detail);
  }
  text(value: string): this {
    for (const byte of new TextEncoder().encode(value)) this.byte(byte);
    return this;
  }
  append(other: TraceBytes): this {
    for (const byte of other.#bytes) this.byte(byte);
    return this;
  }
  get length(): number {
    return this.#bytes.length;
  }
  bytes(): Uint8Array<ArrayBuffer> {
    return Uint8Array.from(this.#bytes);
  }
}

export interface TraceParts {
  readonly points: readonly number[];
  readonly steps: number;
  readonly events: TraceBytes;
  readonly fingerprint?: string;
  /** 1 unless given: no events of lines and patches. */
  readonly version?: number;
}

/** Returns a file with any events. */
export function traceBytes({ points, steps, events, fingerprint = "0".repeat(16), version = 1 }: TraceParts) {
  const header = new TraceBytes().text(
    JSON.stringify({
      name: "star",
      nodes: points.length / 3,
      steps,
      order: "layered",
      status: "done",
      fingerprint,
    }),
  );
  const file = new TraceBytes().text("TFTRACE").byte(version).varint(header.length).append(header);
  for (const coordinate of points) file.double(coordinate);
  return file.append(events).bytes();
}

/** Writes the event `pass` with its faces, all of region 0. */
export function writeFirstFaces(events: TraceBytes, triangles: readonly number[]): void {
  events
    .event(0)
    .double(1)
    .varint(triangles.length / 3);
  let node = 0;
  triangles.forEach((corner, i) => {
    events.zigzag(corner - node);
    node = corner;
    if (i % 3 === 2) events.varint(0);
  });
}

/** Returns the trace of a front that fills a surface around the origin from its centre. */
export function starTrace(options: StarOptions): StarTrace {
  return new StarFront(options).trace();
}

class StarFront {
  readonly #options: StarOptions;
  readonly #random: () => number;
  readonly #events = new TraceBytes();
  readonly #faces: (Triple | undefined)[] = [];
  readonly #numbers = new Map<string, number>();
  readonly #free: number[] = [];
  readonly #elements: number[] = [];
  readonly #points: number[];
  readonly #fronts: string[][] = [];
  #centre: number | undefined;
  #lastBase = 0;
  #steps = 0;

  constructor(options: StarOptions) {
    this.#options = options;
    this.#random = randomSource(options.seed ?? 1);
    this.#points = [...options.points];
    writeFirstFaces(this.#events, options.triangles);
    for (let i = 0; i < options.triangles.length; i += 3) {
      const [a = 0, b = 0, c = 0] = options.triangles.slice(i, i + 3);
      this.#addFace([a, b, c]);
    }
    this.#record();
  }

  trace(): StarTrace {
    const { triangles, postponeEvery = 0, reopenAfter } = this.#options;
    for (let i = 0; i < triangles.length; i += 3) {
      const [a = 0, b = 0, c = 0] = triangles.slice(i, i + 3);
      const face: Triple = [a, b, c];
      const number = this.#numbers.get(keyOf(face)) ?? 0;
      if (postponeEvery > 0 && (this.#steps + 1) % postponeEvery === 0) this.#postpone(number, face);
      this.#complete(number, face);
      if (this.#steps === reopenAfter) this.#reopen();
    }
    this.#events.event(6);
    const parts = { points: this.#options.points, steps: this.#steps, events: this.#events };
    return {
      bytes: traceBytes(parts),
      fronts: this.#fronts,
      tetrahedra: this.#elements,
      points: this.#points,
    };
  }

  #base(number: number, face: Triple): void {
    const origin = this.#points.slice(3 * face[0], 3 * face[0] + 3);
    this.#events
      .event(1)
      .zigzag(number - this.#lastBase)
      .byte(16)
      .varint(0)
      .float(0.5);
    for (const coordinate of origin) this.#events.float(-0.5 * coordinate);
    this.#events.varint(3).varint(2);
    this.#lastBase = number;
    this.#steps++;
    const culprit = this.#someOtherFace(number);
    if (this.#random() % 2 === 0)
      this.#events
        .event(2, 0)
        .score(0.75)
        .zigzag(face[1] - face[0]);
    if (culprit === undefined) return;
    if (this.#random() % 2 === 0)
      this.#events
        .event(2, 1)
        .score(0.5)
        .zigzag(face[2] - face[0])
        .zigzag(culprit - number);
    if (this.#random() % 2 === 0)
      this.#events
        .event(2, 2 + 4)
        .score(0.25)
        .float(0.1)
        .float(0)
        .float(0)
        .zigzag(culprit - number);
  }

  #someOtherFace(number: number): number | undefined {
    const other = this.#random() % this.#faces.length;
    return other !== number && this.#faces[other] !== undefined ? other : undefined;
  }

  #postpone(number: number, face: Triple): void {
    this.#base(number, face);
    this.#events.event(4, 1);
    this.#record();
  }

  #complete(number: number, face: Triple): void {
    this.#base(number, face);
    const isNew = this.#centre === undefined;
    const apex = (this.#centre ??= this.#points.length / 3);
    const [a, b, c] = face;
    const sides: Triple[] = [
      [b, c, apex],
      [c, a, apex],
      [a, b, apex],
    ];
    // The front's faces look into the element: the same corners in the other order.
    const known = sides.map(([p, q, r]) => this.#numbers.get(keyOf([q, p, r])));
    const bits = known.reduce<number>((sum, other, i) => sum + (other === undefined ? 0 : 1 << i), 0);
    this.#events.event(3, bits + (isNew ? 8 : 0)).score(1);
    if (isNew) {
      this.#points.push(0, 0, 0);
      this.#events.double(0).double(0).double(0);
    } else this.#events.zigzag(apex - a);
    this.#elements.push(a, b, c, apex);
    this.#removeFace(number);
    for (const other of known) {
      if (other === undefined) continue;
      this.#events.zigzag(other - number);
      this.#removeFace(other);
    }
    sides.forEach((side, i) => {
      if (known[i] === undefined) this.#events.zigzag(this.#addFace(side) - number);
    });
    this.#record();
  }

  /** Removes the last element, whose faces look outward then, and restores it. */
  #reopen(): void {
    const last = this.#elements.length / 4 - 1;
    const [a = 0, b = 0, c = 0, d = 0] = this.#elements.slice(-4);
    const outer: Triple[] = [
      [a, b, c],
      [c, b, d],
      [a, c, d],
      [b, a, d],
    ];
    const leaving = outer.flatMap(([p, q, r]) => this.#numbers.get(keyOf([q, p, r])) ?? []);
    const joining = outer.filter(([p, q, r]) => this.#numbers.get(keyOf([q, p, r])) === undefined);
    const left = leaving.map((number) => this.#faces[number]);
    this.#change(1, { leaving, removed: [last], joining });
    const back = joining.map((face) => this.#numbers.get(keyOf(face)) ?? 0);
    this.#change(3, { leaving: back, restored: [last], joining: left.filter((face) => face !== undefined) });
  }

  #change(
    detail: number,
    {
      leaving,
      removed = [],
      restored = [],
      joining,
    }: {
      readonly leaving: readonly number[];
      readonly removed?: readonly number[];
      readonly restored?: readonly number[];
      readonly joining: readonly Triple[];
    },
  ): void {
    const events = this.#events
      .event(5, detail)
      .varint(this.#points.length / 3)
      .varint(0);
    this.#steps++;
    writeAscending(events, leaving);
    for (const number of leaving) this.#removeFace(number);
    events.varint(this.#elements.length / 4);
    writeAscending(events, removed);
    writeAscending(events, restored);
    events.varint(0).varint(joining.length);
    let last = 0;
    let node = 0;
    for (const face of joining) {
      const number = this.#addFace(face);
      events.zigzag(number - last);
      last = number;
      for (const corner of face) {
        events.zigzag(corner - node);
        node = corner;
      }
      events.varint(0);
    }
    this.#record();
  }

  #addFace(face: Triple): number {
    const number = this.#free.pop() ?? this.#faces.length;
    this.#faces[number] = face;
    this.#numbers.set(keyOf(face), number);
    return number;
  }

  #removeFace(number: number): void {
    const face = this.#faces[number];
    if (face === undefined) throw new Error(`the front has no face ${number}`);
    this.#numbers.delete(keyOf(face));
    this.#faces[number] = undefined;
    this.#free.push(number);
  }

  #record(): void {
    if (this.#options.withFronts === true) this.#fronts.push([...this.#numbers.keys()].sort());
  }
}

function writeAscending(events: TraceBytes, numbers: readonly number[]): void {
  events.varint(numbers.length);
  let last = 0;
  for (const number of [...numbers].sort((a, b) => a - b)) {
    events.varint(number - last);
    last = number;
  }
}

/** Returns the corners from the smallest on, without changing the orientation. */
export function keyOf([a, b, c]: Triple): string {
  if (b < a && b < c) return `${b} ${c} ${a}`;
  return c < a && c < b ? `${c} ${a} ${b}` : `${a} ${b} ${c}`;
}
