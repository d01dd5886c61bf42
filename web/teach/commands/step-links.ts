/** Links to a state of a recorded front, and code that embeds it in another page. Loaded when they are used. */
import type { FrontOrder } from "tetrafront";
import type { Project } from "tetrafront/project";
import type { App } from "../../app/app";
import type { LinkedReplay } from "../../app/replay";
import { showFailure, showMessage } from "../../commands/messages";
import { meshOpened } from "../../commands/project-actions";
import { viewerOf } from "../../commands/share-actions";
import { meshKey } from "../../document/content-keys";
import { isUntouched } from "../../session/document-store";
import { loadModel } from "../../session/gallery";
import { showNotice } from "../../session/shell";
import { untilState } from "../../session/until-state";
import type { CameraPose } from "../../viewer/camera";
import { beatsOf, knownBeat } from "../player/beats";
import { firstState } from "../player/phases";
import {
  knownCandidate,
  linkedFrontOf,
  queryOf,
  type SharedFront,
  type ShownFront,
} from "../player/shared-front";
import { addressStrings } from "../strings/address";
import { shareStrings as texts } from "../strings/share";
import { showAddressProblems } from "./address-problems";
import { playerOf } from "./player-of";

/**
 * Shows the state that an address names if its model is open and unchanged. After a reload, another document may be open.
 */
export async function showSharedIfOpen(app: App, shared: SharedFront): Promise<void> {
  const open = await openModel(app, shared.order ?? "layered").catch(() => null);
  if (open?.id === shared.model) await showShared(app, shared);
  else meshOpened(app);
}

/** Shows the state of the front that a link to a project names; without a readable one, meshes the project. */
export async function showLinkedFront(
  app: App,
  linked: LinkedReplay,
  camera: CameraPose | null,
): Promise<void> {
  const front = linkedFrontOf(linked);
  if (front) await showShared(app, { ...front, camera });
  else meshOpened(app);
}

/** Records the front of the present model, and shows the state that an address names. */
export async function showShared(app: App, shared: ShownFront): Promise<void> {
  const player = playerOf(app);
  app.shell.setState({ bottomTab: "front", drawer: "bottom" });
  app.run.cancel();
  await untilState(app.run.state, ({ busy }) => !busy);
  const recorded = await player.record({ order: shared.order ?? undefined });
  if (recorded?.kind !== "recorded") return;
  const { coloring, faces, elements } = shared;
  // A camera that the link names stays where it is.
  player.state.setState({ coloring, faces, elements, follows: shared.camera === null });
  player.seek(shared.step);
  const { step } = player.state.getState();
  const { trace } = recorded;
  const candidate = knownCandidate(trace, step, shared.candidate);
  const beat = knownBeat(trace, step, shared.beat);
  player.state.setState({ candidate, beat, ...(beat !== null && { film: true }) });
  showAddressProblems(app, [
    ...(step === shared.step
      ? []
      : [addressStrings.noStep(shared.step, firstState(trace), trace.stepCount, step)]),
    ...(shared.candidate === candidate || shared.candidate === null
      ? []
      : [addressStrings.noCandidate(shared.candidate, step)]),
    ...(shared.beat === beat || shared.beat === null || shared.beat === beatsOf(trace, step).length
      ? []
      : [addressStrings.noBeat(shared.beat, step, beatsOf(trace, step).length)]),
  ]);
  if (shared.camera) (await viewerOf(app)).setPose(shared.camera);
}

/**
 * Returns the state of the front that is shown; null if no address can name it, because the front is not that of an
 * unchanged model of the gallery, or no front is shown. Throws if the model cannot be loaded.
 */
export async function sharedFrontOf(app: App): Promise<SharedFront | null> {
  const { trace, step, coloring, faces, elements, candidate, beat } = playerOf(app).state.getState();
  if (!trace || trace.header.name !== app.documents.project.name) return null;
  const { order } = trace.header;
  const camera = app.viewer.getState().viewer?.pose ?? null;
  const open = await openModel(app, order);
  if (!open) return null;
  const usual = open.original.meshing?.order ?? "layered";
  const named = order === usual ? null : order;
  return { model: open.id, step, order: named, coloring, faces, elements, candidate, beat, camera };
}

interface OpenModel {
  /** Id of the model in the gallery. */
  readonly id: string;
  readonly original: Project;
}

/**
 * Returns the model of the gallery that the open document is; null if it is another one or was changed. Its order may be
 * another one: it is replaced by `order` in the comparison.
 */
async function openModel({ documents, gallery }: App, order: FrontOrder): Promise<OpenModel | null> {
  const state = documents.state.getState();
  const { project } = state.history.present;
  const model = gallery.models.find(({ title }) => title === project.name);
  if (!model || !isUntouched(state)) return null;
  const original = await loadModel(model);
  if (documents.state.getState().id !== state.id) return null;
  const [given, open] = [original, project].map((each) =>
    meshKey({ ...each, meshing: { ...each.meshing, order } }),
  );
  return given === open ? { id: model.id, original } : null;
}

/** Copies the link to the step: an unchanged example has a short one; any other model is in the link. */
export async function copyLink(app: App): Promise<void> {
  const shared = await sharedFrontOf(app).catch(() => null);
  if (shared) await copy(app, addressOf("index.html", shared), texts.linkCopied);
  else app.shell.setState({ dialog: "share" });
}

/** Copies the HTML that shows the state in a frame of another page. */
export async function copyEmbedCode(app: App): Promise<void> {
  const title = app.documents.project.name.replace(/[<>&"]/g, "");
  await withShared(app, (shared) => {
    const address = addressOf("embed.html", shared).replaceAll("&", "&amp;");
    const code = `<iframe src="${address}" title="${title}" loading="lazy" style="width: 100%; aspect-ratio: 4 / 3; border: 0"></iframe>`;
    return copy(app, code, texts.codeCopied);
  });
}

/** Calls `pass` with the state of the front that is shown, or says why no address names it. */
async function withShared(app: App, pass: (shared: SharedFront) => Promise<void>): Promise<void> {
  try {
    const shared = await sharedFrontOf(app);
    if (shared) await pass(shared);
    else showMessage(app, texts.noLink, [texts.onlyGallery]);
  } catch (error) {
    showFailure(app, texts.noLink, error);
  }
}

function addressOf(page: string, shared: SharedFront): string {
  const address = new URL(page === "index.html" ? "./" : page, document.baseURI);
  address.search = queryOf(shared).toString();
  return address.href;
}

async function copy(app: App, text: string, done: string): Promise<void> {
  try {
    await navigator.clipboard.writeText(text);
    showNotice(app.shell, {
      key: "shared",
      tone: "information",
      text: done,
      action: { label: texts.understood, run: () => undefined },
    });
  } catch {
    // Without the permission for the clipboard, the user copies it by hand.
    showMessage(app, texts.copyByHand, [text]);
  }
}
