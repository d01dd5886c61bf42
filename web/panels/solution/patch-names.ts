import type { MeshGroup } from "tetrafront";
import { patchNames } from "tetrafront/internal";
import type { Project } from "tetrafront/project";

/** Returns the names of the patches of a mesh, or of the model before there is one; each once. */
export function patchNamesOf(project: Project, patches: readonly MeshGroup[] | undefined): readonly string[] {
  const names = patches?.map(({ name }) => name) ?? patchNames(project);
  return [...new Set(names)];
}
