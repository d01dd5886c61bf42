/** Dark or light: as the system, or as the reader has chosen here or in the app. */
import { themeChanged } from "../kit/colours";

/** The app's own key. */
const storageKey = "mantine-color-scheme-value";

export function startTheme(): void {
  const button = document.getElementById("theme");
  button?.addEventListener("click", () => {
    const chosen = document.documentElement.dataset["theme"];
    const isDark =
      chosen === undefined ? matchMedia("(prefers-color-scheme: dark)").matches : chosen === "dark";
    const next = isDark ? "light" : "dark";
    document.documentElement.dataset["theme"] = next;
    try {
      localStorage.setItem(storageKey, next);
    } catch {
      // Without storage, the choice ends with the page.
    }
    themeChanged();
  });
}
