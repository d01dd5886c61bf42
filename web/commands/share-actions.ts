/** Links to a state of a recorded front, and code that embeds it in another page. Loaded when they are used. */
import type { FrontOrder, Project } from "tetrafront";
import type { App } from "../app/app";
import { meshKey } from "../document/content-keys";
import { knownCandidate, queryOf, type SharedFront } from "../player/shared-front";
import { firstState } from "../player/phases";
import { isUntouched } from "../session/document-store";
import { loadModel } from "../session/gallery";
import { showNotice } from "../session/shell";
import { untilState } from "../session/until-state";
import { addressStrings } from "../strings/address";
import { shareStrings as texts } from "../strings/share";
import { breakpoints } from "../ui/theme/theme";
import type { Viewer } from "../viewer/viewer";
import { showAddressProblems } from "./address-problems";
import { showFailure, showMessage } from "./messages";

/**
 * Shows the state that an address names if its model is open and unchanged. After a reload, another document may be open.
 */
export async function showSharedIfOpen(app: App, shared: SharedFront): Promise<void> {
  const open = await openModel(app, shared.order ?? "layered").catch(() => null);
  if (open?.id === shared.model) await showShared(app, shared);
}

/** Records the front of the present model, and shows the state that an address names. */
export async function showShared(app: App, shared: SharedFront): Promise<void> {
  app.shell.setState({ bottomTab: "front", drawer: "bottom" });
  app.run.cancel();
  await untilState(app.run.state, ({ busy }) => !busy);
  const recorded = await app.player.record({ order: shared.order ?? undefined });
  if (recorded?.kind !== "recorded") return;
  const { player } = app;
  player.state.setState({ coloring: shared.coloring });
  player.seek(shared.step);
  const { step } = player.state.getState();
  const { trace } = recorded;
  const candidate = knownCandidate(trace, step, shared.candidate);
  player.state.setState({ candidate });
  showAddressProblems(app, [
    ...(step === shared.step
      ? []
      : [addressStrings.noStep(shared.step, firstState(trace), trace.stepCount, step)]),
    ...(shared.candidate === candidate || shared.candidate === null
      ? []
      : [addressStrings.noCandidate(shared.candidate, step)]),
  ]);
  if (shared.camera) (await viewerOf(app)).setPose(shared.camera);
  // In a small view, the step could not be seen beside the rest of the model.
  else if (window.innerWidth < breakpoints.phone) player.state.setState({ follows: true });
}

/** Resolves when the view is there; never without WebGL. */
function viewerOf({ viewer: store }: App): Promise<Viewer> {
  const { viewer } = store.getState();
  if (viewer) return Promise.resolve(viewer);
  return new Promise((resolve) => {
    const stop = store.subscribe(({ viewer: made }) => {
      if (!made) return;
      stop();
      resolve(made);
    });
  });
}

/**
 * Returns the state of the front that is shown; null if no address can name it, because the front is not that of an
 * unchanged model of the gallery, or no front is shown. Throws if the model cannot be loaded.
 */
export async function sharedFrontOf(app: App): Promise<SharedFront | null> {
  const { trace, step, coloring, candidate } = app.player.state.getState();
  if (!trace || trace.header.name !== app.documents.project.name) return null;
  const { order } = trace.header;
  const camera = app.viewer.getState().viewer?.pose ?? null;
  const open = await openModel(app, order);
  if (!open) return null;
  const usual = open.original.meshing?.order ?? "layered";
  return { model: open.id, step, order: order === usual ? null : order, coloring, candidate, camera };
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

export async function copyLink(app: App): Promise<void> {
  await withShared(app, (shared) => copy(app, addressOf("index.html", shared), texts.linkCopied));
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
