import { useMemo } from "react";
import { positionOf } from "../../player/judge";
import { strings } from "../../strings";
import type { Viewer } from "../../viewer/viewer";
import { usePlayer } from "../player/use-player";
import { useMarkers } from "./use-markers";
import styles from "./drawing.module.css";

/** The nodes to choose from in "Be the mesher", in the view. The panel has the same choices for keys and screen readers. */
export function VolumeChoices({ viewer }: { readonly viewer: Viewer }) {
  const trace = usePlayer((state) => state.trace);
  const task = usePlayer((state) => state.task);
  const nodes = task?.question.nodes;
  const positions = useMemo(
    () => (trace && nodes ? nodes.map((node) => positionOf(trace, node)) : []),
    [trace, nodes],
  );
  const box = useMarkers(viewer, positions, true);
  return (
    <div ref={box} aria-hidden data-testid="volume-choices">
      {task &&
        task.question.nodes.map((node) => (
          <button
            key={node}
            type="button"
            tabIndex={-1}
            // The buttons of the game take the focus, these are hidden from screen readers.
            onMouseDown={(event) => event.preventDefault()}
            className={styles["choice"]}
            data-chosen={task.answer?.node === node || undefined}
            data-program={(task.answer !== null && task.question.program === node) || undefined}
            data-testid={`view-choice-${node}`}
            title={strings.player.game.node(node)}
            onClick={() => task.choose(node)}
          >
            {node}
          </button>
        ))}
    </div>
  );
}
