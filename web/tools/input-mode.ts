/**
 * Receiver of a key: the text field or the dialog that has the focus, or the view with its tools and
 * commands.
 */
export type InputMode = "field" | "dialog" | "view";

const dialogs = '[role="dialog"], [role="menu"]';
/** Radio buttons, check boxes and switches take no text. */
const fields = 'input:not([type="radio"], [type="checkbox"]), textarea, select, [contenteditable]';

/** Returns whether a dialog or a menu is open. */
export const hasDialog = (): boolean => document.querySelector(dialogs) !== null;

/** Returns the mode for a key event with this target. A field in a dialog belongs to the dialog. */
export function inputMode(target: EventTarget | null): InputMode {
  if (!target || !isElement(target)) return "view";
  if (target.closest(dialogs)) return "dialog";
  return target.closest(fields) ? "field" : "view";
}

/** Widgets in which keys do something of their own, which no script handles. */
const widgets: Readonly<Record<string, string>> = {
  " ": 'button, a, summary, input[type="checkbox"], [role="region"], [role="log"]',
  Home: '[role="region"], [role="log"]',
  End: '[role="region"], [role="log"]',
};

/** Headings get the focus when their panel opens, so that it is read from there. They have no keys, and the user scrolls nothing yet. */
const headings = "h1, h2, h3";

/** Returns whether the browser uses a key for the widget that has the focus: Space presses buttons, Home scrolls. */
export function isOfWidget({ key, target }: Pick<KeyboardEvent, "key" | "target">): boolean {
  const widget = widgets[key];
  if (widget === undefined || target === null || !isElement(target)) return false;
  return target.closest(headings) === null && target.closest(widget) !== null;
}

/** Widgets that take the keys of menus: letters search their items, Enter opens them. */
const menus = '[role="menu"], [role="menubar"]';

/** Fields in which one chooses from a list. Enter opens the list. */
const choices = '[aria-haspopup="listbox"]';

/**
 * Returns whether a key is a hotkey whatever control has the focus: with Ctrl outside fields, dialogs and trees (where Ctrl A
 * selects what is beside the focus), Ctrl Enter also in fields with a list, and single letters on the names of closed menus.
 */
export function takesChord(
  event: Pick<KeyboardEvent, "key" | "ctrlKey" | "metaKey" | "altKey" | "target">,
): boolean {
  const { key, target } = event;
  if (target === null || !isElement(target)) return false;
  const isChord = event.ctrlKey || event.metaKey;
  if (target.closest('[role="dialog"]')) return false;
  if (target.closest(fields)) return isChord && key === "Enter" && target.closest(choices) !== null;
  if (isChord) return key === "Enter" || !target.closest('[role="tree"]');
  const isLetter = key.length === 1 && key !== " " && !event.altKey;
  return isLetter && target.closest('[role="menubar"]:not(:has([aria-expanded="true"]))') !== null;
}

/** Closes the menus or the list around a target, as a press elsewhere does. */
export function closeMenus(target: EventTarget | null): void {
  if (target === null || !isElement(target) || !target.closest(`${menus}, ${choices}`)) return;
  document.body.dispatchEvent(new MouseEvent("mousedown", { bubbles: true }));
}

/** A key event may also have the document or the window as its target. */
function isElement(target: EventTarget): target is Element {
  return "closest" in target;
}
