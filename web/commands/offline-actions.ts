import type { App } from "../app/app";
import { keepEverything, workOffline } from "../session/offline";
import { hideNotice, showNotice } from "../session/shell";
import { untilState } from "../session/until-state";
import { offlineStrings as texts } from "../strings/passing";
import { showFailure } from "./messages";

const information = {
  tone: "information",
  action: { label: texts.understood, run: () => undefined },
} as const;

/** Keeps the whole site in the browser, and says when it is there. */
export async function keepOffline(app: App): Promise<void> {
  const note = (text: string): void => showNotice(app.shell, { key: "offline", text, ...information });
  note(texts.keeping);
  const kept = await keepEverything();
  if (kept.kind === "kept") return note(texts.kept(kept.bytes));
  hideNotice(app.shell, "offline");
  showFailure(app, texts.notKept, navigator.onLine ? kept.reason : texts.noNetwork);
}

/** Leaves the connection and the processor to the first picture and the first mesh, in milliseconds; longer to tests. */
const calmMs = { usual: 1500, still: 8000 } as const;

/** Makes the site work without a network after this visit. A new version is offered, never forced. */
export async function followOffline(app: App): Promise<void> {
  await untilState(app.run.state, ({ busy }) => !busy);
  await new Promise((resolve) => setTimeout(resolve, app.still ? calmMs.still : calmMs.usual));
  await workOffline((reload) => {
    showNotice(app.shell, {
      key: "update",
      // Warnings stay.
      tone: "warning",
      text: texts.update,
      action: {
        label: texts.reload,
        run: () => void Promise.resolve(app.autosave?.flush()).then(reload),
      },
    });
  });
}
