import { IconAlertTriangleFilled } from "@tabler/icons-react";
import { useLayoutEffect, useRef } from "react";
import { showProblem } from "../../commands/selection-actions";
import type { Viewer } from "../../viewer/viewer";
import { useApp, useProblems } from "../shared/app-context";
import styles from "./problem-markers.module.css";

/** Largest number of markers; more would hide the model. */
const maxMarkers = 30;

/** Markers in the view at the positions of the problems. They follow the camera without rendering again. */
export function ProblemMarkers({ viewer }: { readonly viewer: Viewer }) {
  const app = useApp();
  const problems = useProblems((state) => state.problems);
  const placed = problems.filter(({ position }) => position !== null).slice(0, maxMarkers);
  const box = useRef<HTMLDivElement>(null);
  useLayoutEffect(() => {
    const follow = (): void => {
      placed.forEach(({ position }, index) => {
        const marker = box.current?.children[index];
        if (!(marker instanceof HTMLElement) || !position) return;
        const at = viewer.toScreen(position);
        marker.style.display = at ? "" : "none";
        if (at) marker.style.transform = `translate(${at.x}px, ${at.y}px) translate(-50%, -50%)`;
      });
    };
    follow();
    return viewer.onDrawn(follow);
  });
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
