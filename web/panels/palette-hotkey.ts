import { spotlight } from "@mantine/spotlight";

/**
 * Opens the palette on Ctrl K, from the very beginning: what is pressed before the palette is there
 * opens it as soon as it is.
 */
export function listenForPalette(): void {
  window.addEventListener("keydown", (event) => {
    const isOnly = (event.ctrlKey || event.metaKey) && !event.shiftKey && !event.altKey && !event.repeat;
    if (!isOnly || event.key.toLowerCase() !== "k") return;
    event.preventDefault();
    spotlight.toggle();
  });
}
