/** Texts about the steps of recovery, with their numbers. */
import { formatCount, formatCounted } from "../../strings/format";
import type { FrontChange } from "tetrafront/trace";
import type { Beat } from "./film";

/** What a step of recovery does to the front and the mesh, in numbers. */
export interface RecoveryCounts {
  readonly removedFaces: number;
  readonly addedFaces: number;
  readonly removedElements: number;
  readonly addedElements: number;
  /** New nodes, ascending. */
  readonly nodes: readonly number[];
  /** Faces of the front before the step and after it. */
  readonly before: number;
  readonly after: number;
}

const newNodes = (nodes: readonly number[]): string => {
  const [first = 0, last = first] = [nodes[0], nodes.at(-1)];
  if (nodes.length === 0) return "no new node";
  return nodes.length === 1
    ? `new node ${formatCount(first)}`
    : `${formatCount(nodes.length)} new nodes, ${formatCount(first)} to ${formatCount(last)}`;
};

const frontOf = ({ before, after }: RecoveryCounts): string => {
  if (before === after) return `The front has ${formatCounted(after, "face")}.`;
  return after === 0
    ? `The front goes from ${formatCounted(before, "face")} to none: it is closed.`
    : `The front goes from ${formatCount(before)} to ${formatCounted(after, "face")}.`;
};

const sentences: Readonly<Record<FrontChange, (counts: RecoveryCounts) => string>> = {
  star: ({ removedFaces, addedElements, nodes }) =>
    `The pocket has ${formatCounted(removedFaces, "face")}. It is closed by a star: ${formatCounted(addedElements, "element")} around ${newNodes(nodes)}.`,
  reopened: ({ removedElements, removedFaces, addedFaces }) =>
    `The elements around a pocket are removed, so that the front can fill it in another way: ${formatCounted(removedElements, "element")}. ${formatCounted(removedFaces, "face")} ${removedFaces === 1 ? "leaves" : "leave"} the front, and ${formatCount(addedFaces)} ${addedFaces === 1 ? "joins" : "join"} it.`,
  closed: ({ removedFaces, addedElements, nodes }) =>
    removedFaces === 0
      ? "The pocket that was reopened is closed."
      : `The pocket that was reopened is closed: the last ${formatCounted(removedFaces, "face")} by ${nodes.length === 1 ? "a star" : "stars"} of ${formatCounted(addedElements, "element")} around ${newNodes(nodes)}.`,
  undone: ({ removedElements, addedElements }) =>
    `The attempt to fill the pocket in another way is undone: ${formatCounted(removedElements, "element")} made in it ${removedElements === 1 ? "is" : "are"} removed, and ${formatCount(addedElements)} put back.`,
  "exact-fill": ({ removedFaces, addedElements, nodes }) =>
    `The pocket has ${formatCounted(removedFaces, "face")}. It is filled exactly, with ${formatCounted(addedElements, "element")} and ${newNodes(nodes)}.`,
};

/** What the beats before the last one show of a step. */
const earlySentences: Readonly<
  Partial<Record<Beat, (change: FrontChange, counts: RecoveryCounts) => string>>
> = {
  pocket: (change, { removedFaces }) =>
    change === "reopened"
      ? "No star closes this pocket, so the elements around it will be removed."
      : `The front is stuck here: no element fits into this pocket of ${formatCounted(removedFaces, "face")}.`,
  node: (change, { nodes, removedFaces }) => {
    if (change === "exact-fill") return `The exact fill needs ${newNodes(nodes)}.`;
    return nodes.length === 1
      ? `Inside the pocket, ${newNodes(nodes)} sees all ${formatCounted(removedFaces, "face")}: an element fits between it and each of them.`
      : `Nodes are placed inside the pocket. Each sees all faces of its part: ${newNodes(nodes)}.`;
  },
  attempt: () => "The front is stuck in the opened place, too: all elements of this attempt will be removed.",
};

/** Returns what a step of recovery does; in an early beat, only what has been shown by then. */
export const recoverySentence = (
  change: FrontChange,
  counts: RecoveryCounts,
  beat: Beat | null = null,
): string => {
  const early = beat && counts.removedFaces > 0 ? earlySentences[beat] : undefined;
  return early ? early(change, counts) : `${sentences[change](counts)} ${frontOf(counts)}`;
};
