/**
 * A front that the reader advances, in the plane and in space: every choice stands. The rules are those that no mesh can break,
 * elements do not overlap; whether a choice is good shows later.
 */
import type { Position } from "../../../../document/position";
import { addScaled, distance, length, mean, unit } from "../../../../document/vectors";
import {
  contains,
  gapBetween,
  heightOver,
  longestSide,
  newFacets,
  normalOf,
  overlaps,
  sidesOf,
  smallestAngleOf,
} from "./simplices";

/** What a choice would break. */
export type Fault = "behind" | "crosses" | "encloses";

/** Judgement of a choice: `null` for one that stands. */
export interface Refused {
  readonly fault: Fault;
  readonly facet: readonly number[];
  readonly at: Position;
  /** Facets of the front in the way. */
  readonly inTheWay: readonly (readonly number[])[];
}

export interface Start {
  readonly nodes: readonly Position[];
  /** The front: nodes of each facet, with the empty side as in `normalOf`. */
  readonly facets: readonly (readonly number[])[];
  readonly sizeAt: (position: Position) => number;
}

/** An element lower than this over its facet is flat, as a share of the facet's longest side. */
const leastHeight = 0.02;
/** Limits of the height of an element, as shares of the size. */
const leastShare = 0.3;
/** The size of an element follows that of its facet within these factors. */
const sizeLimits = [0.55, 2] as const;
/** Heights at which a new node is tried before a facet counts as impossible, as shares of the ideal one. */
const triedHeights = [1, 0.7, 0.5, 0.3, 0.15] as const;

/** Returns the positions of some nodes. */
export const cornersOf = (nodes: readonly Position[], of: readonly number[]): Position[] =>
  of.map((node) => nodes[node] ?? [0, 0, 0]);

/** Stands for a node that is not made yet. */
const newNode = -1;

const keyOf = (facet: readonly number[]): string => facet.toSorted((a, b) => a - b).join();

interface Before {
  readonly nodes: number;
  readonly elements: number;
  readonly front: Map<string, readonly number[]>;
  readonly waiting: Set<string>;
}

export class Board {
  readonly nodes: Position[];
  readonly elements: (readonly number[])[] = [];
  /** Choices that were refused, in their order. */
  readonly refused: Refused[] = [];
  readonly givenNodes: number;
  #front: Map<string, readonly number[]>;
  /** Facets that wait since the last element was made. */
  #waiting = new Set<string>();
  readonly #sizeAt: Start["sizeAt"];
  /** How the board was before each choice that stands, the last one at the end. */
  readonly #before: Before[] = [];

  constructor({ nodes, facets, sizeAt }: Start) {
    this.nodes = [...nodes];
    this.givenNodes = nodes.length;
    this.#front = new Map(facets.map((facet) => [keyOf(facet), facet]));
    this.#sizeAt = sizeAt;
    this.#skipImpossible();
  }

