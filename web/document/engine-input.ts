import type { BackgroundArrays, Project } from "tetrafront";
import { engineGrid } from "./packed-grid";

/** Above this many tetrahedra a background grid goes to the engine as flat arrays. */
export const manyTetrahedra = 2000;

/**
 * What the engine is to look at, and with which options. A project is looked through node by node, flat arrays
 * are not. Where one size holds everywhere the grid stays behind; sources hold all the same.
 */
export function engineInput(project: Project): [Project, { readonly background?: BackgroundArrays }] {
  const { background, meshing } = project;
  if (background.tetrahedra.length <= manyTetrahedra) return [project, {}];
  const rest = { nodes: [], tetrahedra: [], ...(background.sources && { sources: background.sources }) };
  const drawn = { ...project, background: rest };
  return meshing?.size === undefined ? [drawn, { background: engineGrid(background) }] : [drawn, {}];
}
