import type { App } from "../app/app";
import { placedVolume, repairGroups } from "../document/body-repair";
import { bodyLabel } from "../document/entities";
import { hasSizes, proposedSize } from "../document/operations/sizes";
import { setMeshing } from "../document/size-edits";
import { canBeFilled, isFillable } from "../session/bodies";
import { hideNotice, showNotice } from "../session/shell";
import type { Improvement } from "../session/shown-mesh";
import { improvementText, strings } from "../strings";
import { formatShort } from "../ui/format";
import { showFailure, showMessage } from "./messages";
import { joinTouchingBodies, repairBody } from "./surface-actions";

/**
 * Meshes the project, and shows the mesh even if other triangles of a body were shown before. Bodies that a proposed repair
 * makes valid are repaired first, and bodies that touch are joined, each as a step of undo.
 */
export async function generateMesh(app: App): Promise<void> {
  app.view.setLayer("mesh", true);
  const notes: string[] = [];
  for (const id of repairableBodies(app)) {
    await comparisonOfRepairs(app, id);
    notes.push(...repairNotes(app, id));
    await repairBody(app, id);
  }
  if (joining.has(app)) return;
  proposeSize(app);
  // Without bodies that could touch, the run begins at once.
  const joined = app.bodies.state.getState().byId.size < 2 ? [] : await joinedBodies(app);
  if (joined) await app.run.generate("user", [...notes, ...joined]);
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

/** The apps that join bodies: a second command must not begin meanwhile. */
const joining = new WeakSet<App>();

/** Joins bodies that touch. Returns what was done; null if the user has stopped it, or opened another document. */
async function joinedBodies(app: App): Promise<string[] | null> {
  const documentId = (): string => app.documents.state.getState().id;
  const id = documentId();
  const abort = new AbortController();
  const key = "repair";
  const wait = setTimeout(
    () =>
      showNotice(app.shell, {
        key,
        tone: "warning",
        text: strings.bodies.touching.joining,
        action: { label: strings.notices.stop, run: () => abort.abort() },
      }),
    noticeDelayMs,
  );
  joining.add(app);
  const sentences: string[] = [];
  try {
    await joinTouchingBodies(app, abort.signal, (sentence) => sentences.push(sentence));
    return documentId() === id ? sentences : null;
  } catch (error) {
    if (abort.signal.aborted) return null;
    showFailure(app, strings.bodies.touching.joining, error);
    return sentences;
  } finally {
    joining.delete(app);
    clearTimeout(wait);
    hideNotice(app.shell, key);
  }
}

/** Time in milliseconds after which a notice says what the user waits for. */
const noticeDelayMs = 500;

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

/** Resolves when it is known which of two repairs of a body is the better one, or that the user does not wait for it. */
async function comparisonOfRepairs({ bodies, shell }: App, id: number): Promise<void> {
  const isComparing = (): boolean => (bodies.state.getState().byId.get(id)?.comparing ?? null) !== null;
  if (!isComparing()) return;
  const key = "repair";
  showNotice(shell, {
    key,
    tone: "information",
    text: strings.notices.comparingRepairs,
    action: { label: strings.notices.repairNow, run: () => bodies.cancelComparison(id) },
  });
  await new Promise<void>((resolve) => {
    const stop = bodies.state.subscribe(() => {
      if (isComparing()) return;
      stop();
      resolve();
    });
  });
  hideNotice(shell, key);
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
  hideNotice(app.shell, "file-notes");
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
