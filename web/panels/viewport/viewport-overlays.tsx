import { Button, Kbd, Switch, Text } from "@mantine/core";
import { IconArrowsExchange, IconPlugConnectedX } from "@tabler/icons-react";
import type { MeshStatus } from "tetrafront";
import { useStore } from "zustand";
import { runNamed } from "../../commands/registry";
import { cancelledText } from "../../session/run-log";
import { strings } from "../../strings";
import { IconButton } from "../../ui/icon-button";
import { useApp, useProblems, useRun, useStale, useView } from "../shared/app-context";
import { useIsMeshed } from "../shared/problem-severity";
import { CutAxisControl, CutSlider } from "./cut-controls";
import type { Trouble } from "./use-viewer";
import styles from "./viewport-overlays.module.css";

/** The cut: on or off, axis, position and side. */
export function CutBar() {
  const app = useApp();
  const cut = useView((state) => state.cut);
  return (
    <div
      className={styles["cutBar"]}
      role="group"
      aria-label={strings.display.cut}
      data-presented
      data-covers-labels
    >
      <Switch
        size="xs"
        label={strings.display.cut}
        checked={cut.enabled}
        data-testid="cut-toggle"
        onChange={(event) => app.view.setCut({ enabled: event.currentTarget.checked })}
      />
      {cut.enabled && (
        <>
          <CutAxisControl />
          <CutSlider />
          <IconButton
            label={strings.display.flip}
            size={24}
            aria-pressed={cut.flipped}
            data-testid="cut-flip"
            onClick={() => app.view.setCut({ flipped: !cut.flipped })}
          >
            <IconArrowsExchange size={15} aria-hidden />
          </IconButton>
        </>
      )}
    </div>
  );
}

function badgeTexts(
  failure: string | null,
  stale: boolean,
  status: MeshStatus | undefined,
  cancelled: string | null,
): readonly [title: string, hint: string] {
  const { viewport } = strings;
  if (failure !== null) return [strings.messages.engineFailed, failure];
  if (stale) return [viewport.stale, viewport.staleHint];
  if (status === "stalled") return [viewport.incomplete, viewport.incompleteStalled];
  if (cancelled !== null) return [cancelled, viewport.incompleteCancelled];
  return [viewport.incomplete, viewport.incompleteUnverified];
}

/** A notice that the mesh is out of date or incomplete, with a button that meshes again. */
export function MeshBadge() {
  const app = useApp();
  const stale = useStale();
  const busy = useRun((state) => state.busy);
  const failure = useRun((state) => state.failure);
  const status = useRun((state) => state.mesh?.report.status);
  const cancelled = useRun(cancelledText);
  const isToolActive = useView(({ tool }) => tool !== "select");
  const isReplaying = useStore(app.replay.state, ({ isShown, isRecording }) => isShown || isRecording);
  if (busy) return null;
  // A replay is drawn in place of the mesh, and a link to one has stopped the run.
  const incomplete = !isReplaying && (status === "stalled" || status === "cancelled");
  if (!stale && !incomplete && failure === null) return null;
  const [title, hint] = badgeTexts(failure, stale, status, cancelled);
  return (
    <div
      className={styles["badge"]}
      data-testid="mesh-badge"
      data-lets-through={isToolActive || undefined}
      role="status"
    >
      <span>
        <b>{title}</b> <span className={styles["wide"]}>{hint}</span>
      </span>
      <Button
        size="compact-xs"
        variant="default"
        {...(isToolActive && { title: hint })}
        onClick={() => runNamed(app, "generate")}
      >
        {strings.viewport.update}
      </Button>
    </div>
  );
}

/** What the view does not show at a glance: hidden entities, and open edges while the model is drawn. */
export function CornerNotes() {
  return (
    <div className={styles["notes"]}>
      <HiddenEntities />
      <OpenEdges />
    </div>
  );
}

/** The number of hidden entities. A click shows them. */
function HiddenEntities() {
  const app = useApp();
  const count = useView(({ hidden }) => hidden.size);
  if (count === 0) return null;
  return (
    <button
      type="button"
      className={styles["note"]}
      data-testid="show-hidden"
      onClick={() => runNamed(app, "show-all")}
    >
      {strings.viewport.showHidden(count)}
    </button>
  );
}

/** The number of open edges. A click lists them. */
function OpenEdges() {
  const app = useApp();
  const isMeshed = useIsMeshed();
  const count = useProblems(({ problems }) => problems.filter(({ code }) => code === "open-edge").length);
  if (isMeshed || count === 0) return null;
  return (
    <button
      type="button"
      className={styles["note"]}
      data-testid="open-edges"
      onClick={() => runNamed(app, "problems")}
    >
      {strings.viewport.openEdges(count)}
    </button>
  );
}

/** The mouse actions of the view. */
export function MouseHint() {
  return (
    <div className={styles["hint"]} data-presented>
      {strings.viewport.hints.map(([key, effect]) => (
        <span key={key}>
          <Kbd size="xs">{key}</Kbd> {effect}
        </span>
      ))}
    </div>
  );
}

/** Shown in place of the view if it cannot be drawn. */
export function ViewNotice({ trouble }: { readonly trouble: Trouble }) {
  const lost = trouble === "context-lost";
  return (
    <div className={styles["notice"]} role="alert">
      <IconPlugConnectedX size={28} aria-hidden />
      <Text fw={600}>{lost ? strings.viewport.contextLost : strings.viewport.noWebgl}</Text>
      <Text size="sm" c="dimmed">
        {lost ? strings.viewport.contextLostHint : strings.viewport.noWebglHint}
      </Text>
    </div>
  );
}
