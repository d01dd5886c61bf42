import { useMemo, type KeyboardEvent, type PointerEvent } from "react";
import type { Trace } from "tetrafront/trace";
import { firstState, frontSizeAt, phaseAt, phasesOf, type Phase } from "../../player/phases";
import { jump } from "../../player/player";
import { playerStrings } from "../../strings/player";
import styles from "./player.module.css";
import { useFrontPlayer, usePlayer, useToldStep, useTrace } from "./use-player";

/** Number of points of the chart at most: more cannot be seen. */
const maxPoints = 500;
/** Units of the drawing; it is stretched to the width of the panel. */
const width = 1000;
const height = 100;

/** The size of the fronts by step, phase after phase, and a slider over it. */
export function ScrubBar() {
  const player = useFrontPlayer();
  const trace = useTrace();
  const step = usePlayer((state) => state.step);
  const loop = usePlayer((state) => state.loop);
  const outline = useMemo(() => outlineOf(trace), [trace]);
  const { stepCount } = trace;
  const first = firstState(trace);
  const states = stepCount - first;
  const share = (steps: number): string => `${states === 0 ? 0 : (100 * steps) / states}%`;
  const backOf = (state: number): string => `${states === 0 ? -100 : (100 * (state - stepCount)) / states}%`;
  const told = useToldStep();
  const { phase, from, to } = phaseAt(trace, told);

  const scrub = (event: PointerEvent<HTMLDivElement>): void => {
    if ((event.buttons & 1) === 0) return;
    const { left, width: pixels } = event.currentTarget.getBoundingClientRect();
    player.scrub(first + (states * (event.clientX - left)) / pixels);
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
      aria-label={playerStrings.scrub}
      aria-valuemin={first}
      aria-valuemax={stepCount}
      aria-valuenow={told}
      aria-valuetext={playerStrings.scrubText(phase, told - from, to - from, frontSizeAt(trace, told))}
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
      {trace.surface && <Phases trace={trace} current={phase} />}
      {loop && (
        <span
          className={styles["loop"]}
          style={{ left: share(loop.from - first), right: share(stepCount - loop.to) }}
        />
      )}
      <span className={styles["track"]} style={{ transform: `translateX(${backOf(step)})` }}>
        <span className={styles["handle"]} />
      </span>
    </div>
  );
}

/**
 * The names of the phases, each where its phase begins or as near to it as the names before it allow, and a border at each
 * beginning. The value of the slider says the same to screen readers.
 */
function Phases({ trace, current }: { readonly trace: Trace; readonly current: Phase }) {
  const first = firstState(trace);
  const states = Math.max(1, trace.stepCount - first);
  const phases = phasesOf(trace);
  return (
    <>
      {phases.map(({ phase, from }) => (
        <span
          key={phase}
          className={styles["border"]}
          style={{ left: `${(100 * (from - first)) / states}%` }}
        />
      ))}
      <span className={styles["phases"]}>
        {phases.map(({ phase, from, to }) => (
          <span
            key={phase}
            style={{ flexGrow: to - from + 1 }}
            data-current={phase === current || undefined}
            title={playerStrings.phaseSteps(phase, to - from)}
          >
            {playerStrings.phases[phase]}
          </span>
        ))}
      </span>
    </>
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

/** Returns the area under the largest sizes of the fronts in equal parts of the steps. */
function outlineOf(trace: Trace): string {
  const first = firstState(trace);
  const states = trace.stepCount - first + 1;
  const points = Math.min(maxPoints, states);
  const sizes = Array.from({ length: points }, (_, i) => {
    const begin = first + Math.floor((i * states) / points);
    const end = Math.max(begin + 1, first + Math.floor(((i + 1) * states) / points));
    let largest = 0;
    for (let state = begin; state < end; state++) largest = Math.max(largest, frontSizeAt(trace, state));
    return largest;
  });
  const largest = Math.max(1, ...sizes);
  const path = sizes.map((size, i) => {
    const x = points === 1 ? 0 : (width * i) / (points - 1);
    return `L${x.toFixed(1)} ${(height * (1 - size / largest)).toFixed(1)}`;
  });
  return `M0 ${height}${path.join("")}L${width} ${height}Z`;
}
