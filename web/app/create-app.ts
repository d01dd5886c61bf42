import { createMesher } from "tetrafront";
import type { Project } from "tetrafront/project";
import { emptyProject } from "../document/create";
import { isEmptyProject } from "../document/entities";
import { DocumentLibrary, type LockedDocument } from "../session/document-library";
import { documentLocks } from "../session/document-locks";
import { BrowserStorage } from "../session/document-storage";
import { newDocument } from "../session/document-store";
import { loadGallery, loadModel, type Gallery } from "../session/gallery";
import { hideNotice, showNotice } from "../session/shell";
import { startPage } from "../session/start-page";
import { BrowserTabMemory } from "../session/tab-memory";
import { strings } from "../strings";
import { workerStrings } from "../strings/passing";
import { maxFailedStarts, onWorkerLost } from "../workers/worker-client";
import { App, type PageOptions } from "./app";

/** What a new app shows first. */
export type Intent =
  /**
   * The document that this tab had open, or the one used last; if there is none, another one: null for the opening model of the
   * gallery.
   */
  | { readonly kind: "continue"; readonly otherwise: Start | null }
  | Start
  | { readonly kind: "project"; readonly project: Project };

/** A document that does not depend on what was open before: a model of the gallery, or an empty project. */
export type Start = { readonly kind: "model"; readonly id: string } | { readonly kind: "new" };

export interface AppOptions {
  /**
   * The name under which the tab remembers which document the app has open. Two apps on one page need
   * different names. The browser stores all documents; null stores nothing.
   */
  readonly autosave: string | null;
  /** Mesh every project that is opened, the first one too. */
  readonly generate: boolean;
  readonly intent: Intent;
  /** The caller records the front of the first document, so that it is not meshed too. Default false. */
  readonly showsFront?: boolean;
  /** Turns off motion and smooth edges, so that tests always get the same pictures. */
  readonly still?: boolean;
  /** Makes what can be played in the view; without it, nothing can. */
  readonly replayOf?: PageOptions["replayOf"];
}

const noGallery: Gallery = { opening: "", models: [] };

/** Makes an app with its own documents, meshers and workers. A page can have several apps. */
export async function createApp(options: AppOptions): Promise<App> {
  const { autosave, generate, intent, showsFront = false, still = false, replayOf } = options;
  // One mesher for runs and one for everything else, so that neither waits for the other.
  const [mesher, previewMesher] = [createMesher(), createMesher()];
  // Runs and previews report a failure themselves; this only prevents an unhandled rejection.
  for (const starting of [mesher, previewMesher]) starting.catch(() => undefined);
  const failures: string[] = [];
  const noteFailure = (error: unknown): void => void failures.push(String(error));

  const tab = autosave === null ? null : new BrowserTabMemory(autosave);
  const library = tab && new DocumentLibrary(new BrowserStorage(), documentLocks(), tab);
  const gallery = await loadGallery().catch((error: unknown) => {
    noteFailure(error);
    return noGallery;
  });
  const known = knownIntent(intent, gallery);
  // Its own documents are locked only from now on.
  const isFurther = (await library?.isOpenElsewhere().catch(() => false)) ?? false;
  const first = await firstDocument(library, gallery, known).catch((error: unknown) => {
    noteFailure(error);
    return { document: newDocument(emptyProject()), isOpening: false };
  });
  const replaces = known.kind !== "continue";
  const left = replaces ? ((await library?.unsaved().catch(() => null)) ?? null) : null;

  const page = { gallery, generate, still, left, ...(replayOf && { replayOf }) };
  const app = new App({ first, mesher, previewMesher, library }, page);
  if (failures.length > 0) {
    app.shell.setState({ message: { title: strings.messages.galleryFailed, lines: failures } });
  } else if (intent.kind === "model" && known !== intent) {
    const lines = [strings.messages.knownExamples(gallery.models.map(({ id }) => id))];
    app.shell.setState({ message: { title: strings.messages.unknownExample(intent.id), lines } });
  }
  keepDocuments(app);
  reportLostWorkers(app);
  const isOpening = first.isOpening === true && tab !== null;
  const kept = tab?.readStart() ?? null;
  const isKept = kept?.documentId === first.document.id;
  if (isKept ? kept.startPage : isOpening && (isFurther || startPage.isWanted()))
    app.shell.setState({ startPage: true });
  // The example is meshed in one tab. A reload keeps it as it was in another one.
  const isUnmeshed = isKept || (isOpening && isFurther);
  if (isUnmeshed && tab) keepUnmeshed(app, tab);
  else tab?.writeStart(null);
  const isMeshed = generate && !showsFront && !isUnmeshed;
  if (isMeshed && !isEmptyProject(first.document.history.present.project)) void app.run.generate("app");
  return app;
}

