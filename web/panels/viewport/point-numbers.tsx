import type { Viewer } from "../../viewer/viewer";
import { useProject, useView } from "../shared/app-context";
import { numberedPoints } from "./number-label";
import { useMarkers } from "./use-markers";
import styles from "./drawing.module.css";

/** The ids of the points that are shown, beside them. */
export function PointNumbers({ viewer }: { readonly viewer: Viewer }) {
  const isOn = useView((state) => state.numbers && state.layers.points);
  const hidden = useView((state) => state.hidden);
  const { points } = useProject();
  const shown = isOn ? numberedPoints(points, hidden) : [];
  const box = useMarkers(
    viewer,
    shown.map(({ position }) => position),
  );
  return (
    <div ref={box} aria-hidden data-testid="point-numbers">
      {shown.map(({ id }) => (
        <span key={id} className={styles["number"]}>
          {id}
        </span>
      ))}
    </div>
  );
}
