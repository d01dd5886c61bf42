/** Two triangles in space as six pairs of a side and a face (Löhner & Parikh 1988, section 6, equations 1 to 5). */
import type { Position } from "../../../../document/position";
import {
  alphasOf,
  excessOf,
  pointAt,
  type Alphas,
  type Segment,
  type Triangle,
} from "../../../player/crossing";

export interface SpacePair {
  /** Whether the side belongs to the new face. */
  readonly isNewSide: boolean;
  readonly side: Segment;
  readonly face: Triangle;
  /** Infinite if the side is parallel to the face. */
  readonly alphas: Alphas;
  readonly excess: number;
  /** Where the line of the side meets the plane of the face; null if they are parallel. */
  readonly at: Position | null;
}

const parallel: Alphas = [Infinity, Infinity, Infinity, -Infinity];

/** Returns the pairs: the sides of the new face against the face of the front, then the other way round. */
export function pairsOf(added: Triangle, front: Triangle): readonly SpacePair[] {
  return [0, 1, 2, 3, 4, 5].map((index) => {
    const isNewSide = index < 3;
    const [own, face] = isNewSide ? [added, front] : [front, added];
    const side: Segment = [own[index % 3] as Position, own[(index + 1) % 3] as Position];
    const alphas = alphasOf(side, face) ?? parallel;
    const isParallel = alphas === parallel;
    return {
      isNewSide,
      side,
      face,
      alphas,
      excess: isParallel ? Infinity : excessOf(alphas),
      at: isParallel ? null : pointAt(side, alphas[2]),
    };
  });
}

/** Returns whether α⁴ alone keeps a pair from crossing: it lies below −t, the three others in the band. */
export function isStoppedByFourth({ alphas }: SpacePair, tolerance: number): boolean {
  const isInBand = (alpha: number): boolean => alpha >= -tolerance && alpha <= 1 + tolerance;
  return alphas.slice(0, 3).every(isInBand) && alphas[3] < -tolerance;
}
