import type { App } from "../app/app";
import { placedVolume, repairGroups } from "../document/body-repair";
import { bodyLabel } from "../document/entities";
import { hasSizes, proposedSize } from "../document/operations/sizes";
import { setMeshing } from "../document/size-edits";
import { type BodiesState, canBeFilled, isFillable } from "../session/bodies";
import { hideMeshNotices, hideNotice, showNotice } from "../session/shell";
import type { RunPreparation } from "../session/run";
import type { RunNote } from "../session/run-log";
import type { Improvement } from "../session/shown-mesh";
import { inputMode } from "../tools/input-mode";
import { untilState } from "../session/until-state";
import { improvementText, strings } from "../strings";
import { formatShort } from "../strings/format";
import { showFailure, showMessage } from "./messages";
import { joinTouchingBodies, repairBody } from "./surface-actions";

/**
 * Meshes the project, with what an open operation makes, and shows the mesh even if other triangles of a body were shown before. Bodies that a proposed repair
 * makes valid are repaired first, and bodies that touch are joined, each as a step of undo.
 */
export async function generateMesh(app: App): Promise<void> {
  // What an open operation shows is meshed; one that gives nothing is closed.
  if (!app.operations.accept()) app.operations.cancel();
  app.view.setLayer("mesh", true);
  hideMeshNotices(app.shell);
  const hasBodies = app.bodies.state.getState().byId.size > 0;
  if (!hasBodies) proposeSize(app);
  const before = app.run.state.getState().outcome;
  const { left } = app.documents;
  let notes: readonly RunNote[] = [];
  const prepare: RunPreparation = async (control) => (notes = await validBodies(app, control));
  await app.run.generate("user", hasBodies ? prepare : undefined);
  const { outcome } = app.run.state.getState();
  if (!left.aborted && outcome !== before && outcome?.result.report.status === "done") {
    showAsMeshed(app);
    showPrepared(app, notes);
  }
}

/** Says what was done to bodies before they were meshed. Warnings are among the problems. */
function showPrepared({ shell }: App, notes: readonly RunNote[]): void {
  const made = notes
    .filter(({ level }) => level === "information")
    .map(({ text }) => text.replace(/\.$/, ""));
  if (made.length === 0) return;
  showNotice(shell, {
    key: "prepared",
    tone: "information",
    text: `${made.join(". ")}.`,
    action: {
      label: strings.notices.showLog,
      run: () => shell.setState({ bottomTab: "log", drawer: "bottom" }),
    },
  });
}

/**
 * Lets what would cover or colour the mesh that was just made give way: target sizes, and the selection, unless the user is
 * typing into a field of it.
 */
function showAsMeshed({ view }: App): void {
  view.setSizes({ enabled: false });
  if (!isTyping()) view.clear();
}

const isTyping = (): boolean =>
  typeof document !== "undefined" && inputMode(document.activeElement) === "field";

/** Repairs and joins bodies for a run. Rejects if it is aborted. */
async function validBodies(
  app: App,
  { signal, onPart }: Parameters<RunPreparation>[0],
): Promise<readonly RunNote[]> {
  const inspect = async (): Promise<void> => {
    onPart(parts.inspect);
    await app.bodies.settled(signal);
  };
  await app.outdatedSolids.settled(signal);
  await inspect();
  onPart(parts.repair);
  const notes = await repairBodies(app, signal);
  // Only bodies that are known to be valid are joined.
  await inspect();
  onPart(parts.join);
  await joinTouchingBodies(app, signal, (note) => notes.push(note)).catch((error: unknown) => {
    signal.throwIfAborted();
    showFailure(app, parts.join, error);
  });
  await app.documents.afterGesture(signal);
  await app.bodies.previewed(signal, (fraction) => onPart(parts.preview, fraction));
  signal.throwIfAborted();
  proposeSize(app);
  return notes;
}

const parts = strings.bodies.preparing;

/** Applies the proposed repairs that make bodies valid. Returns what they did. */
async function repairBodies(app: App, signal: AbortSignal): Promise<RunNote[]> {
  const notes: RunNote[] = [];
  for (const id of repairableBodies(app)) {
    signal.throwIfAborted();
    await comparisonOfRepairs(app, id, signal);
    signal.throwIfAborted();
    notes.push(...repairNotes(app, id).map((text) => ({ level: "information", text }) as const));
    await repairBody(app, id);
  }
  return notes;
}

/** Returns what the proposed repair of a body will do, for the log. */
function repairNotes({ bodies }: App, id: number): string[] {
  const { body, repair } = bodies.state.getState().byId.get(id) ?? {};
  if (!body || !repair) return [];
  const changes = repairGroups(repair.changes).map(([kind, { length }]) =>
    strings.bodies.repair.made[kind](length),
  );
  const notes = changes.length > 0 ? [strings.bodies.repair.log(bodyLabel(body), changes)] : [];
  const { shared } = repair;
  const volume = formatShort(placedVolume(shared, body));
  return shared > 0 ? [...notes, strings.bodies.repair.shared(volume)] : notes;
}

/** Gives a drawn model that lacks nothing else a uniform size that fits it, as a step of undo. */
function proposeSize({ documents, problems }: App): void {
  const errors = problems.state.getState().problems.filter(({ severity }) => severity === "error");
  const size = proposedSize(documents.project.points);
  const isComplete = errors.length > 0 && errors.every(({ code }) => code === "empty-background-grid");
  if (isComplete && size !== undefined && !hasSizes(documents.project))
    documents.edit(setMeshing("size", size));
}

/** Returns the bodies that cannot be filled before, but after the proposed repair. */
function repairableBodies({ bodies }: App): number[] {
  const { byId } = bodies.state.getState();
  return [...byId.values()]
    .filter((state) => !isFillable(state) && canBeFilled(state))
    .map(({ body }) => body.id);
}

/**
 * Resolves when it is known which of two repairs of a body is the better one, or that the user does not wait for it. Rejects if
 * it is aborted.
 */
async function comparisonOfRepairs({ bodies, shell }: App, id: number, signal: AbortSignal): Promise<void> {
  const isCompared = ({ byId }: BodiesState): boolean => (byId.get(id)?.comparing ?? null) === null;
  if (isCompared(bodies.state.getState())) return;
  const key = "repair";
  showNotice(shell, {
    key,
    tone: "information",
    text: strings.notices.comparingRepairs,
    action: { label: strings.notices.repairNow, run: () => bodies.cancelComparison(id) },
  });
  try {
    await untilState(bodies.state, isCompared, signal);
  } finally {
    hideNotice(shell, key);
  }
}

/** Improves the elements of the shown mesh, and reports what was gained. */
export async function improveMesh(app: App): Promise<void> {
  const end = await app.run.improve();
  if (end?.kind === "failed") showMessage(app, strings.messages.notImproved, end.reasons);
  else if (end?.kind === "discarded") {
    showNotice(app.shell, {
      key: "improvement",
      tone: "information",
      text: strings.notices.improvementDiscarded,
      action: { label: strings.notices.understood, run: () => undefined },
    });
  } else if (end?.improvement) showGain(app, end.improvement);
}

function showGain(app: App, improvement: Improvement): void {
  hideMeshNotices(app.shell);
  showNotice(app.shell, {
    key: "improvement",
    tone: "information",
    text: improvementText(improvement),
    action: {
      label: strings.notices.showQuality,
      run: () => app.shell.setState({ rightTab: "quality", drawer: "right" }),
    },
  });
}
