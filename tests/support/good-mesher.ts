/** Plays "Be the mesher" well: as its hints say. */
import { Board, type Start } from "../../web/teach/article/figures/mesher/board";
import { carefulChoice } from "../../web/teach/article/figures/mesher/outlook";

/** Returns the choices in their order, and the board as they leave it. New nodes are made where they are proposed. */
export function playWell(start: Start): {
  readonly choices: readonly (number | "new")[];
  readonly board: Board;
} {
  const board = new Board(start);
  const choices: (number | "new")[] = [];
  for (let i = 0; i < 100; i++) {
    const facet = board.active;
    if (!facet) break;
    const newNode = board.proposalFor(facet);
    const choice = carefulChoice(board, board.nodesFor(facet, 8), newNode);
    if (choice === null) break;
    board.choose(choice === "new" ? newNode : choice);
    choices.push(choice);
  }
  return { choices, board };
}
