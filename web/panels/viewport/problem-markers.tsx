import { IconAlertTriangleFilled } from "@tabler/icons-react";
import { showProblem } from "../../commands/selection-actions";
import type { Viewer } from "../../viewer/viewer";
import { useApp, useProblems, useView } from "../shared/app-context";
import { useMarkers } from "./use-markers";
import styles from "./problem-markers.module.css";

/** Largest number of markers; more would hide the model. */
const maxMarkers = 30;

/** Markers in the view at the positions of the problems. They follow the camera without rendering again. */
export function ProblemMarkers({ viewer }: { readonly viewer: Viewer }) {
  const app = useApp();
  const problems = useProblems((state) => state.problems);
  const placed = problems.filter(({ position }) => position !== null).slice(0, maxMarkers);
  const box = useMarkers(
    viewer,
    placed.map(({ position }) => position),
  );
  return (
    <div ref={box}>
      {placed.map((problem, index) => (
        <button
          key={problem.key}
          type="button"
          className={styles["marker"]}
          data-severity={problem.severity}
          data-testid={`marker-${index}`}
          aria-label={problem.message}
          title={problem.message}
          onClick={() => showProblem(app, problem)}
        >
          <IconAlertTriangleFilled size={16} aria-hidden />
        </button>
      ))}
    </div>
  );
}

/** A ring around the position that was picked in a list. */
export function PositionMarker({ viewer }: { readonly viewer: Viewer }) {
  const position = useView((state) => state.markedPosition);
  const box = useMarkers(viewer, [position]);
  return (
    <div ref={box} aria-hidden>
      {position && <span className={styles["ring"]} data-testid="position-marker" />}
    </div>
  );
}
