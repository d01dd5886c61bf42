import "@fontsource-variable/inter/wght.css";
// First of the styles, because it sets the order of the layers.
import "../../ui/theme/base.css";
import "@mantine/core/styles.layer.css";
import { MantineProvider } from "@mantine/core";
import { createRoot } from "react-dom/client";
import { createApp } from "../../app/create-app";
import { showShared } from "../../commands/share-actions";
import { sharedFrontIn } from "../../player/shared-front";
import { shareStrings as texts } from "../../strings/share";
import { cssVariables, theme } from "../../ui/theme/theme";
import { EmbedPage } from "./embed-page";

/** Shows the front that the parameters of the address name, or why they name none. */
export async function startEmbed(root: HTMLElement, query: URLSearchParams): Promise<void> {
  const still = query.get("test") === "1";
  const shared = sharedFrontIn(query);
  const app =
    shared &&
    (await createApp({
      autosave: null,
      generate: false,
      intent: { kind: "model", id: shared.model },
      still,
    }));
  const known = app?.gallery.models.find(({ id }) => id === shared?.model);
  if (known) document.title = `${known.title} – Tetrafront`;
  createRoot(root).render(
    <MantineProvider
      theme={theme}
      cssVariablesResolver={cssVariables}
      defaultColorScheme="auto"
      env={still ? "test" : "default"}
    >
      {app && known ? (
        <EmbedPage app={app} shared={shared} />
      ) : (
        <p role="alert" data-testid="embed-failure">
          {texts.noModel}
        </p>
      )}
    </MantineProvider>,
  );
  if (app && known) await showShared(app, shared);
}
