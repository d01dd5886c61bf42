import { createSpotlight } from "@mantine/spotlight";
import { createStore } from "zustand/vanilla";
import { closeMenus } from "../../tools/input-mode";

const [store, spotlight] = createSpotlight();

/** The state of the command palette. It can be opened before its code is loaded. */
export const paletteStore = store;

/** What the user has typed since the palette was opened. */
export interface PaletteText {
  readonly query: string;
  /** Number of keys that were pressed while the field did not have the focus. */
  readonly keptKeys: number;
  /** Whether Enter was pressed before the field had the focus: the best match runs as soon as it is shown. */
  readonly isEntered: boolean;
}

const noText: PaletteText = { query: "", keptKeys: 0, isEntered: false };

/** The text of the palette: of its field, and of keys that are pressed before the field has the focus. */
export const paletteText = createStore<PaletteText>(() => noText);

/** True if the code of the palette could not be loaded. */
let isLost = false;

export const palette = {
  /** Opens the palette without a text; an open one stays as it is. */
  open(): void {
    if (isLost || isPaletteOpen()) return;
    paletteText.setState(noText);
    spotlight.open();
  },
  close: (): void => spotlight.close(),
} as const;

/** Keeps the palette closed, because its code could not be loaded. */
export function losePalette(): void {
  isLost = true;
  palette.close();
}

/** Returns whether the palette is open or about to open; keys are then meant for it. */
export const isPaletteOpen = (): boolean => paletteStore.getState().opened;

/** Returns the field of the palette; null before it is shown. */
const paletteField = (): HTMLInputElement | null => document.querySelector("[data-palette] input");

/** Returns the text after one more key; null if the key is of no use to the palette. */
function withKey(text: PaletteText, key: string): PaletteText | null {
  const next = { ...text, keptKeys: text.keptKeys + 1 };
  if (key === "Enter") return { ...next, isEntered: true };
  if (key === "Backspace") return { ...next, query: text.query.slice(0, -1) };
  return key.length === 1 ? { ...next, query: text.query + key } : null;
}

/**
 * Gives a key to the open palette if its field does not have the focus: because the palette is not shown yet, or because the
 * focus has returned to where it was before a menu or a dialog that closes meanwhile.
 */
function keepForPalette(event: KeyboardEvent): void {
  const field = paletteField();
  const isInField = field !== null && event.target === field;
  if (!isPaletteOpen() || isInField || event.ctrlKey || event.metaKey || event.altKey) return;
  const isEntry = event.target instanceof Element && event.target.closest("[data-palette] button") !== null;
  // Enter and Space press the entry that has the focus.
  if (isEntry && (event.key === "Enter" || event.key === " ")) return;
  const next = withKey(paletteText.getState(), event.key);
  if (next !== null) {
    paletteText.setState(next);
    field?.focus();
  } else if (event.key === "Escape") palette.close();
  else return;
  event.preventDefault();
  event.stopImmediatePropagation();
}

/** Opens the palette on Ctrl K, or closes it. One that is not shown yet stays open: the user only sees that nothing happens. */
function toggleOnKey(event: KeyboardEvent): void {
  const isOnly = (event.ctrlKey || event.metaKey) && !event.shiftKey && !event.altKey;
  if (isLost || !isOnly || event.key.toLowerCase() !== "k") return;
  event.preventDefault();
  event.stopImmediatePropagation();
  if (event.repeat) return;
  if (!isPaletteOpen()) {
    closeMenus(event.target);
    palette.open();
  } else if (paletteField() !== null) palette.close();
}

/** Listens for Ctrl K and for the keys of the open palette, before anything else on the page does. */
export function listenForPalette(): void {
  window.addEventListener("keydown", keepForPalette, { capture: true });
  window.addEventListener("keydown", toggleOnKey, { capture: true });
}
