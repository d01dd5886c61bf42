import type { App } from "../app/app";
import { hideNotice, showNotice } from "../session/shell";
import type { Improvement } from "../session/shown-mesh";
import { improvementText, strings } from "../strings";
import { showMessage } from "./messages";

/** Meshes the project, and shows the mesh even if other triangles of a body were shown before. */
export function generateMesh(app: App): void {
  app.view.setLayer("mesh", true);
  void app.run.generate();
}

/** Improves the elements of the shown mesh, and reports what was gained. */
export async function improveMesh(app: App): Promise<void> {
  const end = await app.run.improve();
  if (end?.kind === "failed") showMessage(app, strings.messages.notImproved, end.reasons);
  else if (end?.kind === "discarded") {
    showNotice(app.shell, {
      key: "improvement",
      tone: "information",
      text: strings.notices.improvementDiscarded,
      action: { label: strings.notices.understood, run: () => undefined },
    });
  } else if (end?.improvement) showGain(app, end.improvement);
}

function showGain(app: App, improvement: Improvement): void {
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
