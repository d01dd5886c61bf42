import { useMemo, type KeyboardEvent, type PointerEvent } from "react";
import type { Trace } from "tetrafront";
import { jump } from "../../player/player";
import { strings } from "../../strings";
import { useApp } from "../shared/app-context";
import styles from "./player.module.css";
import { usePlayer, useTrace } from "./use-player";

/** Number of points of the chart at most: more cannot be seen. */
const maxPoints = 500;
/** Units of the drawing; it is stretched to the width of the panel. */
const width = 1000;
const height = 100;

/** The size of the front by step, and a slider over it. */
export function ScrubBar() {
  const { player } = useApp();
  const trace = useTrace();
  const step = usePlayer((state) => state.step);
  const loop = usePlayer((state) => state.loop);
  const outline = useMemo(() => outlineOf(trace), [trace]);
  const { stepCount } = trace;
  const share = (at: number): string => `${stepCount === 0 ? 0 : (100 * at) / stepCount}%`;

  const scrub = (event: PointerEvent<HTMLDivElement>): void => {
    if ((event.buttons & 1) === 0) return;
    const { left, width: pixels } = event.currentTarget.getBoundingClientRect();
    player.pause();
    player.seek((stepCount * (event.clientX - left)) / pixels);
  };
  const onKeyDown = (event: KeyboardEvent): void => {
    const steps = stepsOfKey(event.key);
    if (steps === undefined) return;
    event.preventDefault();
    event.stopPropagation();
    player.move(steps);
  };
  return (
    <div
      className={styles["scrub"]}
      role="slider"
      tabIndex={0}
      aria-label={strings.player.scrub}
      aria-valuemin={0}
      aria-valuemax={stepCount}
      aria-valuenow={step}
      aria-valuetext={strings.player.scrubText(step, stepCount, trace.steps.frontSizes[step] ?? 0)}
      data-testid="player-scrub"
      onKeyDown={onKeyDown}
      onPointerDown={(event) => {
        event.currentTarget.setPointerCapture(event.pointerId);
        scrub(event);
      }}
      onPointerMove={scrub}
    >
      <svg viewBox={`0 0 ${width} ${height}`} preserveAspectRatio="none" aria-hidden>
        <path d={outline} />
      </svg>
      {loop && (
        <span
          className={styles["loop"]}
          style={{ left: share(loop.from), right: share(stepCount - loop.to) }}
        />
      )}
      <span className={styles["handle"]} style={{ left: share(step) }} />
    </div>
  );
}

/** Returns the steps to move by; undefined for keys that a slider does not use. */
function stepsOfKey(key: string): number | undefined {
  switch (key) {
    case "ArrowRight":
    case "ArrowUp":
      return 1;
    case "ArrowLeft":
    case "ArrowDown":
      return -1;
    case "PageUp":
      return jump;
    case "PageDown":
      return -jump;
    case "Home":
      return -Infinity;
    case "End":
      return Infinity;
    default:
      return undefined;
  }
}

/** Returns the area under the largest sizes of the front in equal parts of the steps. */
function outlineOf({ stepCount, steps: { frontSizes } }: Trace): string {
  const points = Math.min(maxPoints, stepCount + 1);
  const largest = Math.max(
    1,
    frontSizes.reduce((most, size) => Math.max(most, size), 0),
  );
  let path = `M0 ${height}`;
  for (let i = 0; i < points; i++) {
    const begin = Math.floor((i * frontSizes.length) / points);
    const end = Math.max(begin + 1, Math.floor(((i + 1) * frontSizes.length) / points));
    const size = frontSizes.subarray(begin, end).reduce((most, next) => Math.max(most, next), 0);
    const x = points === 1 ? 0 : (width * i) / (points - 1);
    path += `L${x.toFixed(1)} ${(height * (1 - size / largest)).toFixed(1)}`;
  }
  return `${path}L${width} ${height}Z`;
}
