/** Texts of "Be the mesher". */
import { formatCount } from "../../strings/format";
const edgesOf = (edges: readonly number[]): string =>
  `${edges.length === 1 ? "edge" : "edges"} ${edges.slice(0, 4).map(formatCount).join(", ")}${edges.length > 4 ? " …" : ""}`;
const nameOf = (node: number | null): string => (node === null ? "a new node" : `node ${formatCount(node)}`);
/** How the program came to its choice. `refused`: candidates that it tried first. */
const choiceOf = (node: number | null, refused: number): string =>
  refused === 0
    ? `The program chose ${nameOf(node)}, which comes first in its ranking.`
    : `The program chose ${nameOf(node)}: it tried ${refused === 1 ? "1 better-ranked candidate" : `${formatCount(refused)} better-ranked candidates`} first and refused ${refused === 1 ? "it" : "them"}.`;

/** Whose choice a node is, after the verdict. */
export function pickText(isOwn: boolean, isProgram: boolean): string | null {
  if (isOwn) return isProgram ? "you and program" : "you";
  return isProgram ? "program" : null;
}

export const mesherGameStrings = {
  start: "Be the mesher",
  end: "End the game",
  task: "The thick blue edge comes next. Which node should make a triangle over it? Choose in the drawing or below.",
  levelLabel: "Level",
  levels: { easy: "Easy", medium: "Medium", hard: "Hard" },
  help: {
    easy: "The ring is the ideal point, at the target size from the edge. A node of the front is chosen if one is near it, else a new node is made.",
    medium: "The ring is the ideal point. Some near nodes would make the triangle cross the front.",
    hard: "Without the ideal point, and only where the program refused a candidate first.",
  },
  choices: "Nodes to choose from",
  newNode: "new",
  node: (node: number | null) => (node === null ? "New node" : `Node ${formatCount(node)}`),
  score: (points: number, rounds: number) => `${formatCount(points)} of ${formatCount(2 * rounds)} points`,
  next: "Next edge",
  lens: "The view and the plane show the base edge that comes next. The lens explains steps again when the game has ended.",
  none: "No further edge of this level follows. Choose another level, or go back in the player.",
  verdict: {
    best: () => "The program chose the same. 2 points.",
    possible: (_: readonly number[], program: number | null, refused: number) =>
      `Possible: the triangle would cross nothing. ${choiceOf(program, refused)} 1 point.`,
    behind: (_: readonly number[], program: number | null) =>
      `No point. The node is behind the edge or in line with it: the triangle would have no area, or lie on triangles that exist. The program chose ${nameOf(program)}.`,
    crosses: (edges: readonly number[], program: number | null) =>
      `No point. The triangle would cross ${edgesOf(edges)} of the front, drawn red: two triangles would overlap. The program chose ${nameOf(program)}.`,
    "same-node": (_: readonly number[], program: number | null) =>
      `No point. In space the node is an end of the base edge, on the other side of the seam: the triangle would have two equal nodes. The program chose ${nameOf(program)}.`,
    outside: (_: readonly number[], program: number | null) =>
      `No point. The new node would be outside the patch. The program chose ${nameOf(program)}.`,
    "too-close": (edges: readonly number[], program: number | null) =>
      `No point. The new node would be too close to ${edgesOf(edges)}, drawn red: the gap could only be filled by thin triangles. The program chose ${nameOf(program)}.`,
  },
  disputed: "Our own check, in doubles, finds otherwise; the program decides by exact signs.",
} as const;

const facesOf = (faces: readonly number[]): string =>
  `${faces.length === 1 ? "face" : "faces"} ${faces.slice(0, 4).map(formatCount).join(", ")}${faces.length > 4 ? " …" : ""}`;

/** Texts of "Be the mesher" in the volume. */
export const volumeGameStrings = {
  task: "The blue face comes next. Which node should make an element over it? Choose in the view or here.",
  help: {
    easy: "The dot in front of the face is the ideal point. A node of the front is chosen if one is near it, else a new node is made.",
    medium: "The dot is the ideal point. Some near nodes would make the element cross the front.",
    hard: "Without the ideal point, and only where the program refused a candidate first.",
  },
  next: "Next face",
  none: "No further face of this level follows. Choose another level, or go back in the player.",
  verdict: {
    best: () => "The program chose the same. 2 points.",
    possible: (_: readonly number[], program: number | null, refused: number) =>
      `Possible: the element would cross nothing. ${choiceOf(program, refused)} 1 point.`,
    behind: (_: readonly number[], program: number | null) =>
      `No point. The node is behind the face or in its plane: the element would have no volume, or lie in elements that exist. The program chose ${nameOf(program)}.`,
    crosses: (faces: readonly number[], program: number | null) =>
      `No point. The element would cross ${facesOf(faces)} of the front: two elements would overlap. The program chose ${nameOf(program)}.`,
    "too-close": (faces: readonly number[], program: number | null) =>
      `No point. The new node would be too close to ${facesOf(faces)}: the gap could only be filled by flat elements. The program chose ${nameOf(program)}.`,
  },
} as const;
