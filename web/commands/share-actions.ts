/** Links to a state of a recorded front, and code that embeds it in another page. Loaded when they are used. */
import type { App } from "../app/app";
import { queryOf, type SharedFront } from "../player/shared-front";
import { showNotice } from "../session/shell";
import { shareStrings as texts } from "../strings/share";
import type { Viewer } from "../viewer/viewer";
import { showMessage } from "./messages";
import { runEnd } from "./run-end";

/** Records the front of the present model, and shows the state that an address names. */
export async function showShared(app: App, shared: SharedFront): Promise<void> {
  app.shell.setState({ bottomTab: "front" });
  app.run.cancel();
  await runEnd(app);
  const recorded = await app.player.record(shared.order ?? undefined);
  if (recorded?.kind !== "recorded") return;
  const { player } = app;
  player.state.setState({ coloring: shared.coloring });
  player.seek(shared.step);
  player.state.setState({ candidate: knownCandidate(app, shared.candidate) });
  if (shared.camera) (await viewerOf(app)).setPose(shared.camera);
}

/** Returns the candidate if the step shown has tried so many. */
function knownCandidate({ player }: App, candidate: number | null): number | null {
  const { trace, step } = player.state.getState();
  const shown = trace?.stepAt(step);
  const count = shown?.kind === "advance" ? shown.candidates.length : 0;
  return candidate !== null && candidate < count ? candidate : null;
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
 * Returns the state of the front that is shown; null if no address can name it, because the model is not an unchanged one of the
 * gallery, or no front is shown.
 */
export function sharedFrontOf({ documents, gallery, player, viewer }: App): SharedFront | null {
  const { trace, step, coloring, candidate } = player.state.getState();
  const { history } = documents.state.getState();
  const { project } = history.present;
  const model = gallery.models.find(({ title }) => title === project.name);
  if (!trace || !model || history.past.length > 0) return null;
  return {
    model: model.id,
    step,
    order: trace.header.order === "layered" ? null : trace.header.order,
    coloring,
    candidate,
    camera: viewer.getState().viewer?.pose ?? null,
  };
}

export async function copyLink(app: App): Promise<void> {
  const shared = sharedFrontOf(app);
  if (shared) await copy(app, addressOf("index.html", shared), texts.linkCopied);
  else showMessage(app, texts.noLink, [texts.onlyGallery]);
}

/** Copies the HTML that shows the state in a frame of another page. */
export async function copyEmbedCode(app: App): Promise<void> {
  const shared = sharedFrontOf(app);
  if (!shared) return showMessage(app, texts.noLink, [texts.onlyGallery]);
  const title = app.documents.project.name.replace(/[<>&"]/g, "");
  const address = addressOf("embed.html", shared).replaceAll("&", "&amp;");
  const code = `<iframe src="${address}" title="${title}" loading="lazy" style="width: 100%; aspect-ratio: 4 / 3; border: 0"></iframe>`;
  await copy(app, code, texts.codeCopied);
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