  get front(): readonly (readonly number[])[] {
    return [...this.#front.values()];
  }

  get isClosed(): boolean {
    return this.#front.size === 0;
  }

  /** Whether every facet of the front waits: nothing fits any more. */
  get isStalled(): boolean {
    return !this.isClosed && this.active === null;
  }

  /** The smallest facet that does not wait; null if there is none. */
  get active(): readonly number[] | null {
    let [best, least]: [readonly number[] | null, number] = [null, Infinity];
    for (const [key, facet] of this.#front) {
      // Equal sizes differ in their last digits.
      const size = this.#waiting.has(key) ? Infinity : length(normalOf(this.positions(facet)));
      if (size < least * (1 - 1e-9)) [best, least] = [facet, size];
    }
    return best;
  }

  positions(nodes: readonly number[]): Position[] {
    return cornersOf(this.nodes, nodes);
  }

  /** Returns where a new node would be best for a facet; `share`: of its height. */
  idealOf(facet: readonly number[], share = 1): Position {
    const corners = this.positions(facet);
    const middle = mean(corners);
    const side = longestSide(corners);
    const size = Math.min(sizeLimits[1] * side, Math.max(sizeLimits[0] * side, this.#sizeAt(middle)));
    const radius = Math.max(...corners.map((corner) => distance(corner, middle)));
    const height = Math.max(leastShare * size, Math.sqrt(Math.max(0, size * size - radius * radius)));
    return addScaled(middle, unit(normalOf(corners)) ?? [0, 0, 1], share * height);
  }

  /** Returns the nodes of the front but those of the facet, the nearest to the ideal point first. */
  nodesFor(facet: readonly number[], most: number): readonly number[] {
    const ideal = this.idealOf(facet);
    const others = new Set([...this.#front.values()].flat());
    for (const node of facet) others.delete(node);
    const far = (node: number): number => distance(this.nodes[node] ?? ideal, ideal);
    return [...others].toSorted((a, b) => far(a) - far(b) || a - b).slice(0, most);
  }

  /** Judges an element over a facet: to a node, or to a new one at a position. Returns null if it breaks nothing. */
  judge(facet: readonly number[], apex: number | Position): Refused | null {
    const node = typeof apex === "number" ? apex : null;
    const at = typeof apex === "number" ? (this.nodes[apex] ?? [0, 0, 0]) : apex;
    const corners = this.positions(facet);
    const refused = (fault: Fault, inTheWay: Refused["inTheWay"] = []): Refused => ({
      fault,
      facet,
      at,
      inTheWay,
    });
    if (heightOver(corners, at) < leastHeight) return refused("behind");
    const element = [...corners, at];
    const own = new Set(node === null ? facet : [...facet, node]);
    const inTheWay = this.front.filter((other) =>
      this.#meets(element, facet, at, node ?? newNode, own, other),
    );
    if (inTheWay.length > 0) return refused("crosses", inTheWay);
    const others = new Set(this.front.flat());
    for (const other of others)
      if (!own.has(other) && contains(element, this.nodes[other] ?? [Infinity, 0, 0]))
        return refused("encloses");
    return null;
  }

  #meets(
    element: readonly Position[],
    facet: readonly number[],
    at: Position,
    apex: number,
    own: ReadonlySet<number>,
    other: readonly number[],
  ): boolean {
    // A facet between corners of the element is one of its own.
    if (other.every((node) => own.has(node))) return false;
    if (overlaps(element, this.positions(other))) return true;
    // In one plane, sides can cross though nothing overlaps in space.
    const least = 1e-6 * longestSide(element);
    return facet.some((node) =>
      sidesOf(other)
        .filter((side) => !side.includes(node) && !side.includes(apex))
        .some(([a, b]) => {
          const [from = at, p = at, q = at] = this.positions([node, a, b]);
          return gapBetween([from, at], [p, q]) < least;
        }),
    );
  }

  /** Makes an element over the active facet, unless the choice is refused; then it is noted. */
  choose(apex: number | Position): Refused | null {
    const facet = this.active;
    if (!facet) return null;
    const refused = this.judge(facet, apex);
    if (refused) {
      this.refused.push(refused);
      return refused;
    }
    this.#keep();
    const node = typeof apex === "number" ? apex : this.nodes.push(apex) - 1;
    this.elements.push([...facet, node]);
    this.#front.delete(keyOf(facet));
    for (const made of newFacets(facet, node)) {
      const key = keyOf(made);
      // Both sides of the facet are filled now.
      if (!this.#front.delete(key)) this.#front.set(key, made);
    }
    this.#waiting.clear();
    this.#skipImpossible();
    return null;
  }

  /** Lets the active facet wait until the next element is made. */
  wait(): void {
    const facet = this.active;
    if (!facet) return;
    this.#keep();
    this.#waiting.add(keyOf(facet));
    this.#skipImpossible();
  }

  get canUndo(): boolean {
    return this.#before.length > 0;
  }

  /** Takes the last choice that stands back, or the last facet that was left for later. Refusals stay counted. */
  undo(): void {
    const before = this.#before.pop();
    if (!before) return;
    this.nodes.length = before.nodes;
    this.elements.length = before.elements;
    this.#front = before.front;
    this.#waiting = before.waiting;
  }

  #keep(): void {
    this.#before.push({
      nodes: this.nodes.length,
      elements: this.elements.length,
      front: new Map(this.#front),
      waiting: new Set(this.#waiting),
    });
  }

  #skipImpossible(): void {
    for (let facet = this.active; facet && !this.#isPossible(facet); facet = this.active)
      this.#waiting.add(keyOf(facet));
  }

  /** Returns where a new node breaks nothing: in the middle of the front, at the ideal point, or lower. Null if nowhere. */
  #newNodeFor(facet: readonly number[]): Position | null {
    const heights = triedHeights.map((share) => this.idealOf(facet, share));
    const middle = mean(this.positions([...new Set(this.front.flat())]));
    const tried = facet.length === 3 ? [middle, ...heights] : [...heights, middle];
    return tried.find((at) => this.judge(facet, at) === null) ?? null;
  }

  /** Returns where a new node is proposed: where it stands, or at the ideal point if it stands nowhere. */
  proposalFor(facet: readonly number[]): Position {
    return this.#newNodeFor(facet) ?? this.idealOf(facet);
  }

  #hasNode(facet: readonly number[]): boolean {
    return this.nodesFor(facet, Infinity).some((node) => this.judge(facet, node) === null);
  }

  #isPossible(facet: readonly number[]): boolean {
    return this.#hasNode(facet) || this.#newNodeFor(facet) !== null;
  }
}

/** What two meshes of one shape are compared by. */
export interface MeshMeasures {
  readonly elements: number;
  readonly newNodes: number;
  /** Smallest angle in degrees, and the element that has it; none without elements. */
  readonly angle: number;
  readonly worst: number | null;
}

export function measuresOf(
  nodes: readonly Position[],
  elements: readonly (readonly number[])[],
  givenNodes: number,
): MeshMeasures {
  const angles = elements.map((element) => smallestAngleOf(cornersOf(nodes, element)));
  const angle = Math.min(...angles);
  return {
    elements: elements.length,
    newNodes: nodes.length - givenNodes,
    angle: elements.length > 0 ? angle : 0,
    worst: elements.length > 0 ? angles.indexOf(angle) : null,
  };
}
