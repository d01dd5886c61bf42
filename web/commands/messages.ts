import type { App } from "../app/app";
import { showNotice } from "../session/shell";
import { strings } from "../strings";

/** Opens a dialog with a title and a list of sentences. */
export function showMessage(app: Pick<App, "shell">, title: string, lines: readonly string[]): void {
  app.shell.setState({ message: { title, lines } });
}

/** Opens a dialog with the reason of a failure. */
export function showFailure(app: App, title: string, error: unknown): void {
  showMessage(app, title, [error instanceof Error ? error.message : String(error)]);
}

/** Says beside the work why a command cannot do anything now, for example what to select first. A dialog would stop the work. */
export function showRefusal(app: Pick<App, "shell">, title: string, reason: string): void {
  showNote(app, `${title.replace(/…$/, "")}: ${reason}`);
}

/** Shows what an edit has done beside what was asked for. */
export function showNote(app: Pick<App, "shell">, text: string): void {
  const action = { label: strings.notices.understood, run: () => undefined };
  showNotice(app.shell, { key: "note", tone: "information", text, action });
}
