/** The record of the front in space as a film: state 0 is the boundary, and step k leads to state k + 1. */
import type { AdvanceStep, Trace } from "tetrafront/trace";
import type { Position } from "../../../../document/position";
import { mean } from "../../../../document/vectors";
import type { Film } from "../../kit/film-player";

export interface BallFace {
  /** Counter-clockwise as seen from the empty side. */
  readonly corners: readonly Position[];
  readonly nodes: readonly number[];
  readonly middle: Position;
  readonly born: number;
  readonly died: number;
  /** Index of the element on whose side it lies; null on the boundary. */
  readonly owner: number | null;
}

export interface BallElement {
  readonly middle: Position;
  readonly born: number;
  readonly died: number;
  /** Its four faces, counter-clockwise as seen from outside, and the elements beyond them; null for the boundary. */
  readonly faces: readonly { readonly corners: readonly Position[]; readonly beyond: number | null }[];
}

export class BallFilm implements Film {
  readonly stepCount: number;
  readonly sizes: readonly number[];
  readonly refusals: readonly number[];
  readonly faces: readonly BallFace[];
  readonly elements: readonly BallElement[];
  readonly boundaryNodes: number;
  readonly nodeCount: number;
  readonly #trace: Trace;

  constructor(trace: Trace) {
    this.#trace = trace;
    this.stepCount = trace.stepCount;
    this.sizes = [...trace.steps.frontSizes].slice(0, this.stepCount + 1);
    this.refusals = Array.from({ length: this.stepCount }, (_none, k) => k).filter(
      (k) => this.refusedIn(k) > 0,
    );
    this.nodeCount = trace.nodes.born.length;
    this.boundaryNodes = trace.nodes.born.filter((born) => born === 0).length;
    const at = (node: number): Position => [
      trace.nodes.positions[3 * node] ?? 0,
      trace.nodes.positions[3 * node + 1] ?? 0,
      trace.nodes.positions[3 * node + 2] ?? 0,
    ];
    const owners = new Map<string, number[]>();
    const nodesOf = (element: number): readonly number[] => [
      ...trace.elements.nodes.subarray(4 * element, 4 * element + 4),
    ];
    const count = trace.elements.born.length;
    for (let element = 0; element < count; element++)
      for (const face of outwardFaces(nodesOf(element))) {
        const key = keyOf(face);
        owners.set(key, [...(owners.get(key) ?? []), element]);
      }
    this.elements = Array.from({ length: count }, (_none, element): BallElement => {
      const nodes = nodesOf(element);
      return {
        middle: mean(nodes.map(at)),
        born: trace.elements.born[element] ?? 0,
        died: trace.elements.died[element] ?? Infinity,
        faces: outwardFaces(nodes).map((face) => ({
          corners: face.map(at),
          beyond: owners.get(keyOf(face))?.find((other) => other !== element) ?? null,
        })),
      };
    });
    this.faces = Array.from({ length: trace.faces.born.length }, (_none, face): BallFace => {
      const nodes = [...trace.faces.nodes.subarray(3 * face, 3 * face + 3)];
      const corners = nodes.map(at);
      const born = trace.faces.born[face] ?? 0;
      const owner = owners.get(keyOf(nodes))?.find((each) => this.elements[each]?.born === born);
      const died = trace.faces.died[face] ?? Infinity;
      return {
        corners,
        nodes,
        middle: mean(corners),
        born,
        died,
        owner: born === 0 ? null : (owner ?? null),
      };
    });
  }

  /** Returns the number of candidates that step k refuses. */
  refusedIn(k: number): number {
    const { firstCandidates } = this.#trace.steps;
    const tried = (firstCandidates[k + 2] ?? 0) - (firstCandidates[k + 1] ?? 0);
    const isAccepted =
      (this.#trace.steps.elementsMade[k + 1] ?? 0) > (this.#trace.steps.elementsMade[k] ?? 0);
    return Math.max(0, tried - (isAccepted ? 1 : 0));
  }

  /** Decodes step k, from 0; undefined if it is no step of the front. */
  stepAt(k: number): AdvanceStep | undefined {
    const step = this.#trace.stepAt(k + 1);
    return step?.kind === "advance" ? step : undefined;
  }

  /** Returns the number of elements of a state. */
  filledAt(state: number): number {
    return this.elements.filter(({ born, died }) => born <= state && died > state).length;
  }
}

const keyOf = (nodes: readonly number[]): string => nodes.toSorted((a, b) => a - b).join(" ");

/** The first three nodes are counter-clockwise as seen from the fourth. */
const outwardFaces = ([a = 0, b = 0, c = 0, d = 0]: readonly number[]): readonly (readonly number[])[] => [
  [a, c, b],
  [a, b, d],
  [b, c, d],
  [c, a, d],
];
