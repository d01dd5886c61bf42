import { SegmentedControl } from "@mantine/core";
import { useMemo, useState } from "react";
import type { EdgeStep, PlanarFront, SurfaceStep, SurfaceTrace } from "tetrafront/trace";
import { labelAt } from "../../player/entity-labels";
import { isBeforeTest } from "../../player/beats";
import { beatAt, isUnfinished } from "../../player/film-state";
import { ellipseOf, planePaths, windowAround, windowOf, type PlaneWindow } from "../../player/plane-drawing";
import { candidateInBeat, supposedCandidate } from "../../player/planar-lens";
import { endsOf, planeOf, targetLength } from "../../player/planar-judge";
import { surfaceState } from "../../player/phases";
import { playerStrings } from "../../strings/player";
import { PlaneCorners } from "./plane-corners";
import styles from "./plane-view.module.css";
import { useFrontPlayer, usePlayer } from "./use-player";

const texts = playerStrings.plane;
/** Radius of dots, as a share of the drawing. */
const dot = 0.008;

type Zoom = "patch" | "edge";

/**
 * The plane of a patch, in which its front advances; beside the view, in which the patch is in space. Empty for the moment
 * until it closes.
 */
export function PlaneView() {
  const trace = usePlayer((state) => state.trace);
  const number = usePlayer((state) => state.step);
  const state = trace && surfaceState(trace, number);
  const surface = trace?.surface;
  const index = state === null ? undefined : surface?.frontAt(state);
  if (!surface || state === null || index === undefined) return <section className={styles["pane"]} />;
  return <Plane surface={surface} index={index} state={state} />;
}

interface PlaneProps {
  readonly surface: SurfaceTrace;
  readonly index: number;
  readonly state: number;
}

function Plane({ surface, index, state }: PlaneProps) {
  const labels = usePlayer((shown) => shown.labels);
  const [zoom, setZoom] = useState<Zoom>("patch");
  const front = surface.fronts[index];
  const step = useMemo(() => surface.stepAt(state), [surface, state]);
  const whole = useMemo(() => front && windowOf(front), [front]);
  if (!front || !step || !whole) return null;
  const box = zoom === "edge" && step.kind === "edge" ? windowAround(front, step) : whole;
  return (
    <section className={styles["pane"]} aria-label={texts.label} data-testid="plane-view" data-presented>
      <header className={styles["header"]}>
        <b>{texts.title(labelAt(labels?.patches, front.patch))}</b>
        <span className={styles["choices"]}>
          <SegmentedControl
            size="xs"
            aria-label={texts.zoom}
            data-testid="plane-zoom"
            value={zoom}
            data={[
              { value: "patch", label: texts.zooms.patch },
              { value: "edge", label: texts.zooms.edge },
            ]}
            onChange={setZoom}
          />
        </span>
      </header>
      <Drawing front={front} step={step} state={state} box={box} />
      <p className={styles["hint"]}>{hintOf(front, step)}</p>
    </section>
  );
}

/** What the drawing shows. */
function hintOf({ isCurved }: PlanarFront, { kind }: SurfaceStep): string {
  const plane = isCurved ? texts.curved : texts.flat;
  return kind === "edge" ? `${plane} ${isCurved ? texts.ellipse : texts.size}` : plane;
}

interface DrawingProps {
  readonly front: PlanarFront;
  readonly step: SurfaceStep;
  readonly state: number;
  readonly box: PlaneWindow;
}

function Drawing({ front, step, state, box }: DrawingProps) {
  const candidate = usePlayer((shown) => shown.candidate);
  // With a refused candidate that is chosen, and in the beats before the last, the front as it was when it was tried.
  const isBefore = usePlayer(isUnfinished);
  const shownState = isBefore || supposedCandidate(step, candidate) ? state - 1 : state;
  const paths = useMemo(() => planePaths(front, shownState), [front, shownState]);
  const viewBox = `${box.left} ${-box.top} ${box.width} ${box.height}`;
  return (
    <svg
      className={styles["drawing"]}
      viewBox={viewBox}
      role="img"
      aria-label={texts.picture(paths.triangleCount, paths.edgeCount)}
    >
      {/* The plane's second axis points up. */}
      <g transform="scale(1 -1)">
        <path className={styles["triangles"]} d={paths.triangles} />
        <path className={styles["boundary"]} d={paths.boundary} />
        <path className={styles["front"]} d={paths.front} />
        <path className={styles["nodes"]} d={paths.nodes} />
        <PlaneCorners front={front} size={box.size} />
        {step.kind === "edge" && <Step front={front} step={step} size={box.size} />}
      </g>
    </svg>
  );
}

/** The base edge, the target size as an ellipse, the ideal point, and the candidate under the lens. */
function Step({
  front,
  step,
  size,
}: {
  readonly front: PlanarFront;
  readonly step: EdgeStep;
  readonly size: number;
}) {
  const player = useFrontPlayer();
  const beat = usePlayer(beatAt);
  const pointed = usePlayer((state) => state.pointed);
  const rank = usePlayer((state) => state.candidate);
  const isEarly = isBeforeTest(beat);
  const chosen = isEarly ? rank : candidateInBeat(step, rank, beat);
  const [hasIdeal, hasCandidates] = [beat !== "edge", beat !== "edge" && beat !== "ideal"];
  const [a, b] = step.nodes.map((node) => planeOf(front, node));
  const candidate = chosen === null ? undefined : step.candidates[chosen];
  const culprit = isEarly ? null : (candidate?.culprit ?? null);
  const ellipse = ellipseOf(step, 0.55 * targetLength(front, step));
  if (!a || !b) return null;
  return (
    <>
      {hasIdeal && (
        <ellipse
          className={styles["size"]}
          rx={ellipse.rx}
          ry={ellipse.ry}
          transform={`translate(${step.ideal.join(" ")}) rotate(${ellipse.angle})`}
        />
      )}
      {culprit !== null && <Edge front={front} edge={culprit} className={styles["culprit"]} />}
      {hasCandidates && candidate && (
        <path
          className={styles[candidate.verdict === "accepted" ? "accepted" : "refused"]}
          d={`M${a.join(" ")}L${b.join(" ")}L${candidate.plane.join(" ")}Z`}
        />
      )}
      <path className={styles["base"]} d={`M${a.join(" ")}L${b.join(" ")}`} />
      {hasIdeal && (
        <circle className={styles["ideal"]} cx={step.ideal[0]} cy={step.ideal[1]} r={dot * size} />
      )}
      {(hasCandidates ? step.candidates : []).map(({ plane: [x, y] }, i) => (
        <circle
          // Candidates have no identity beside their rank.
          key={i}
          className={styles["candidate"]}
          data-chosen={i === chosen || undefined}
          data-pointed={i === pointed || undefined}
          onPointerEnter={() => player.state.setState({ pointed: i })}
          onPointerLeave={() => player.state.setState({ pointed: null })}
          cx={x}
          cy={y}
          r={1.3 * dot * size}
          onClick={() => player.choose(i)}
        />
      ))}
    </>
  );
}

function Edge({
  front,
  edge,
  className,
}: {
  readonly front: PlanarFront;
  readonly edge: number;
  readonly className: string | undefined;
}) {
  const [a, b] = endsOf(front, edge).map((node) => planeOf(front, node));
  return a && b ? <path className={className} d={`M${a.join(" ")}L${b.join(" ")}`} /> : null;
}
