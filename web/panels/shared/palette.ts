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

/** Toggles the palette on Ctrl K. If its code is not loaded yet, the palette opens as soon as it is. */
export function listenForPalette(): void {
  window.addEventListener("keydown", (event) => {
    const isOnly = (event.ctrlKey || event.metaKey) && !event.shiftKey && !event.altKey && !event.repeat;
    if (isLost || !isOnly || event.key.toLowerCase() !== "k") return;
    event.preventDefault();
    palette.toggle();
  });
}
