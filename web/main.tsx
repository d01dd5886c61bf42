import "@fontsource-variable/inter/wght.css";
// First of the styles, because it sets the order of the layers.
import "./ui/theme/base.css";
import "./ui/theme/component-styles";
import "@mantine/spotlight/styles.layer.css";
import { createRoot } from "react-dom/client";
import { createApp, type Intent, type Start } from "./app/create-app";
import { showFailure } from "./commands/messages";
import { offerLeftDocument } from "./commands/project-actions";
import type { DrawnKind } from "./document/entities";
import { Page } from "./panels/page/page";
import { strings } from "./strings";
import { replayOf, teachingAddress, teachingSlots } from "./teach/teach";
import { listenForPalette } from "./panels/shared/palette";
import { ThemeProvider } from "./ui/theme/theme-provider";

listenForPalette();

const query = new URLSearchParams(window.location.search);
const still = query.get("test") === "1";
// Loaded only for a link with a project in it.
const linked = window.location.hash.startsWith("#project=")
  ? await import("./commands/project-link").then(({ linkedIn }) => linkedIn(window.location.hash))
  : null;
const teaching = teachingAddress(query, linked !== null);
const app = await createApp({
  autosave: "main",
  generate: true,
  intent: linked?.kind === "linked" ? { kind: "project", project: linked.linked.project } : intentOf(query),
  showsFront: teaching.showsFront || (linked?.kind === "linked" && linked.linked.front !== null),
  still,
  replayOf,
});

offerLeftDocument(app);

/** Shows what the address asks for, or says why it cannot. */
function follow(work: Promise<unknown>): void {
  work.catch((error: unknown) => showFailure(app, strings.messages.addressFailed, error));
}

const sharing = () => import("./commands/share-actions");
if (linked) {
  follow(
    sharing().then(async ({ removeLink, showLinked, showLinkFailure }) => {
      if (linked.kind !== "linked") showLinkFailure(app, linked);
      await Promise.all([
        removeLink(app),
        linked.kind === "linked" ? showLinked(app, linked.linked) : undefined,
      ]);
    }),
  );
}
window.addEventListener("hashchange", () => {
  follow(sharing().then(({ openLink }) => openLink(app, window.location.hash)));
});

void import("./commands/document-pictures")
  .then(({ keepPictures }) => keepPictures(app))
  .catch(() => undefined);
void import("./commands/offline-actions")
  .then(({ followOffline }) => followOffline(app))
  .catch(() => undefined);

/**
 * The address selects the document to open, `model=ID` or `new=1`, but a reload continues with the document as it was
 * before the reload.
 */
function intentOf(query: URLSearchParams): Intent {
  const [navigation] = performance.getEntriesByType("navigation") as PerformanceNavigationTiming[];
  const start = startOf(query);
  if (start && navigation?.type === "navigate") return start;
  return { kind: "continue", otherwise: start };
}

function startOf(query: URLSearchParams): Start | null {
  if (query.get("new") === "1") return { kind: "new" };
  const model = query.get("model");
  return model === null ? null : { kind: "model", id: model };
}

follow(teaching.follow(app));

if (still) {
  // For tests: returns where a position, or the middle of an entity, appears in the view.
  Object.assign(window, {
    tetrafrontPosition: (position: readonly [number, number, number]) =>
      app.viewer.getState().viewer?.toScreen(position) ?? null,
    tetrafrontProject: (kind: DrawnKind, id: number) =>
      app.viewer.getState().viewer?.entityOnScreen({ kind, id }) ?? null,
  });
}

const root = document.getElementById("root");
if (root) {
  createRoot(root).render(
    <ThemeProvider still={still}>
      <Page app={app} slots={teachingSlots} />
    </ThemeProvider>,
  );
}
