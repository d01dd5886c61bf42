import type { Mesher } from "tetrafront";
import { createStore, type StoreApi } from "zustand/vanilla";
import { Player } from "../teach/player/player";
import { DocumentPictures } from "../session/document-pictures";
import type { Gallery } from "../session/gallery";
import { Session, type SessionOptions } from "../session/session";
import { createShell, hideMeshNotices, showNotice, type Shell } from "../session/shell";
import { lessonStrings } from "../teach/strings/lessons";
import { Drawing } from "../tools/drawing/drawing";
import { MeshQueryClient } from "../viewer/queries/mesh-query-client";
import type { PreparedOf } from "../teach/player/recording";
import type { Viewer } from "../viewer/viewer";

export interface PageOptions {
  readonly gallery: Gallery;
  /** Mesh every project that is opened. */
  readonly generate: boolean;
  /** Turns off motion and smooth edges, so that tests always get the same pictures. */
  readonly still: boolean;
  /** A document with unsaved changes that the address has replaced. */
  readonly left?: LeftDocument | null;
}

export interface LeftDocument {
  readonly id: string;
  readonly name: string;
}

/** A session with its view and its workers: everything that panels and commands work with. */
export class App extends Session {
  /**
   * Makes covering grids and proposes sizes. Runs have their own mesher, so that neither waits for the other.
   */
  readonly mesher: Promise<Mesher>;
  readonly shell: Shell = createShell();
  readonly gallery: Gallery;
  /** Answers queries about the mesh that is shown. */
  readonly meshQueries = new MeshQueryClient();
  /** The view; null without WebGL. */
  readonly viewer: StoreApi<{ readonly viewer: Viewer | null }> = createStore<{
    readonly viewer: Viewer | null;
  }>(() => ({ viewer: null }));
  /** What the drawing tools show. */
  readonly drawing = new Drawing();
  /** Records and plays the front of the present model. */
  readonly player: Player;
  readonly generate: boolean;
  readonly still: boolean;
  readonly left: LeftDocument | null;
  /** Small pictures of the documents in the library. */
  readonly pictures = new DocumentPictures();

  constructor(session: SessionOptions, { gallery, generate, still, left = null }: PageOptions) {
    super(session);
    this.mesher = session.previewMesher;
    const { mesher } = session;
    const preparedOf: PreparedOf = (project) => this.bodies.preparations.allOf(project);
    this.player = new Player({ documents: this.documents, run: this.run, mesher, preparedOf });
    this.documents.setLock({
      isLocked: () => this.isLessonModel,
      refused: () => this.#offerToEdit(),
    });
    this.gallery = gallery;
    this.generate = generate;
    this.still = still;
    this.left = left;
    this.player.state.subscribe(({ trace }, { trace: before }) => {
      if ((trace === null) === (before === null)) return;
      this.shell.setState(({ leftTab }) => ({
        leftTab: trace ? "lens" : leftTab === "lens" ? "model" : leftTab,
      }));
    });
    this.documents.state.subscribe(({ history }, before) => {
      // What was said of a file may be wrong after the first change, for example of what becomes of its triangles.
      if (history.present.project !== before.history.present.project) hideMeshNotices(this.shell);
    });
    this.run.state.subscribe((state, before) => {
      const hasFailed =
        state.outcome !== before.outcome && state.outcome?.result.report.status === "invalid-input";
      if (hasFailed) this.shell.setState({ bottomTab: "problems" });
    });
  }

  /** Whether the document is the model of the open lesson: its steps and numbers hold for this model only, so it is not edited. */
  get isLessonModel(): boolean {
    const { lesson, lessonModel } = this.shell.getState();
    return lesson !== null && lessonModel === this.documents.state.getState().id;
  }

  #offerToEdit(): void {
    const run = (): void => this.shell.setState({ lessonModel: null });
    const action = { label: lessonStrings.editModel, run };
    showNotice(this.shell, {
      key: "lesson-model",
      tone: "information",
      text: lessonStrings.modelLocked,
      action,
    });
  }
}