/** If the gallery does not have the model, keep the last document. */
function knownIntent(intent: Intent, { models }: Gallery): Intent {
  const isKnown = intent.kind !== "model" || models.some(({ id }) => id === intent.id);
  return isKnown ? intent : { kind: "continue", otherwise: null };
}

interface FirstDocument extends Pick<LockedDocument, "document"> {
  readonly release?: () => void;
  /** The gallery's opening model, because there is nothing else to show. */
  readonly isOpening?: boolean;
}

async function firstDocument(
  library: DocumentLibrary | null,
  gallery: Gallery,
  intent: Intent,
): Promise<FirstDocument> {
  if (intent.kind === "project") return { document: newDocument(intent.project) };
  if (intent.kind === "continue") {
    // Without storage, for example in a private window, there is nothing to continue.
    const resumed = await library?.resume().catch(() => null);
    if (resumed) return resumed;
  }
  const start = intent.kind === "continue" ? intent.otherwise : intent;
  if (start?.kind === "new") return { document: newDocument(emptyProject()) };
  const model =
    gallery.models.find(({ id }) => id === start?.id) ??
    gallery.models.find(({ id }) => id === gallery.opening);
  const project = model ? await loadModel(model) : emptyProject();
  return { document: newDocument(project), isOpening: start === null };
}

/** Lets the tab remember that its document is not meshed, until it is, or another one is opened. */
function keepUnmeshed({ documents, run, shell }: App, tab: BrowserTabMemory): void {
  const { id: documentId } = documents.state.getState();
  const write = (): void => tab.writeStart({ documentId, startPage: shell.getState().startPage });
  write();
  const stops = [
    shell.subscribe((state, before) => {
      if (state.startPage !== before.startPage) write();
    }),
    run.state.subscribe(({ busy }) => busy && forget()),
    documents.state.subscribe(({ id }) => id !== documentId && forget()),
  ];
  function forget(): void {
    for (const stop of stops) stop();
    tab.writeStart(null);
  }
}

/** Says that a worker has ended by itself. Its client starts others, but not for ever; runs report the end of the engine. */
function reportLostWorkers({ shell }: App): void {
  onWorkerLost((reason, isReplaced) =>
    showNotice(shell, {
      key: "worker",
      tone: "warning",
      text: isReplaced ? workerStrings.lost(reason) : workerStrings.notStarted(reason, maxFailedStarts),
      action: { label: workerStrings.understood, run: () => undefined },
    }),
  );
}

/** Stores the documents of an app until the user leaves the page. */
function keepDocuments({ autosave, library, shell }: App): void {
  if (!autosave || !library) return;
  autosave.follow();
  autosave.followPage({ window, document });
  autosave.state.subscribe(({ failure }, before) => {
    if (failure === before.failure) return;
    if (failure === null) hideNotice(shell, "autosave-failed");
    else {
      showNotice(shell, {
        key: "autosave-failed",
        tone: "warning",
        text: strings.notices.autosaveFailed(failure),
        action: { label: strings.notices.retry, run: () => void autosave.flush() },
      });
    }
  });
  library.clean().catch(() => undefined);
}
