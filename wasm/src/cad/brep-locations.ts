/**
 * Locations in a BREP file: products of powers of motions. Shapes and curves belong together if their locations are
 * the same product, so products are compared and not their numbers.
 */
import type { Vector } from "../base/vectors.js";
import type { BrepWords } from "./brep-words.js";
import type { Frame } from "./trimmed-model.js";

/** Factors from left to right: an elementary motion and its power, never 0. Neighbours are of different motions. */
export type Location = readonly (readonly [motion: number, power: number])[];

export const NOWHERE: Location = [];

export function product(left: Location, right: Location): Location {
  const [last, next] = [left.at(-1), right[0]];
  if (last === undefined) return right;
  if (next === undefined) return left;
  if (last[0] !== next[0]) return [...left, ...right];
  const power = last[1] + next[1];
  const [before, after] = [left.slice(0, -1), right.slice(1)];
  return power === 0 ? product(before, after) : [...before, [last[0], power], ...after];
}

function raised(location: Location, power: number): Location {
  const factor: Location =
    power > 0 ? location : location.map(([motion, one]) => [motion, -one] as const).toReversed();
  let result = NOWHERE;
  for (let k = 0; k < Math.abs(power); k++) result = product(result, factor);
  return result;
}

export const keyOf = (location: Location): string => location.map((factor) => factor.join("^")).join(" ");

/** Three rows of a rotation, each with its part of the shift. */
type Motion = readonly number[];

const STAY: Motion = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0];

/** How far the rows of a motion may be from unit vectors. */
const SCALE_TOLERANCE = 1e-7;
/** OpenCascade writes powers 1 and -1; arrays of many copies have one motion each. */
const MAX_POWER = 1000;

export class Placing {
  readonly #motion: Motion;

  constructor(motion: Motion) {
    this.#motion = motion;
  }

  point(at: Vector): Vector {
    return this.#apply(at, 1);
  }

  frame({ origin, x, y, z }: Frame): Frame {
    return {
      origin: this.#apply(origin, 1),
      x: this.#apply(x, 0),
      y: this.#apply(y, 0),
      z: this.#apply(z, 0),
    };
  }

  points(all: Float64Array): Float64Array {
    const result = new Float64Array(all.length);
    for (let i = 0; i < all.length; i += 3)
      result.set(this.point([all[i] ?? 0, all[i + 1] ?? 0, all[i + 2] ?? 0]), i);
    return result;
  }

  #apply([x, y, z]: Vector, shift: number): Vector {
    const row = (r: number) => {
      const [a = 0, b = 0, c = 0, d = 0] = this.#motion.slice(4 * r, 4 * r + 4);
      return a * x + b * y + c * z + shift * d;
    };
    return [row(0), row(1), row(2)];
  }
}

export class Locations {
  readonly #locations: Location[] = [NOWHERE];
  readonly #motions = new Map<number, Motion>();
  readonly #placings = new Map<string, Placing>();

  constructor(words: BrepWords) {
    const count = words.table("Locations");
    for (let i = 1; i <= count; i++) {
      if (words.count(2) === 1) {
        const motion = words.numbers(12);
        for (let r = 0; r < 12; r += 4) {
          const length = Math.hypot(motion[r] ?? 0, motion[r + 1] ?? 0, motion[r + 2] ?? 0);
          if (Math.abs(length - 1) > SCALE_TOLERANCE) throw words.wrong("a location scales its shape");
        }
        this.#motions.set(i, Array.from(motion));
        this.#locations.push([[i, 1]]);
      } else this.#locations.push(this.#readProduct(words, i));
    }
  }

  #readProduct(words: BrepWords, before: number): Location {
    let location = NOWHERE;
    for (let of = words.count(before - 1); of !== 0; of = words.count(before - 1)) {
      const power = words.number();
      if (!Number.isInteger(power) || Math.abs(power) > MAX_POWER)
        throw words.wrong("the power of a location is invalid");
      location = product(raised(this.#locations[of] ?? NOWHERE, power), location);
    }
    return location;
  }

  /** Reads the number of a location. */
  read(words: BrepWords): Location {
    return this.#locations[words.count(this.#locations.length - 1)] ?? NOWHERE;
  }

  placing(location: Location): Placing {
    const key = keyOf(location);
    const known = this.#placings.get(key);
    if (known !== undefined) return known;
    let motion = STAY;
    for (const [of, power] of location) {
      const one = this.#motions.get(of) ?? STAY;
      const factor = power > 0 ? one : inverse(one);
      for (let k = 0; k < Math.abs(power); k++) motion = composed(motion, factor);
    }
    const placing = new Placing(motion);
    this.#placings.set(key, placing);
    return placing;
  }
}

const entry = (motion: Motion, row: number, column: number) => motion[4 * row + column] ?? 0;

function composed(left: Motion, right: Motion): Motion {
  return STAY.map((_, i) => {
    const [row, column] = [Math.floor(i / 4), i % 4];
    const sum = [0, 1, 2].reduce((all, k) => all + entry(left, row, k) * entry(right, k, column), 0);
    return column === 3 ? sum + entry(left, row, 3) : sum;
  });
}

/** Returns the inverse of a rotation, or reflection, with a shift. */
function inverse(motion: Motion): Motion {
  return STAY.map((_, i) => {
    const [row, column] = [Math.floor(i / 4), i % 4];
    if (column < 3) return entry(motion, column, row);
    return -[0, 1, 2].reduce((all, k) => all + entry(motion, k, row) * entry(motion, k, 3), 0);
  });
}
