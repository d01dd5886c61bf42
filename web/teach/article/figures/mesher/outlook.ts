/** What a choice is worth: the angle of its element, and the corners that it leaves in the front. */
import { distance, subtract } from "../../../../document/vectors";
import type { Position } from "../../../../document/position";
import type { Board } from "./board";
import { longestSide, smallestAngleOf } from "./simplices";

export interface Outlook {
  /** Smallest angle of the element, in degrees. */
  readonly angle: number;
  /** Smallest angle that an element in a corner of the front can have at best, in degrees; null in space. */
  readonly left: number | null;
  /** The corner of the front that limits it. */
  readonly corner: number | null;
}

/** A new node leaves more to fill than a node that is there: as many degrees as it must be better. */
const costOfNewNode = 6;
/** A new node nearer to the front than this share of its facet leaves no room for good elements. */
const room = 0.7;
const costOfNearness = 40;
const regular = 60;
const degrees = 180 / Math.PI;

/** Returns what becomes of a choice over the active facet; null if it is refused. The board is left as it was. */
export function outlookOf(board: Board, choice: number | Position): Outlook | null {
  const facet = board.active;
  if (!facet || board.judge(facet, choice) !== null) return null;
  const apex = typeof choice === "number" ? board.positions([choice]) : [choice];
  const angle = smallestAngleOf([...board.positions(facet), ...apex]);
  if (facet.length === 3) return { angle, left: null, corner: null };
  board.choose(choice);
  const worst = board.isStalled ? { left: 0, corner: null } : worstCorner(board);
  board.undo();
  return { angle, ...worst };
}

/** Returns the choice of a careful player: good angles, now and in what is left of a front in the plane. Null if nothing stands. */
export function carefulChoice(
  board: Board,
  nodes: readonly number[],
  newNode: Position,
): number | "new" | null {
  const side = longestSide(board.positions(board.active ?? []));
  const nearest = Math.min(
    ...[...new Set(board.front.flat())].map((node) =>
      distance(board.positions([node])[0] ?? newNode, newNode),
    ),
  );
  const ranked = [...nodes, "new" as const].flatMap((choice) => {
    const outlook = outlookOf(board, choice === "new" ? newNode : choice);
    if (!outlook) return [];
    const worth = Math.min(outlook.angle, outlook.left ?? Infinity);
    const nearness = Math.max(0, room - nearest / side);
    // In space, new nodes can go on for ever: one is made when nothing else is left.
    const cost = outlook.left === null ? Infinity : costOfNewNode + costOfNearness * nearness;
    return [{ choice, worth: choice === "new" ? worth - cost : worth }];
  });
  return ranked.toSorted((a, b) => b.worth - a.worth)[0]?.choice ?? null;
}

/** A corner is divided among as many triangles as are good for it. */
function worstCorner(board: Board): { readonly left: number; readonly corner: number | null } {
  const { front } = board;
  let [left, corner]: [number, number | null] = [regular, null];
  for (const [start = 0, node = 0] of front) {
    const next = front.filter(([first]) => first === node);
    const angles = next.map(([, end = 0]) => angleAt(board, start, node, end));
    const angle = Math.min(...angles);
    const share = angle / Math.max(1, Math.round(angle / regular));
    if (share < left) [left, corner] = [share, node];
  }
  return { left, corner };
}

/** Returns the angle at a corner on its empty side, from above 0° to 360°. */
function angleAt(board: Board, start: number, node: number, end: number): number {
  const [a, b, c] = board.positions([start, node, end]);
  if (!a || !b || !c) return 360;
  const [u, v] = [subtract(c, b), subtract(a, b)];
  const angle = Math.atan2(u[0] * v[1] - u[1] * v[0], u[0] * v[0] + u[1] * v[1]) * degrees;
  return angle > 0 ? angle : angle + 360;
}
