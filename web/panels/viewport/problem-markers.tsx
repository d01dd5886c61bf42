import { IconAlertTriangleFilled } from "@tabler/icons-react";
import type { MouseEvent } from "react";
import type { App } from "../../app/app";
import { showProblem } from "../../commands/selection-actions";
import type { Viewer } from "../../viewer/viewer";
import { useApp, useProblems, useView } from "../shared/app-context";
import { isCalm, useShownSeverity } from "../shared/problem-severity";
import { useMarkers } from "./use-markers";
import styles from "./problem-markers.module.css";

/** Largest number of markers; more would hide the model. */
const maxMarkers = 30;

/** Markers in the view at the positions of the problems. They follow the camera without rendering again. */
export function ProblemMarkers({ viewer }: { readonly viewer: Viewer }) {
  const app = useApp();
  const problems = useProblems((state) => state.problems);
  const severityOf = useShownSeverity();
  const isToolActive = useView(({ tool }) => tool !== "select");
  const placed = problems
    .filter((problem) => problem.position !== null && !isCalm(severityOf(problem)))
    .slice(0, maxMarkers);
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
          data-lets-through={isToolActive || undefined}
          data-testid={`marker-${index}`}
          aria-label={problem.message}
          title={problem.message}
          onClick={(event) => {
            if (event.shiftKey) selectBelow(app, viewer, event);
            else {
              showProblem(app, problem);
              // Without panels beside the view, the inspector, which tells about the problem, is in a drawer.
              app.shell.setState({ drawer: "right" });
            }
          }}
        >
          <IconAlertTriangleFilled size={16} aria-hidden />
        </button>
      ))}
    </div>
  );
}

/** Adds what lies below a marker to the selection. */
function selectBelow(app: App, viewer: Viewer, { currentTarget, clientX, clientY }: MouseEvent): void {
  const box = currentTarget.closest("[data-testid=viewport]")?.getBoundingClientRect();
  const target = box && viewer.hit({ x: clientX - box.left, y: clientY - box.top })?.target;
  if (target && target.kind !== "element") app.view.select(target, "add");
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
