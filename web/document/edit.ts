import type { Draft } from "mutative";
import type { Project } from "tetrafront/project";

/** A change described by what it does to a draft of the state. */
export interface DraftChange<State> {
  readonly change: (draft: Draft<State>) => void;
}

/** New values at some paths. They are stored unchanged, and their parts are not visited, because they may be large. */
export interface Replacement {
  readonly replace: readonly (readonly [path: readonly string[], value: unknown])[];
}

export type Change<State> = DraftChange<State> | Replacement;

/** A named change of a state: one step of undo. */
export type Edit<State> = Change<State> & {
  /** Verb and object, e.g. "Move point 12". */
  readonly label: string;
  /** Edits with the same key merge into one step if they follow each other within the merge window. */
  readonly mergeKey?: string;
};

/** The part of an open document that undo and redo change. */
export interface DocumentContent {
  readonly project: Project;
  /**
   * Key of a mesh that no run makes of the project: opened from a file, or improved. It applies as long as it begins with
   * the key of the project.
   */
  readonly meshVersion?: string | null;
}

export type ProjectEdit = Edit<DocumentContent>;

/** An edit that changes a draft, so that it can be combined with others. */
export type DraftEdit = ProjectEdit & DraftChange<DocumentContent>;
