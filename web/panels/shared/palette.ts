import { createSpotlight } from "@mantine/spotlight";

/** The state of the command palette. It can be opened before its code is loaded. */
export const [paletteStore, palette] = createSpotlight();

/** True if the code of the palette could not be loaded. */
let isLost = false;

/** Keeps the palette closed, because its code could not be loaded. */
export function losePalette(): void {
  isLost = true;
  palette.close();
}

/** Returns whether the palette is open or about to open; keys are then meant for it. */
export const isPaletteOpen = (): boolean => paletteStore.getState().opened;

/** What is typed after the palette was opened and before its field has the focus. */
export interface EarlyKeys {
  readonly text: string;
  /** Whether Enter ends the text. */
  readonly isEntered: boolean;
}

const noKeys: EarlyKeys = { text: "", isEntered: false };

let early = noKeys;

/** Returns the early keys, once. */
export function takeEarlyKeys(): EarlyKeys {
  const taken = early;
  early = noKeys;
  return taken;
}

/** Returns the early keys and one more, or null if it is of no use to the palette. */
function withKey({ text, isEntered }: EarlyKeys, key: string): EarlyKeys | null {
  if (key === "Enter") return { text, isEntered: true };
  if (key === "Backspace") return { text: text.slice(0, -1), isEntered };
  return key.length === 1 ? { text: text + key, isEntered } : null;
}

/** Keeps a key for the palette that is about to open, or closes it on Escape. */
function keepForPalette(event: KeyboardEvent): void {
  const isInPalette = event.target instanceof Element && event.target.closest("[data-palette]") !== null;
  if (!isPaletteOpen() || isInPalette || event.ctrlKey || event.metaKey || event.altKey) return;
  const next = withKey(early, event.key);
  if (next !== null) early = next;
  else if (event.key === "Escape") palette.close();
  else return;
  event.preventDefault();
  event.stopPropagation();
}

/**
 * Toggles the palette on Ctrl K. If its code is not loaded yet, the palette opens as soon as it is. Keys that are pressed
 * before its field has the focus are kept for it.
 */
export function listenForPalette(): void {
  window.addEventListener("keydown", keepForPalette, { capture: true });
  window.addEventListener("keydown", (event) => {
    const isOnly = (event.ctrlKey || event.metaKey) && !event.shiftKey && !event.altKey && !event.repeat;
    if (isLost || !isOnly || event.key.toLowerCase() !== "k") return;
    event.preventDefault();
    early = noKeys;
    palette.toggle();
  });
}
