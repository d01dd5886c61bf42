import { Progress, VisuallyHidden } from "@mantine/core";
import { IconX } from "@tabler/icons-react";
import type { MeshReport, CallProgress } from "tetrafront";
import { useStore } from "zustand";
import { useMemo } from "react";
import { runNamed } from "../../commands/registry";
import { unitOf } from "../../document/length-units";
import { roundTime } from "tetrafront/internal";
import { savedState } from "../../session/document-store";
import type { RunState } from "../../session/run-state";
import { cancelledText } from "../../session/run-log";
import { IconButton } from "../../ui/icon-button";
import { TextButton } from "../../ui/text-button";
import { formatAngle, formatCount, formatPosition, formatSeconds, formatShort } from "../../strings/format";
import { measuredIn, phaseNames, strings } from "../../strings";
import {
  useApp,
  useDocument,
  useProject,
  useQualitySpace,
  useRun,
  useShell,
  useStale,
} from "../shared/app-context";
import { roomyBounds } from "../../viewer/bounds";
import { groundSpacing } from "../../viewer/layers/ground-layer";
import { useThrottled } from "../shared/use-throttled";
import { PresenterButtons } from "./presenter-buttons";
import styles from "./status-bar.module.css";

/** Time between two announcements to screen readers, in milliseconds. */
const announceEveryMs = 5000;

function outcomeText(run: RunState, stale: boolean, hasErrors: boolean, front: string | null): string {
  if (run.failure !== null) return strings.messages.engineFailed;
  // Once the errors are mended, the model waits for another run.
  const isInvalid = run.outcome?.result.report.status === "invalid-input" && hasErrors;
  if (isInvalid && stale) return strings.status.invalid;
  if (!run.mesh) return isInvalid ? strings.status.invalid : (front ?? strings.status.ready);
  if (stale) return strings.status.stale;
  switch (run.mesh.report.status) {
    case "done":
      return run.origin ? strings.status.opened(run.origin.fileName) : strings.status.done;
    case "stalled":
      return strings.status.stalled;
    case "cancelled":
      return cancelledText(run) ?? strings.status.cancelled;
    case "invalid-input":
      return strings.status.invalid;
  }
}

function phaseText(task: RunState["task"], progress: CallProgress): string {
  if (task === "improve") return strings.status.improving;
  const { phase, exactFillFraction: exactFill, meshNumber = 1 } = progress;
  const name = exactFill > 0 ? strings.status.filling : phaseNames[phase];
  return meshNumber > 1 ? strings.status.ofMesh(name, meshNumber) : name;
}

/** The progress of a run, or the state of the mesh; and the statistics of the shown mesh. */
export function StatusBar() {
  const busy = useRun((state) => state.busy);
  const reading = useShell((state) => state.reading);
  return (
    <footer className={styles["bar"]} data-testid="status" data-presented>
      {reading ? <Reading {...reading} /> : busy ? <RunProgress /> : <Outcome />}
      <PointerPlace />
      <PresenterButtons />
      <MeshNumbers />
    </footer>
  );
}

/** The position under the pointer, and the distance between the lines of the grid. */
function PointerPlace() {
  const app = useApp();
  const project = useProject();
  const busy = useRun((state) => state.busy);
  const cursor = useStore(app.drawing.state, (state) => state.cursor);
  const step = useStore(app.drawing.state, (state) => state.gridStep);
  const stated = unitOf(project.units);
  const unit = stated ? strings.units[stated] : null;
  const ground = useMemo(() => groundSpacing(roomyBounds(project).radius), [project]);
  return (
    <>
      {/* On phones, the progress of a run needs the room. */}
      <span className={busy ? styles["wide"] : undefined} data-testid="grid-unit">
        {strings.drawing.gridUnit(formatShort(step ?? ground), unit)}
      </span>
      <UnitButton unit={unit} />
      {cursor && (
        <span className={`${styles["wide"]} ${styles["place"]}`} aria-hidden>
          {formatPosition(cursor)}
        </span>
      )}
    </>
  );
}

/** The length unit of the project; opens its choice. */
function UnitButton({ unit }: { readonly unit: string | null }) {
  const app = useApp();
  return (
    <TextButton
      title={strings.units.choose}
      aria-label={`${strings.units.stated(unit)}. ${strings.units.choose}`}
      data-testid="length-unit"
      onClick={() => {
        app.view.clear();
        app.shell.setState({ rightTab: "inspector", drawer: "right", editedSetting: "units" });
      }}
    >
      {strings.units.stated(unit)}
    </TextButton>
  );
}

/** The surface file that is being read. */
function Reading({ fileName, abort }: { readonly fileName: string; readonly abort: AbortController }) {
  return (
    <>
      <span role="status" data-testid="reading">
        {strings.bodies.opening(fileName)}
      </span>
      <IconButton label={strings.bodies.cancelOpening} size={24} onClick={() => abort.abort()}>
        <IconX size={14} aria-hidden />
      </IconButton>
    </>
  );
}

