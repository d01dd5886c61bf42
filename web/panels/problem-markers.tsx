import { IconAlertTriangleFilled } from "@tabler/icons-react";
import { useLayoutEffect, useRef } from "react";
import { showProblem } from "../commands/selection-actions";
import type { Viewer } from "../viewer/viewer";
import { useApp, useProblems } from "./app-context";

/** More markers than this would hide the model. */
const maxMarkers = 30;

/** A sign in the view at the place of each problem. Follows the camera without React. */
export function ProblemMarkers({ viewer }: { readonly viewer: Viewer }) {
  const app = useApp();
  const problems = useProblems((state) => state.problems);
  const placed = problems.filter(({ place }) => place !== null).slice(0, maxMarkers);
  const box = useRef<HTMLDivElement>(null);
  useLayoutEffect(() => {
    const follow = (): void => {
      placed.forEach(({ place }, index) => {
        const marker = box.current?.children[index];
        if (!(marker instanceof HTMLElement) || !place) return;
        const at = viewer.toScreen(place);
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
          className="tf-marker"
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
