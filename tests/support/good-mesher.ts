/** Plays "Be the mesher" well: of the choices that stand, the one whose element has the largest smallest angle. */
import { Board, type Start } from "../../web/teach/article/figures/mesher/board";
import { smallestAngleOf } from "../../web/teach/article/figures/mesher/simplices";

/** Returns the choices in their order, and the board as they leave it. New nodes are made where they are best. */
export function playWell(start: Start): {
  readonly choices: readonly (number | "new")[];
  readonly board: Board;
} {
  const board = new Board(start);
  const choices: (number | "new")[] = [];
  for (let i = 0; i < 100; i++) {
    const facet = board.active;
    if (!facet) break;
    const corners = board.positions(facet);
    const ideal = board.idealOf(facet);
    const tried = [...board.nodesFor(facet, 8), "new" as const].flatMap((choice) => {
      const at = choice === "new" ? ideal : (board.nodes[choice] ?? ideal);
      const isPossible = board.judge(facet, choice === "new" ? ideal : choice) === null;
      // A node that is there already leaves less to fill.
      return isPossible
        ? [{ choice, worth: smallestAngleOf([...corners, at]) - (choice === "new" ? 12 : 0) }]
        : [];
    });
    const [best] = tried.toSorted((a, b) => b.worth - a.worth);
    if (!best) break;
    board.choose(best.choice === "new" ? ideal : best.choice);
    choices.push(best.choice);
  }
  return { choices, board };
}
