import type { App } from "../app/app";
import { addGroup, isGroupable } from "../document/groups";

/** Returns whether groups can hold what is selected. */
export const canGroup = (app: App): boolean => app.view.state.getState().selection.some(isGroupable);

/** Makes a group of the selection. */
export function groupSelection(app: App): void {
  const { selection } = app.view.state.getState();
  app.documents.edit(addGroup(app.documents.project, selection));
}
