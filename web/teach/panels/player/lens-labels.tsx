import { useLayoutEffect, useMemo, useRef } from "react";
import { beatAt, isFleeting } from "../../player/film-state";
import { legendOf, lensMarks, type LensLabel } from "../../player/lens-marks";
import { lensSceneOf } from "../../player/lens-scene";
import { surfaceState } from "../../player/phases";
import { recoveryLegendOf, recoveryMarksOf } from "../../player/recovery-marks";
import { surfaceLabels } from "../../player/surface-labels";
import { playerStrings } from "../../strings/player";
import type { Viewer } from "../../../viewer/viewer";
import { usePlayer } from "./use-player";
import { placedAround, type Label } from "../../../viewer/apart";
import styles from "./lens-labels.module.css";

/** Width or height of a view, in CSS pixels, in which labels of further candidates would cover what is examined. */
const smallView = 360;

/** What the lens shows in the view, by name and number, with lines to it. The panel says the same for screen readers. */
export function LensLabels({ viewer }: { readonly viewer: Viewer }) {
  const scene = usePlayer(lensSceneOf);
  const recovered = usePlayer(recoveryMarksOf);
  const surface = useSurfaceLabels();
  const marks = useMemo(() => scene && lensMarks(scene), [scene]);
  const labels = marks?.labels ?? recovered?.labels ?? surface;
  const box = useRef<HTMLDivElement>(null);
  const lines = useRef<SVGSVGElement>(null);
  useLayoutEffect(() => {
    if (labels.length === 0) return undefined;
    const follow = (): void => {
      const view = lines.current;
      if (!view || !box.current) return;
      const area = viewer.labelArea;
      const isSmall = Math.min(area.width, area.height) < smallView;
      // All sizes are read before anything is written: otherwise the browser would lay out the page again for each label.
      const shown: (Label & { readonly marker: HTMLElement; readonly line: Element | undefined })[] = [];
      const hidden: typeof shown = [];
      [...box.current.children].forEach((marker, i) => {
        const named = labels[i];
        if (!(marker instanceof HTMLElement) || !named) return;
        const at = isSmall && named.isMinor ? null : viewer.toScreen(named.position);
        const size = { width: marker.offsetWidth, height: marker.offsetHeight };
        const label = { x: 0, y: 0, ...at, ...size, marker, line: view.children[i] };
        (at ? shown : hidden).push(label);
      });
      const places = placedAround(shown, area, [viewer.cubeArea, ...coversOf(view)]);
      for (const { marker, line } of hidden) setShown(marker, line, false);
      shown.forEach(({ x, y, marker, line }, i) => {
        const place = places[i] ?? null;
        setShown(marker, line, place !== null);
        if (!place) return;
        marker.style.transform = `translate(${place.x}px, ${place.y}px) translate(-50%, -50%)`;
        const ends = { x1: x, y1: y, x2: place.x, y2: place.y };
        for (const [name, value] of Object.entries(ends)) line?.setAttribute(name, value.toFixed(1));
      });
    };
    follow();
    return viewer.onDrawn(follow);
  }, [viewer, labels]);
  return (
    <>
      <div aria-hidden data-testid="lens-labels">
        <svg ref={lines} className={styles["lines"]}>
          {labels.map(({ kind }, i) => (
            // Labels have no identity beside their order.
            <line key={i} data-kind={kind} />
          ))}
        </svg>
        <div ref={box}>
          {labels.map(({ kind, text }, i) => (
            // As above.
            <span key={i} className={styles["label"]} data-kind={kind} data-label>
              {text}
            </span>
          ))}
        </div>
      </div>
      {marks && <MarkLegend names={legendOf(marks)} />}
      {recovered && <MarkLegend names={recoveryLegendOf(recovered)} />}
    </>
  );
}

/** Returns the legends that lie over the view, which an element fills. */
function coversOf(view: Element): readonly Label[] {
  const { left, top } = view.getBoundingClientRect();
  return [...document.querySelectorAll("[data-covers-labels]")].flatMap((cover) => {
    const { x, y, width, height } = cover.getBoundingClientRect();
    const isShown = width > 0;
    return isShown ? [{ x: x - left + width / 2, y: y - top + height / 2, width, height }] : [];
  });
}

const noLabels: readonly LensLabel[] = [];

/** The labels of the patch whose front is shown; none while it is played or scrubbed. */
function useSurfaceLabels(): readonly LensLabel[] {
  const trace = usePlayer((state) => state.trace);
  const candidate = usePlayer((state) => state.candidate);
  const step = usePlayer((state) => (isFleeting(state) ? null : state.step));
  const beat = usePlayer(beatAt);
  return useMemo(() => {
    const state = trace && step !== null ? surfaceState(trace, step) : null;
    return trace?.surface && state !== null ? surfaceLabels(trace.surface, state, candidate, beat) : noLabels;
  }, [trace, step, candidate, beat]);
}

/** A label that is not shown keeps its size. */
function setShown(marker: HTMLElement, line: Element | undefined, isShown: boolean): void {
  marker.style.visibility = isShown ? "" : "hidden";
  line?.setAttribute("visibility", isShown ? "inherit" : "hidden");
}

/** What the colours of the marks mean, by their kind. */
function MarkLegend({ names }: { readonly names: Readonly<Record<string, string>> }) {
  return (
    <ul
      className={styles["legend"]}
      aria-label={playerStrings.lens}
      data-testid="lens-legend"
      data-covers-labels
    >
      {Object.entries(names).map(([kind, name]) => (
        <li key={kind} data-kind={kind}>
          {name}
        </li>
      ))}
    </ul>
  );
}
