import type { ProjectBackground } from "tetrafront/project";
import { prepareKeys } from "./content-keys";
import { unpackGrid, type PackedGrid } from "./packed-grid";

/**
 * Unpacks a grid in slices and hashes its lists, so that opening a project with this grid afterwards takes no
 * time, even if the grid is large.
 */
export async function documentGrid(
  grid: PackedGrid,
): Promise<Pick<ProjectBackground, "nodes" | "tetrahedra">> {
  const lists = await unpackGrid(grid);
  await prepareKeys(lists);
  return lists;
}
