import { create, type Draft } from "mutative";
import type { Project } from "tetrafront/project";

/** The part of an open document that undo and redo change. */
export interface DocumentContent {
  readonly project: Project;
  /**
   * Key of a mesh that no run makes of the project: opened from a file, or improved. It applies as long as it begins with
   * the key of the project.
   */
  readonly meshVersion?: string | null;
}

/** A change described by what it does to a draft of the content. */
export interface DraftChange {
  readonly change: (draft: Draft<DocumentContent>) => void;
}

/** New values of fields of the project. They are stored unchanged, and their parts are not visited, because they may be large. */
export interface Replacement {
  readonly replace: Partial<Project>;
}

export type Change = DraftChange | Replacement;

/** A named change: one step of undo. */
export type ProjectEdit = Change & {
  /** Verb and object, e.g. "Move point 12". */
  readonly label: string;
  /** Edits with the same key merge into one step if they follow each other within the merge window. */
  readonly mergeKey?: string;
};

/** An edit that changes a draft, so that it can be combined with others. */
export type DraftEdit = ProjectEdit & DraftChange;

/** Returns the content after a change; the same object if a draft was not changed. */
export function changedContent(content: DocumentContent, change: Change): DocumentContent {
  if ("change" in change) return create(content, change.change);
  return { ...content, project: { ...content.project, ...change.replace } };
}
