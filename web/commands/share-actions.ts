/** Links to a state of a recorded front, and code that embeds it in another page. Loaded when they are used. */
import type { FrontOrder } from "tetrafront";
import type { Project } from "tetrafront/project";
import type { App } from "../app/app";
import { meshKey } from "../document/content-keys";
import { knownCandidate, queryOf, type SharedFront } from "../teach/player/shared-front";
import { firstState } from "../teach/player/phases";
import { linkedIn, linkTo, withoutLink, type LinkedProject, type LinkFailure } from "../session/project-link";
import { isUntouched, settledProject } from "../session/document-store";
import { loadModel } from "../session/gallery";
import { showNotice } from "../session/shell";
import { untilState } from "../session/until-state";
import { addressStrings } from "../teach/strings/address";
import { linkStrings } from "../strings/passing";
import { shareStrings as texts } from "../teach/strings/share";
import { breakpoints } from "../ui/theme/theme";
import type { Viewer } from "../viewer/viewer";
import { showAddressProblems } from "../teach/commands/address-problems";
import { showFailure, showMessage } from "./messages";
import { meshOpened, openProject, showModel } from "./project-actions";

/**
 * Shows the state that an address names if its model is open and unchanged. After a reload, another document may be open.
 */
export async function showSharedIfOpen(app: App, shared: SharedFront): Promise<void> {
  const open = await openModel(app, shared.order ?? "layered").catch(() => null);
  if (open?.id === shared.model) await showShared(app, shared);
  else meshOpened(app);
}

/** A state of a front, and how it is seen. */
type ShownFront = Omit<SharedFront, "model">;

/** Records the front of the present model, and shows the state that an address names. */
export async function showShared(app: App, shared: ShownFront): Promise<void> {
  app.shell.setState({ bottomTab: "front", drawer: "bottom" });
  app.run.cancel();
  await untilState(app.run.state, ({ busy }) => !busy);
  const recorded = await app.player.record({ order: shared.order ?? undefined });
  if (recorded?.kind !== "recorded") return;
  const { player } = app;
  const { coloring, faces, elements } = shared;
  player.state.setState({ coloring, faces, elements });
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
export function viewerOf({ viewer: store }: App): Promise<Viewer> {
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
  const { trace, step, coloring, faces, elements, candidate } = app.player.state.getState();
  if (!trace || trace.header.name !== app.documents.project.name) return null;
  const { order } = trace.header;
  const camera = app.viewer.getState().viewer?.pose ?? null;
  const open = await openModel(app, order);
  if (!open) return null;
  const usual = open.original.meshing?.order ?? "layered";
  const named = order === usual ? null : order;
  return { model: open.id, step, order: named, coloring, faces, elements, candidate, camera };
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

/** Returns the link to the open project, as it is seen. */
export async function projectLink(app: App): Promise<string> {
  const { trace, step, coloring, faces, elements, candidate } = app.player.state.getState();
  const { cut } = app.view.state.getState();
  return linkTo(new URL("./", document.baseURI).href, {
    project: settledProject(app.documents.state.getState()),
    camera: app.viewer.getState().viewer?.pose ?? null,
    cut: cut.enabled ? cut : null,
    front: trace ? { step, order: trace.header.order, coloring, faces, elements, candidate } : null,
  });
}

/** Shows what a link says beside the project, which is open. */
export async function showLinked(app: App, { camera, cut, front }: LinkedProject): Promise<void> {
  if (cut) app.view.setCut(cut);
  if (front) await showShared(app, { ...front, camera });
  else if (camera) (await viewerOf(app)).setPose(camera);
}

/** Opens the project of a link that was entered while another one was open, which Recent keeps. */
export async function openLink(app: App, hash: string): Promise<void> {
  const found = await linkedIn(hash);
  if (!found) return;
  window.history.replaceState(null, "", withoutLink(window.location.href));
  if (found.kind !== "linked") return showLinkFailure(app, found);
  // The front of a step is recorded in place of a run.
  const open = found.linked.front ? showModel : openProject;
  open(app, found.linked.project);
  await showLinked(app, found.linked);
}

/**
 * Takes the link out of the address when its project is stored: a reload then continues with the project as it is. Until
 * then, a reload opens the link again.
 */
export async function removeLink({ autosave }: App): Promise<void> {
  if (autosave) await untilState(autosave.state, ({ pending }) => !pending);
  window.history.replaceState(null, "", withoutLink(window.location.href));
}

export function showLinkFailure(app: App, failure: LinkFailure): void {
  const line = failure.kind === "damaged" ? linkStrings.damaged : linkStrings.invalid(failure.reason);
  showMessage(app, linkStrings.noLink, [line]);
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
