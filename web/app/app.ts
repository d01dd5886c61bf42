import type { Mesher } from "tetrafront";
import { createStore, type StoreApi } from "zustand/vanilla";
import { DocumentPictures } from "../session/document-pictures";
import type { Gallery } from "../session/gallery";
import { Session, type SessionOptions } from "../session/session";
import { createShell, hideMeshNotices, type Shell } from "../session/shell";
import { Drawing } from "../tools/drawing/drawing";
import { MeshQueryClient } from "../viewer/queries/mesh-query-client";
import { noReplay, type Replay } from "./replay";
import type { Viewer } from "../viewer/viewer";

export interface PageOptions {
  readonly gallery: Gallery;
  /** Mesh every project that is opened. */
  readonly generate: boolean;
  /** Turns off motion and smooth edges, so that tests always get the same pictures. */
  readonly still: boolean;
  /** A document with unsaved changes that the address has replaced. */
  readonly left?: LeftDocument | null;
  /** Makes what can be played in the view; without it, nothing can. `mesher`: that of runs. */
  readonly replayOf?: (app: App, mesher: Promise<Mesher>) => Replay;
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
  /** What can be played in the view in place of the model. */
  readonly replay: Replay;
  readonly generate: boolean;
  readonly still: boolean;
  readonly left: LeftDocument | null;
  /** Small pictures of the documents in the library. */
  readonly pictures = new DocumentPictures();

  constructor(session: SessionOptions, { gallery, generate, still, left = null, replayOf }: PageOptions) {
    super(session);
    this.mesher = session.previewMesher;
    this.gallery = gallery;
    this.generate = generate;
    this.still = still;
    this.left = left;
    this.documents.state.subscribe(({ history }, before) => {
      // What was said of a file may be wrong after the first change, for example of what becomes of its triangles.
      if (history.present.project !== before.history.present.project) hideMeshNotices(this.shell);
    });
    this.run.state.subscribe((state, before) => {
      const hasFailed =
        state.outcome !== before.outcome && state.outcome?.result.report.status === "invalid-input";
      if (hasFailed) this.shell.setState({ bottomTab: "problems" });
    });
    this.replay = replayOf?.(this, session.mesher) ?? noReplay;
  }
}
