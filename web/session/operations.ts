import { createStore, type StoreApi } from "zustand/vanilla";
import { existingIn, type Entity } from "../document/entities";
import {
  changedExpressions,
  type FieldExpressions,
  type FieldValue,
  type FieldValues,
  type Operation,
  type SolidMaker,
  type Subject,
  type TypedNumber,
} from "../document/operations/operation";
import type { ViewStore } from "../document/selection";
import { isDrawingTool, toolKinds } from "../document/tools";
import type { Offer } from "../document/create";
import { settledProject, type DocumentStore, type Gesture } from "./document-store";
import { failureText } from "./failure-text";
import { LatestTask } from "./latest-task";

/** An operation whose panel is open. */
export interface OpenOperation {
  readonly operation: Operation;
  readonly values: FieldValues;
  /** What the numbers of the values were typed as. */
  readonly expressions: FieldExpressions;
  /** The project without the operation, and the selection in it. */
  readonly subject: Subject;
  /** Whether what the values give is being computed. */
  readonly isPending: boolean;
  /** Why the values give nothing; null if the view shows what they give, or will. */
  readonly reason: string | null;
  /** What the user should know about what the values give; empty if there is nothing to know. */
  readonly note: string;
  /** What the values give. */
  readonly entities: readonly Entity[];
}

/** Gives makers whose work is left out if it is aborted before it begins: only the last values count. */
export interface SolidSource {
  readonly until: (signal: AbortSignal) => SolidMaker;
}

export interface OperationState {
  readonly open: OpenOperation | null;
}

/**
 * Shows what an operation gives while the user changes its values: a gesture of the document, which is one step of undo
 * when it is accepted. Whatever else ends the gesture, for example undo or another edit, closes the operation; so does the
 * choice of a tool that changes the project.
 */
export class Operations {
  readonly state: StoreApi<OperationState> = createStore<OperationState>(() => ({ open: null }));
  readonly #documents: DocumentStore;
  readonly #view: ViewStore;
  readonly #solids: SolidSource;
  readonly #task = new LatestTask();
  #gesture: Gesture | null = null;
  /** Whether the open operation is accepted as soon as it is computed. */
  #isAccepted = false;

  constructor(documents: DocumentStore, view: ViewStore, solids: SolidSource) {
    this.#documents = documents;
    this.#view = view;
    this.#solids = solids;
    documents.state.subscribe(({ gestureStart }, before) => {
      if (gestureStart !== before.gestureStart && before.gestureStart !== null) this.#close();
    });
    view.state.subscribe(({ selection, tool, brush, moving }, before) => {
      const { open } = this.state.getState();
      const isEditing = toolKinds[tool].adds || brush !== null || moving !== null;
      const wasEditing = toolKinds[before.tool].adds || before.brush !== null || before.moving !== null;
      // One gesture at a time: what the tool draws would not get into the project.
      if (open && isEditing && !wasEditing) this.cancel();
      else if (open?.operation.usesSelection === true && selection !== before.selection)
        this.#follow(open, selection);
    });
  }

  /** Opens an operation with its first values, instead of the one that is open. */
  start(operation: Operation): void {
    this.cancel();
    const { tool, brush, moving } = this.#view.state.getState();
    if (isDrawingTool(tool) || brush !== null || moving !== null) this.#view.setTool("select");
    // What the operation adds may get the ids of entities that undo has removed.
    this.#view.forgetRemoved(this.#documents.project);
    const { selection } = this.#view.state.getState();
    const subject = { project: this.#documents.project, selection };
    this.#gesture = this.#documents.begin(operation.step);
    const project = settledProject(this.#documents.state.getState());
    const values = operation.initial({ ...subject, project });
    const expressions = operation.expressions?.() ?? {};
    this.#show({ operation, values, expressions, subject: { ...subject, project } });
  }

  /** Changes a value of the open operation. `typed`: the number of it that was typed. */
  set(key: string, value: FieldValue, typed?: TypedNumber): void {
    const { open } = this.state.getState();
    if (!open) return;
    this.#isAccepted = false;
    const expressions = changedExpressions(open.expressions, key, [open.values[key], value], typed);
    this.#show({ ...open, values: { ...open.values, [key]: value }, expressions });
  }

  /**
   * Accepts what the open operation gives, and selects it; as soon as it is computed, if that takes time. Returns false if it gives
   * nothing.
   */
  accept(): boolean {
    const { open } = this.state.getState();
    if (!open || open.reason !== null) return false;
    if (open.isPending) {
      this.#isAccepted = true;
      return true;
    }
    const gesture = this.#gesture;
    this.#close();
    gesture?.commit();
    this.#view.selectAll(open.entities);
    return true;
  }

  /** Closes the open operation and restores the project. */
  cancel(): void {
    const gesture = this.#gesture;
    this.#close();
    gesture?.cancel();
  }

  #close(): void {
    this.#task.cancel();
    this.#isAccepted = false;
    this.#gesture = null;
    if (this.state.getState().open) this.state.setState({ open: null });
  }

  #follow(open: OpenOperation, selection: readonly Entity[]): void {
    // The view also shows what the operation adds.
    const { subject } = open;
    this.#show({ ...open, subject: { ...subject, selection: existingIn(subject.project, selection) } });
  }

  #show(given: Omit<OpenOperation, "reason" | "note" | "entities" | "isPending">): void {
    const { operation, values, expressions, subject } = given;
    this.#task.cancel();
    const left = new AbortController();
    const solids = this.#solids.until(left.signal);
    const later = operation.makeLater?.(subject, values, solids, expressions) ?? null;
    if (later === null) return this.#showOffer(given, operation.make(subject, values, expressions));
    const entities = this.state.getState().open?.entities ?? [];
    this.state.setState({ open: { ...given, isPending: true, reason: null, note: "", entities } });
    // The view keeps what the values before have given until the new ones are computed.
    this.#task
      .run(
        (signal) => {
          signal.addEventListener("abort", () => left.abort(signal.reason));
          return later;
        },
        (made) => this.#showOffer(given, made),
      )
      .catch((failure: unknown) => {
        this.#showOffer(given, { possible: false, reason: failureText(failure) });
      });
  }

  #showOffer(given: Omit<OpenOperation, "reason" | "note" | "entities" | "isPending">, offer: Offer): void {
    const entities = offer.possible ? offer.creation.entities : [];
    const reason = offer.possible ? null : offer.reason;
    const note = (offer.possible && offer.creation.note) || "";
    this.state.setState({ open: { ...given, isPending: false, reason, note, entities } });
    this.#gesture?.update(offer.possible ? offer.creation.edit : { change: () => undefined });
    const isAccepted = this.#isAccepted;
    this.#isAccepted = false;
    if (isAccepted) this.accept();
  }
}
