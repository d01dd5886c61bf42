import type { App } from "../app/app";
import { pasteOperation } from "../document/operations/paste";
import { operationStrings, strings } from "../strings";
import { addPoints, readPositionList, refusedLineOf } from "../document/position-list";
import { create } from "./creation-actions";
import { fragmentText, readFragment } from "../document/transforms/fragment";
import { showMessage, showRefusal } from "./messages";
import { startOperation } from "./start-operation";

/** What this page has copied last: for browsers that do not let it read the clipboard. */
let copied: string | null = null;

/** Undefined on pages that are not loaded by a secure connection. */
const clipboard = (): Clipboard | undefined => (navigator as { readonly clipboard?: Clipboard }).clipboard;

/** Puts the selection on the clipboard, as the text of a project. */
export async function copySelection(app: App): Promise<void> {
  const text = fragmentText(app.documents.project, app.view.state.getState().selection);
  if (text === null) return;
  copied = text;
  // Without permission, the text can still be pasted in this page.
  await clipboard()
    ?.writeText(text)
    .catch(() => undefined);
}

/** Opens the panel that pastes what the clipboard has. */
export async function pasteFragment(app: App): Promise<void> {
  const text = await clipboard()
    ?.readText()
    .catch(() => null);
  if (text && pastePositions(app, text)) return;
  const read = readFragment(text || copied || "");
  const refused = text ? refusedLineOf(text) : null;
  if (!("reason" in read)) startOperation(app, pasteOperation(read.fragment));
  else if (refused === null) showRefusal(app, operationStrings.paste.title, read.reason);
  else showMessage(app, operationStrings.paste.title, [operationStrings.refusals.refusedLine(refused)]);
}

/** Pastes a list of coordinates: as places of the active drawing tool, or as points. Returns false for any other text. */
function pastePositions(app: App, text: string): boolean {
  const positions = readPositionList(text);
  if (!positions) return false;
  if (!pasteLines(app, text)) create(app, addPoints(app.documents.project, positions));
  return true;
}

/**
 * Hands pasted lines to the active drawing tool, and tells which line it refuses. Returns false without a tool that takes
 * coordinates.
 */
export function pasteLines(app: Pick<App, "drawing" | "shell">, text: string): boolean {
  const refused = app.drawing.takeLines(text);
  if (refused != null) showMessage(app, operationStrings.paste.title, [strings.drawing.refusedLine(refused)]);
  return refused !== undefined;
}

/** Is no text of the page selected, which Ctrl C copies then? */
export const hasNoText = (): boolean => window.getSelection()?.isCollapsed !== false;