function Outcome() {
  const run = useRun((state) => state);
  const stale = useStale();
  const app = useApp();
  const hasErrors = useStore(app.problems.state, ({ problems }) =>
    problems.some(({ severity }) => severity === "error"),
  );
  const front = useStore(app.replay.state, ({ text }) => text);
  return <span role="status">{outcomeText(run, stale, hasErrors, front)}</span>;
}

function RunProgress() {
  const app = useApp();
  const progress = useRun((state) => state.progress);
  const cancelling = useRun((state) => state.cancelling);
  const preparedShare = useRun((state) => state.preparedShare);
  const percent = Math.round((progress?.fraction ?? preparedShare) * 100);
  const task = useRun((state) => state.task);
  const preparing = useRun((state) => state.preparing);
  const phase = progress ? phaseText(task, progress) : strings.header.busy[task];
  const secondsLeft = useRun((state) => state.secondsLeft);
  const part = preparing !== null && preparedShare === 0 ? preparing : `${preparing ?? phase} ${percent} %`;
  const text = cancelling ? strings.status.cancelling[task] : part;
  const announced = useThrottled(text, announceEveryMs);
  return (
    <>
      <Progress
        className={styles["progress"]}
        value={percent}
        size="sm"
        aria-label={strings.status.progress[task]}
        // Without graphics hardware, animating the bar costs as much as the meshing.
        transitionDuration={0}
      />
      <span aria-hidden>{text}</span>
      {secondsLeft !== null && !cancelling && (
        <span data-testid="time-left">{strings.status.timeLeft(roundTime(secondsLeft))}</span>
      )}
      {progress && progress.frontFaces > 0 && progress.exactFillFraction === 0 && (
        <span className={styles["wide"]} aria-hidden>
          {strings.status.front(formatCount(progress.frontFaces))}
        </span>
      )}
      <VisuallyHidden role="status">{announced}</VisuallyHidden>
      <IconButton
        label={strings.status.cancel[task]}
        size={24}
        data-testid="cancel"
        disabled={cancelling}
        onClick={() => runNamed(app, "cancel")}
      >
        <IconX size={14} aria-hidden />
      </IconButton>
    </>
  );
}

function MeshNumbers() {
  const mesh = useRun((state) => state.mesh);
  const origin = useRun((state) => state.origin);
  const progress = useRun((state) => (state.busy && state.task === "mesh" ? state.progress : null));
  const stale = useStale();
  const savedText = useDocument((state) => strings.status[savedState(state)]);
  const tetrahedra = progress?.tetrahedra ?? mesh?.report.tetrahedra;
  // Without elements, the statistics of the report are zeros without a meaning.
  const report = mesh && mesh.report.tetrahedra > 0 ? mesh.report : null;
  // The worst angle of an unfinished mesh says nothing about the one that was asked for.
  const isFinished = report?.status !== "cancelled";
  // The statistics of the old mesh keep their space in the bar while a run replaces the mesh.
  const hasProgress = progress !== null || undefined;
  const points = progress?.nodes ?? report?.nodes;
  return (
    <div className={styles["numbers"]} data-stale={(stale && !progress) || undefined}>
      {points !== undefined && (
        <span className={styles["wide"]} data-testid="count-points">
          {strings.status.nodes(formatCount(points))}
        </span>
      )}
      <ExpectedCount />
      {tetrahedra !== undefined && (
        <span data-testid="count-tetrahedra">{strings.status.tetrahedra(formatCount(tetrahedra))}</span>
      )}
      {report && isFinished && (
        <>
          <span className={styles["wide"]} data-testid="min-dihedral" data-hidden={hasProgress}>
            <MinDihedral report={report} />
          </span>
          <span className={styles["wide"]} data-testid="seconds" data-hidden={hasProgress}>
            {origin ? "" : formatSeconds(report.seconds.total)}
          </span>
        </>
      )}
      <span className={styles["wide"]} data-testid="saved-state">
        {savedText}
      </span>
    </div>
  );
}

/** How many tetrahedra a mesh of the present model would have, until there is one. */
function ExpectedCount() {
  const app = useApp();
  const expected = useStore(app.sizes.state, (state) => state.expected);
  const without = useStore(app.sizes.state, (state) => state.without);
  const hasMesh = useRun((state) => state.busy || state.mesh !== null);
  const stale = useStale();
  if (expected === null || (hasMesh && !stale)) return null;
  return (
    <span data-testid="count-expected">
      {strings.background.about(formatCount(Number(expected.toPrecision(2))), without)}
    </span>
  );
}

function MinDihedral({ report }: { readonly report: MeshReport }) {
  const space = useQualitySpace();
  const { min } = space === "metric" ? report.quality.shapes.dihedral : report.dihedral;
  return measuredIn(strings.status.minDihedral(formatAngle(min)), space);
}
