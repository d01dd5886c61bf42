import { useMemo } from "react";
import type { Trace } from "tetrafront/trace";
import type { Position } from "../../../document/position";
import { positionOf } from "../../player/judge";
import type { VolumeTask } from "../../player/volume-game";
import { pickText } from "../../strings/mesher-game";
import { playerStrings } from "../../strings/player";
import type { Viewer } from "../../../viewer/viewer";
import { usePlayer } from "./use-player";
import { useMarkers } from "../../../panels/viewport/use-markers";
import styles from "../../../panels/viewport/drawing.module.css";

/** The nodes to choose from in "Be the mesher", in the view. The panel has the same choices for keys and screen readers. */
export function VolumeChoices({ viewer }: { readonly viewer: Viewer }) {
  const trace = usePlayer((state) => state.trace);
  const task = usePlayer((state) => state.task);
  const choices = useMemo(() => (trace && task ? choicesOf(trace, task) : []), [trace, task]);
  const positions = useMemo(() => choices.map(({ position }) => position), [choices]);
  const box = useMarkers(viewer, positions, true);
  return (
    <div ref={box} aria-hidden data-testid="volume-choices">
      {task &&
        choices.map(({ node, isOwn, isProgram }) => (
          <button
            key={node ?? "new"}
            type="button"
            tabIndex={-1}
            // The buttons of the game take the focus, these are hidden from screen readers.
            onMouseDown={(event) => event.preventDefault()}
            className={styles["choice"]}
            data-chosen={isOwn || undefined}
            data-program={isProgram || undefined}
            data-testid={`view-choice-${node ?? "new"}`}
            title={playerStrings.game.node(node)}
            onClick={() => task.choose(node)}
          >
            {node ?? playerStrings.game.newNode}
            {(isOwn || isProgram) && <b> {pickText(isOwn, isProgram)}</b>}
          </button>
        ))}
    </div>
  );
}

interface ViewChoice {
  /** Null for a new node. */
  readonly node: number | null;
  readonly position: Position;
  /** Whose choice it is; nobody's before the verdict. */
  readonly isOwn: boolean;
  readonly isProgram: boolean;
}

/** The nodes of a question, and a new one unless this would show the ideal point. */
function choicesOf(trace: Trace, { question, answer, showsIdeal }: VolumeTask): readonly ViewChoice[] {
  const { nodes, step, program } = question;
  const accepted = step.candidates.find(({ verdict }) => verdict === "accepted");
  const made = answer && program === null ? accepted?.position : undefined;
  const all = showsIdeal ? [...nodes, null] : nodes;
  return all.map((node) => ({
    node,
    position: node === null ? (made ?? step.idealPoint) : positionOf(trace, node),
    isOwn: answer !== null && answer.node === node,
    isProgram: answer !== null && program === node,
  }));
}
