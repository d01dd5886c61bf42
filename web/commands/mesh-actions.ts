import type { App } from "../app/app";
import { hideNotice, showNotice } from "../session/shell";
import { improvementText, strings } from "../strings";
import { showMessage } from "./messages";

/** Improves the elements of the shown mesh, and reports what was gained. */
export async function improveMesh(app: App): Promise<void> {
  const reasons = await app.run.improve();
  if (reasons) {
    showMessage(app, strings.messages.notImproved, reasons);
    return;
  }
  const { improvement } = app.run.state.getState();
  if (!improvement) return;
  hideNotice(app.shell, "file-notes");
  showNotice(app.shell, {
    key: "improvement",
    tone: "information",
    text: improvementText(improvement),
    action: {
      label: strings.notices.showQuality,
      run: () => app.shell.setState({ rightTab: "quality", drawer: "right" }),
    },
  });
}
