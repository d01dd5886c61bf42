import "@fontsource-variable/inter/wght.css";
import "@mantine/core/styles.css";
import "@mantine/spotlight/styles.css";
import "./ui/styles/index.css";
import { MantineProvider } from "@mantine/core";
import { createRoot } from "react-dom/client";
import { createApp } from "./app/app";
import { entityBounds } from "./viewer/bounds";
import { findRecord, type DrawnKind } from "./document/entities";
import { Page } from "./panels/page";
import { listenForPalette } from "./panels/palette";
import { cssVariables, theme } from "./ui/theme";

listenForPalette();

const query = new URLSearchParams(window.location.search);
const still = query.get("test") === "1";
const app = await createApp(still, query.get("model"));

if (still) {
  // For tests: where a place, a point or background node, or the middle of a line or patch, is on the screen.
  Object.assign(window, {
    tetrafrontPlace: (place: readonly [number, number, number]) =>
      app.viewer.getState().viewer?.toScreen(place) ?? null,
    tetrafrontProject: (kind: DrawnKind, id: number) => {
      const { viewer } = app.viewer.getState();
      const { project } = app.documents;
      if (!viewer || !findRecord(project, kind, id)) return null;
      return viewer.toScreen(
        entityBounds({ kind, id }, project, app.previews.state.getState().preview).centre,
      );
    },
  });
}

const root = document.getElementById("root");
if (root) {
  createRoot(root).render(
    <MantineProvider
      theme={theme}
      cssVariablesResolver={cssVariables}
      defaultColorScheme="auto"
      env={still ? "test" : "default"}
    >
      <Page app={app} />
    </MantineProvider>,
  );
}
void app.run.generate();
