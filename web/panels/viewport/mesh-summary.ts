import type { MeshResult, Project } from "tetrafront";
import { formatCount } from "../../ui/format";
import { strings } from "../../strings";

/** Returns a sentence about the mesh for the label of the picture. */
export function describeMesh(project: Project, mesh: MeshResult | null): string {
  if (!mesh || mesh.report.tetrahedra === 0) return strings.viewport.summaryNoMesh(project.name);
  const { tetrahedra, dihedral } = mesh.report;
  return strings.viewport.summary(project.name, formatCount(tetrahedra), `${dihedral.min.toFixed(1)}°`);
}
