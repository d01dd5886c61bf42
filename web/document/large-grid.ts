import type { ProjectBackground } from "tetrafront";
import { prepareKeys } from "./content-keys";
import { unpackGrid, type PackedGrid } from "./packed-grid";

/**
 * A grid as the document has it, with everything known of it that a look at each node or tetrahedron finds: what
 * opens it afterwards is done at once, whatever its size. The page goes on in between.
 */
export async function documentGrid(
  grid: PackedGrid,
): Promise<Pick<ProjectBackground, "nodes" | "tetrahedra">> {
  const lists = await unpackGrid(grid);
  await prepareKeys(lists);
  return lists;
}
