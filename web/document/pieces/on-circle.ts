import type { Position } from "../position";

/** Cosine and sine of a share of a full turn, exact for multiples of a quarter: no rounding where none is needed. */
export function turn(share: number): readonly [cosine: number, sine: number] {
  const quarters = 4 * share;
  if (Number.isInteger(quarters)) {
    const exact = [
      [1, 0],
      [0, 1],
      [-1, 0],
      [0, -1],
    ] as const;
    return exact[((quarters % 4) + 4) % 4] ?? [1, 0];
  }
  const angle = 2 * Math.PI * share;
  return [Math.cos(angle), Math.sin(angle)];
}

/** Returns the point of a circle around the z axis at a share of a full turn from the x axis, at a height z. */
export function onCircle(radius: number, share: number, z: number): Position {
  const [cosine, sine] = turn(share);
  return [radius * cosine, radius * sine, z];
}
