import type { BackgroundArrays } from "tetrafront";
import type { Project } from "tetrafront/project";
import { engineGrid } from "./packed-grid";

/** Above this many tetrahedra a background grid goes to the engine as flat arrays. */
export const manyTetrahedra = 2000;

/**
 * Returns a project in the form that the engine accepts fastest, with the matching options. A project is
 * checked node by node; flat arrays are not. With a uniform size, a large grid is left out; its sources still
 * apply.
 */
export function engineInput(project: Project): [Project, { readonly background?: BackgroundArrays }] {
  const { background, meshing } = project;
  if (background.tetrahedra.length <= manyTetrahedra) return [project, {}];
  const rest = { nodes: [], tetrahedra: [], ...(background.sources && { sources: background.sources }) };
  const drawn = { ...project, background: rest };
  return meshing?.size === undefined ? [drawn, { background: engineGrid(background) }] : [drawn, {}];
}
