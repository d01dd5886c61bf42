/**
 * The three layers of the paper's crossing test (Löhner & Parikh 1988, section 6), in doubles and for display. Each layer has
 * one number. If it is above the tolerance, the layer finds that the element does not cross the face.
 */
import type { SideAndFace } from "./crossing";
import { sidesAndFaces, touching, weightsOf, type FrontFace, type NewElement } from "./judge";
import { boxOf, type Box } from "../../document/vectors";

/** The tolerance t of layers (b) and (c). Layer (a) uses it as a share of the element's longest extent along an axis. */
export const tolerance = touching;

/** The numbers of the layers for a new element and a face of the front. */
export interface LayeredTest {
  /** Layer (a): the largest distance between their boxes along an axis; negative if the boxes overlap. */
  readonly boxGap: number;
  /** The least distance d at which boxes count as apart. */
  readonly minGap: number;
  /** Layer (b): by how much a shape function of the element is outside [0, 1], on one side, in all nodes of the face. */
  readonly shapeExcess: number;
  /** Layer (c): the side and the face that cross most clearly; null if all have a common node or are parallel. */
  readonly pair: SideAndFace | null;
  /** Whether a side and a face cross, by layer (c). If not, the layers alone find no crossing. */
  readonly finds: boolean;
}

export function testByLayers(element: NewElement, face: FrontFace): LayeredTest {
  const box = boxOf(element.corners.flat());
  const pair = sidesAndFaces(element, face)[0] ?? null;
  return {
    boxGap: gapBetween(box, boxOf(face.corners.flat())),
    minGap: tolerance * Math.max(...axes.map((axis) => box.high[axis] - box.low[axis])),
    shapeExcess: shapeExcessOf(element, face),
    pair,
    finds: pair !== null && pair.excess <= tolerance,
  };
}

const axes = [0, 1, 2] as const;

/** Equation 7: a box is beyond the other one along at least one axis, or they overlap. */
function gapBetween(one: Box, other: Box): number {
  return Math.max(
    ...axes.map((axis) => Math.max(other.low[axis] - one.high[axis], one.low[axis] - other.high[axis])),
  );
}

function shapeExcessOf({ corners }: NewElement, face: FrontFace): number {
  const atNodes = face.corners.map((position) => weightsOf(corners, position));
  const excesses = corners.map((_, i) => {
    const values = atNodes.map((weights) => weights[i] ?? 0);
    return Math.max(-Math.max(...values), Math.min(...values) - 1);
  });
  return Math.max(...excesses);
}
