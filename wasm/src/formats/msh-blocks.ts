/** Writes Gmsh MSH 4.1, as msh.ts does, of a mesh whose elements are handed out in blocks: the same bytes. */
import { inSteps } from "../calls/yielder.js";
import type { ElementBlocks } from "../mesh/element-blocks.js";
import { pointsIn, tetrahedraIn, withExamples } from "./blocks.js";
import type { Part } from "./bytes.js";
import type { BlockedMesh, Note } from "./file-format.js";
import { countIn, elementCount, elementRows, entityElements, mshHead, nodeTags } from "./msh.js";

/** Yields the content of an MSH file. */
export async function* writeMshBlocks({ mesh, blocks }: BlockedMesh, note: Note): AsyncGenerator<Part, void> {
  const { groups, head } = await inSteps(mshHead(withExamples(mesh), note));
  yield [...head, nodeTags(blocks.nodes, groups)];
  for await (const points of pointsIn(blocks)) yield points;
  yield "\n$EndNodes\n$Elements\n";
  // Volumes follow the surfaces in the order of the regions in use.
  const regions = [...new Set(blocks.regionRuns.map(({ region }) => region))].sort((a, b) => a - b);
  const surfaces = groups.length - regions.length;
  const counts = groups.map((group, g) =>
    g < surfaces ? countIn(group) : countOf(blocks, regions[g - surfaces] ?? 0),
  );
  yield elementCount(counts);
  let tag = 1;
  for (const [g, group] of groups.entries()) {
    const count = counts[g] ?? 0;
    yield entityElements(group, count);
    if (g < surfaces) yield elementRows(group, group.nodes, tag);
    else
      yield* rowsOfRegion(blocks, regions[g - surfaces] ?? 0, (nodes, from) =>
        elementRows(group, nodes, tag + from),
      );
    tag += count;
  }
  yield "\n$EndElements\n";
}

function countOf({ regionRuns }: ElementBlocks, region: number): number {
  return regionRuns.reduce((sum, run) => sum + (run.region === region ? run.count : 0), 0);
}

/** Yields the rows of the tetrahedra of a region. `rows`: returns those of some, of which the first has this number in the region. */
async function* rowsOfRegion(
  blocks: ElementBlocks,
  region: number,
  rows: (nodes: Uint32Array, from: number) => Part,
): AsyncGenerator<Part, void> {
  let [first, from] = [0, 0];
  for (const { region: own, count } of blocks.regionRuns) {
    if (own === region) {
      for await (const nodes of tetrahedraIn(blocks, first, first + count)) {
        yield rows(nodes, from);
        from += nodes.length / 4;
      }
    }
    first += count;
  }
}
