import { createSpotlight } from "@mantine/spotlight";

/** The state of the command palette, and what opens and closes it, also before it is loaded. */
export const [paletteStore, palette] = createSpotlight();

/** Also while an opened palette is still on its way: what is typed then is meant for it. */
/** Its part of the app did not come. */
let isLost = false;

/** Without its part of the app the palette stays shut, and keys are the commands' again. */
export function losePalette(): void {
  isLost = true;
  palette.close();
}

export const isPaletteOpen = (): boolean => paletteStore.getState().opened;

/**
 * Opens the palette on Ctrl K, from the very beginning: what is pressed before the palette is there
 * opens it as soon as it is.
 */
export function listenForPalette(): void {
  window.addEventListener("keydown", (event) => {
    const isOnly = (event.ctrlKey || event.metaKey) && !event.shiftKey && !event.altKey && !event.repeat;
    if (isLost || !isOnly || event.key.toLowerCase() !== "k") return;
    event.preventDefault();
    palette.toggle();
  });
}
