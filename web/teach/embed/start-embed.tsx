import "@fontsource-variable/inter/wght.css";
// First of the styles, because it sets the order of the layers.
import "../../ui/theme/base.css";
import "../../ui/theme/component-styles";
import { createRoot } from "react-dom/client";
import { createApp } from "../../app/create-app";
import { addressProblems, showAddressProblems } from "../commands/address-problems";
import { replayOf } from "../commands/replay";
import { showShared } from "../commands/step-links";
import { sharedFrontIn } from "../player/shared-front";
import { shareStrings as texts } from "../strings/share";
import { strings } from "../../strings";
import { ThemeProvider } from "../../ui/theme/theme-provider";
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
      replayOf,
    }));
  const known = app?.gallery.models.find(({ id }) => id === shared?.model);
  if (known) document.title = `${known.title} – Tetrafront`;
  createRoot(root).render(
    <ThemeProvider still={still}>
      {app && known ? (
        <EmbedPage app={app} shared={shared} />
      ) : (
        <div role="alert" data-testid="embed-failure">
          {failureOf(
            query,
            app?.gallery.models.map(({ id }) => id),
          ).map((line) => (
            <p key={line}>{line}</p>
          ))}
        </div>
      )}
    </ThemeProvider>,
  );
  if (!app || !known) return;
  showAddressProblems(app, addressProblems(query));
  await showShared(app, shared);
}

/** Returns why an address names no front. `models`: ids of the models that exist, if the one of the address is not one of them. */
function failureOf(query: URLSearchParams, models: readonly string[] = []): readonly string[] {
  const model = query.get("model");
  if (models.length === 0 || model === null) return [...addressProblems(query), texts.noModel];
  return [strings.messages.unknownExample(model), strings.messages.knownExamples(models)];
}
