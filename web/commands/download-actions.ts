import type { App } from "../app/app";
import { download, fileStem } from "../session/files";
import { strings } from "../strings";
import { overlapDiagnostic } from "../document/validate";
import { writeMeshFiles, type FileChoice } from "../workers/mesh-files";
import { showMessage } from "./messages";

/** `extension`: of a format that the package writes, without its first dot. */
export async function downloadMesh(
  app: App,
  extension: string,
  { elementOrder = 1, unit = null }: Partial<Omit<FileChoice, "fileName">> = {},
): Promise<void> {
  const { mesh } = app.run.state.getState();
  const { project } = app.documents;
  if (!mesh) return;
  try {
    const fileName = `${fileStem(project.name)}.${extension}`;
    // Without faces of a CAD file, all edges are straight.
    const isCurved = elementOrder === 2 && mesh.mesh.trueEdges !== undefined;
    const written = isCurved ? await app.secondOrder.curved(mesh) : mesh;
    const withFields = app.solutions.withFields(written.mesh);
    const files = await writeMeshFiles(withFields, project, { fileName, elementOrder, unit });
    for (const { fileName: name, content } of files) download([content], name, "application/octet-stream");
  } catch (error) {
    showMessage(app, strings.messages.downloadFailed, [String(error)]);
  }
}

/** Saves the report of the shown mesh, with what the preparation of its run has found. */
export function downloadReport(app: App): void {
  const { mesh, outcome } = app.run.state.getState();
  if (!mesh) return;
  const warnings = outcome?.result === mesh ? outcome.warnings.map(overlapDiagnostic) : [];
  const report = { ...mesh.report, diagnostics: [...warnings, ...mesh.report.diagnostics] };
  const text = `${JSON.stringify(report, null, 2)}\n`;
  download([text], `${fileStem(app.documents.project.name)}-report.json`, "application/json");
}
