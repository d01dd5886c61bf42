import type { Mesher } from "tetrafront";
import type { Project } from "tetrafront/project";
import { ViewStore } from "../document/selection";
import { Autosave } from "./autosave";
import { BodyFeed } from "./bodies";
import { BodyCheck } from "./body-check";
import type { DocumentLibrary, LockedDocument, OpenFailure } from "./document-library";
import {
  DocumentStore,
  isListed,
  newDocument,
  type DocumentState,
  type OpenDocument,
  type ProjectFile,
  settledProject,
} from "./document-store";
import { Operations } from "./operations";
import { PreviewFeed } from "./preview";
import { ProblemList } from "./problems";
import { MeshRun } from "./run";
import { regionCount } from "./run-state";
import { SecondOrder } from "./second-order";
import { SizeFeed } from "./size-feed";
import { OutdatedSolids } from "./outdated-solids";
import { Solids } from "./solids";
import { Solutions } from "./solutions";
import { SmoothnessFeed } from "./smoothness-feed";
import type { ShownMesh } from "./shown-mesh";

export interface SessionOptions {
  /** The document that is open at first, and how to release its lock if it has one. */
  readonly first: { readonly document: OpenDocument; readonly release?: () => void };
  /** Makes meshes. */
  readonly mesher: Promise<Mesher>;
  /** Answers quick requests, for example previews, which never wait for a run. */
  readonly previewMesher: Promise<Mesher>;
  /** Where documents are stored; null stores nothing. */
  readonly library: DocumentLibrary | null;
}

/** An open document with its selection, mesh, preview and problems, and its record in the browser's storage. */
export class Session {
  readonly documents: DocumentStore;
  readonly view = new ViewStore();
  readonly operations: Operations;
  readonly run: MeshRun;
  readonly secondOrder: SecondOrder;
  readonly solutions: Solutions;
  readonly previews: PreviewFeed;
  readonly bodies: BodyFeed;
  readonly solids: Solids;
  readonly outdatedSolids: OutdatedSolids;
  readonly problems: ProblemList;
  readonly sizes: SizeFeed;
  readonly smoothness: SmoothnessFeed;
  readonly library: DocumentLibrary | null;
  readonly autosave: Autosave | null;

  constructor({ first: { document, release }, mesher, previewMesher, library }: SessionOptions) {
    this.documents = new DocumentStore(document.history.present.project);
    this.documents.show(document);
    library?.keepOpen(document, release);
    this.bodies = new BodyFeed(this.documents, previewMesher);
    this.solids = new Solids(this.bodies, previewMesher);
    this.outdatedSolids = new OutdatedSolids(this.documents, this.solids);
    this.operations = new Operations(this.documents, this.view, this.solids);
    this.run = new MeshRun(this.documents, mesher, {
      allOf: (project) => this.bodies.preparations.allOf(project),
      keep: (project, prepared) => void this.bodies.keepPrepared(project, prepared),
    });
    this.secondOrder = new SecondOrder(this.run, previewMesher);
    this.solutions = new Solutions(this.documents, this.run);
    this.previews = new PreviewFeed(this.documents, previewMesher);
    const check = new BodyCheck(this.documents, previewMesher, this.bodies);
    this.problems = new ProblemList({ ...this, check });
    this.sizes = new SizeFeed(this, previewMesher);
    this.smoothness = new SmoothnessFeed(this, previewMesher);
    this.library = library;
    this.autosave = library && new Autosave(this.documents, library.storage);
    this.documents.state.subscribe(({ history, gestureStart }, before) => {
      const isLast = history.past !== before.history.past && history.future.length === 0;
      const isRedone = before.history.future[0]?.change === history.past.at(-1)?.change;
      if (gestureStart !== null || !isLast || isRedone) return;
      // Undo may have removed entities before. What the step has added may have their ids.
      for (const project of [settledProject(before), history.present.project])
        this.view.forgetRemoved(project);
    });
    this.run.state.subscribe((state, before) => {
      if (state.mesh !== before.mesh || state.outcome !== before.outcome) this.view.unmark();
      if (regionCount(state) !== regionCount(before)) this.view.showAllRegions();
    });
  }

  /**
   * Shows a project as a new document. Returns the previous document, which Recent lists if it was changed or made of a file.
   */
  showProject(project: Project, file: ProjectFile | null = null): DocumentState {
    return this.#showNew(newDocument(project, file));
  }

  /** Shows a project with a mesh that no run makes of it, as a new document. Returns the previous document. */
  showMesh(project: Project, mesh: ShownMesh): DocumentState {
    const before = this.#showNew(newDocument(project, null, this.run.keep(project, mesh)));
    this.run.logOpening();
    return before;
  }

  /**
   * Shows a document from the library. Returns the previous document, or why the document cannot be shown.
   */
  async showRecent(id: string): Promise<DocumentState | OpenFailure> {
    if (!this.library) return "missing";
    const taken = await this.library.take(id);
    return typeof taken === "string" ? taken : this.showLocked(taken);
  }

  /** Shows again a document that `showProject` or `showRecent` has returned, with all its undo steps. */
  async showAgain(document: OpenDocument): Promise<DocumentState> {
    if (!this.library) return this.#show(document);
    return this.showLocked(await this.library.retake(document));
  }

  showLocked({ document, release }: LockedDocument): DocumentState {
    return this.#show(document, release);
  }

  #showNew(document: OpenDocument): DocumentState {
    const before = this.#show(document);
    this.library?.removeTwins(document).catch(() => undefined);
    return before;
  }

  #show(document: OpenDocument, release?: () => void): DocumentState {
    const before = this.documents.show(document);
    this.#leave(before);
    this.library?.keepOpen(document, release);
    this.view.reset();
    this.view.setCut({ enabled: false });
    return before;
  }

  /** Stores the document that is about to be replaced, unless it is an unchanged model of the gallery. */
  #leave(state: DocumentState): void {
    if (!isListed(state)) {
      this.autosave?.forget(state.id);
      this.library?.storage.remove([state.id]).catch(() => undefined);
    } else void this.autosave?.flush();
  }
}
