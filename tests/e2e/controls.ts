/** Controls of the page as users find them: by role and label. */
import type { FrameLocator, Locator, Page } from "@playwright/test";

type Scope = FrameLocator | Locator | Page;
type Name = RegExp | string;

export const button = (scope: Scope, name: Name): Locator => scope.getByRole("button", { name, exact: true });
export const tab = (scope: Scope, name: Name): Locator => scope.getByRole("tab", { name, exact: true });
export const choice = (scope: Scope, name: Name): Locator =>
  scope.getByRole("combobox", { name, exact: true });
export const slider = (scope: Scope, name: Name): Locator => scope.getByRole("slider", { name, exact: true });
export const toggle = (scope: Scope, name: Name): Locator => scope.getByRole("switch", { name, exact: true });

/** The button of the header. Bodies have a button of this name, too. */
export const generateButton = (scope: Scope): Locator =>
  button(scope.getByRole("banner"), /^(Generate mesh|Mesh)$/);

const frequent = (scope: Scope): Locator =>
  scope.getByRole("toolbar", { name: "Frequent commands", exact: true });
/** Their names contain the step that is undone. */
export const undoButton = (scope: Scope): Locator => button(frequent(scope), /^Undo/);
export const redoButton = (scope: Scope): Locator => button(frequent(scope), /^Redo/);

/** The button beside the switch of the cut, in the view. The panel of what is displayed has one of this name, too. */
export const flipButton = (scope: Scope): Locator =>
  button(scope.getByRole("group", { name: "Cut", exact: true }), "Flip side");

const jumps = (scope: Scope): Locator => scope.getByRole("group", { name: "Jump to", exact: true });
/** The buttons of the player whose names change. */
export const playButton = (scope: Scope): Locator => button(scope, /^(Play|Pause)$/);
export const recordButton = (scope: Scope): Locator => button(scope, /^Record (the front|again)$/);
export const nextStop = (scope: Scope): Locator => button(jumps(scope), /^Next /);
export const stopBefore = (scope: Scope): Locator => button(jumps(scope), /^Previous /);
