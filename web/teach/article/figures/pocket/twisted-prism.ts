/** The pocket of E. Schönhardt (1928): a prism on a regular triangle whose upper end is turned against the lower one. */
import type { Position } from "../../../../document/position";
import type { Face, Pocket } from "./pocket-rules";

const prismRadius = 0.72;
export const prismHeight = 1.05;

/** Faces of the pocket. Corners 0 to 2 are below, 3 to 5 above them; each wall is divided by the diagonal from i to 3 + j. */
const faces: readonly Face[] = [
  [0, 1, 2],
  [3, 5, 4],
  ...[0, 1, 2].flatMap((i): Face[] => {
    const j = (i + 1) % 3;
    return [
      [i, 3 + j, j],
      [i, 3 + i, 3 + j],
    ];
  }),
];

/** Direction of a corner in degrees, without twist. */
export const prismDirection = (corner: number): number => 90 + 120 * (corner % 3);

/** Returns the prism, twisted by an angle in degrees. From 0° to 60°, its walls bend inward. */
export function twistedPrism(twist: number): Pocket {
  const corners = [0, 1, 2, 3, 4, 5].map((corner): Position => {
    const isUpper = corner > 2;
    const angle = ((prismDirection(corner) + (isUpper ? twist : 0)) * Math.PI) / 180;
    return [prismRadius * Math.cos(angle), prismRadius * Math.sin(angle), isUpper ? prismHeight : 0];
  });
  return { corners, faces };
}
