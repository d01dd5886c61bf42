import type { Project } from "tetrafront/project";
import type { RunState } from "../../session/run-state";
import { cancelledText } from "../../session/run-log";
import type { QualitySpace } from "../../document/mesh-quality";
import { formatCount } from "../../strings/format";
import { measuredIn, strings } from "../../strings";

/** Returns a sentence about the mesh for the label of the picture. */
export function describeMesh(
  project: Project,
  { mesh, outcome }: Pick<RunState, "mesh" | "outcome">,
  space: QualitySpace | null,
): string {
  if (!mesh || mesh.report.tetrahedra === 0) return strings.viewport.summaryNoMesh(project.name);
  const cancelled = cancelledText({ mesh, outcome });
  if (cancelled !== null) return strings.viewport.summaryCancelled(project.name, cancelled);
  const { tetrahedra, dihedral, quality } = mesh.report;
  const { min } = space === "metric" ? quality.shapes.dihedral : dihedral;
  const angle = measuredIn(`${min.toFixed(1)}°`, space);
  return strings.viewport.summary(project.name, formatCount(tetrahedra), angle);
}
