/** Links to the open project. Loaded when they are used. */
import type { App } from "../app/app";
import { settledProject } from "../session/document-store";
import { linkedIn, linkTo, withoutLink, type LinkedProject, type LinkFailure } from "./project-link";
import { untilState } from "../session/until-state";
import { linkStrings } from "../strings/passing";
import type { Viewer } from "../viewer/viewer";
import { showMessage } from "./messages";
import { openProject, showModel } from "./project-actions";

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

/** Returns the link to the open project, as it is seen. */
export async function projectLink(app: App): Promise<string> {
  const { cut } = app.view.state.getState();
  return linkTo(new URL("./", document.baseURI).href, {
    project: settledProject(app.documents.state.getState()),
    camera: app.viewer.getState().viewer?.pose ?? null,
    cut: cut.enabled ? cut : null,
    front: app.replay.link(),
  });
}

/** Shows what a link says beside the project, which is open. */
export async function showLinked(app: App, { camera, cut, front }: LinkedProject): Promise<void> {
  if (cut) app.view.setCut(cut);
  if (front) await app.replay.showLinked(front, camera);
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
