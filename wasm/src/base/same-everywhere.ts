/**
 * Values with the same bits in every JavaScript engine, which meshes that are the same everywhere follow from. The language leaves
 * the last bits of `Math.sin`, `Math.exp`, `Math.log` and `**` to the engine; those of Node and of browsers differ often.
 */

/** Rounds a value that need not be exact to single precision, so that the last bits of its operands have no effect. */
export const steady = (value: number): number => Math.fround(value);

/** A quarter turn as a sum: products of the first part with whole numbers below 2^20 are exact. */
const QUARTER = 1.5707963267341256;
const QUARTER_REST = 6.077100506506192e-11;
/** Order of the last term of the series below; further terms would not change the sums. */
const LAST_TERM = 18;

/** Returns the cosine and the sine of an angle in radians, off by at most a unit or two of the last place of 1. */
export function cosineAndSine(angle: number): readonly [cosine: number, sine: number] {
  const quarters = Math.round(angle / (Math.PI / 2));
  const rest = angle - quarters * QUARTER - quarters * QUARTER_REST;
  const square = rest * rest;
  let cosine = 1;
  let sine = 1;
  for (let n = LAST_TERM; n > 0; n -= 2) {
    cosine = 1 - (square / (n * (n - 1))) * cosine;
    sine = 1 - (square / (n * (n + 1))) * sine;
  }
  sine *= rest;
  switch (quarters & 3) {
    case 0:
      return [cosine, sine];
    case 1:
      return [-sine, cosine];
    case 2:
      return [-cosine, -sine];
    default:
      return [sine, -cosine];
  }
}

/** Returns the hyperbolic cosine and sine, off by some units of the last place of the cosine. */
export function hyperbolicCosineAndSine(value: number): readonly [cosine: number, sine: number] {
  let rest = value;
  let halvings = 0;
  for (; Math.abs(rest) > 0.5; rest /= 2) halvings++;
  let power = 1;
  for (let n = LAST_TERM; n > 0; n--) power = 1 + (rest / n) * power;
  for (; halvings > 0; halvings--) power *= power;
  return [(power + 1 / power) / 2, (power - 1 / power) / 2];
}
