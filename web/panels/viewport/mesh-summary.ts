import type { MeshResult, Project } from "tetrafront";
import type { QualitySpace } from "../../document/mesh-quality";
import { formatCount } from "../../ui/format";
import { measuredIn, strings } from "../../strings";

/** Returns a sentence about the mesh for the label of the picture. */
export function describeMesh(project: Project, mesh: MeshResult | null, space: QualitySpace | null): string {
  if (!mesh || mesh.report.tetrahedra === 0) return strings.viewport.summaryNoMesh(project.name);
  const { tetrahedra, dihedral, quality } = mesh.report;
  const { min } = space === "metric" ? quality.shapes.dihedral : dihedral;
  const angle = measuredIn(`${min.toFixed(1)}°`, space);
  return strings.viewport.summary(project.name, formatCount(tetrahedra), angle);
}
