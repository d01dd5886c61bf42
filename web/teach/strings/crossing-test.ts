/** Texts about the paper's crossing test and its layers. */

import { formatCount } from "../../strings/format";
const nodeName = (node: number | null): string =>
  node === null ? "the new node" : `node ${formatCount(node)}`;

export const crossingTestStrings = {
  title: "Crossing test",
  layer: { a: "(a) Boxes", b: "(b) Shape functions", c: "(c) Sides and faces" },
  /** A layer that finds no crossing ends the test. */
  verdicts: { goesOn: "goes on", apart: "no crossing", crosses: "crosses" },
  found: (face: number, { isNewSide, ends, isTouching }: FoundCrossing): string => {
    const side = `from ${nodeName(ends[0])} to ${nodeName(ends[1])}`;
    const verb = isTouching ? "touches" : "passes through";
    return isNewSide
      ? `Layer (c) finds the crossing: the side ${side} of the new element ${verb} face ${formatCount(face)}.`
      : `Layer (c) finds the crossing: the side ${side} of face ${formatCount(face)} ${verb} a face of the new element.`;
  },
  exact: (face: number): string =>
    `Decided by our exact sign: the layers do not decide on face ${formatCount(face)}, because no side of one passes through a face of the other, apart from common nodes.`,
  hint: "Step F5.3, section 6 of the paper. (a): distance of the boxes along axis i, against t times the element’s longest extent. (b): Nⁱ is 1 at corner i of the new element and 0 on the face opposite. (c): equations 1 to 5, with the inequality the right way round. The engine decides by exact signs, without t.",
} as const;

interface FoundCrossing {
  /** Whether the side is one of the new element's. */
  readonly isNewSide: boolean;
  /** The nodes at its ends; null for a new node. */
  readonly ends: readonly [number | null, number | null];
  readonly isTouching: boolean;
}
