/** Hands out the elements of a mesh that stays in the engine. */
import type { EngineClient } from "../engine/engine-client.js";
import type { EngineResult } from "../engine/protocol.js";
import type { ElementBlocks, RegionRun } from "../mesh/element-blocks.js";

/** Returns the elements of the run with this id; undefined if the result has arrays. `indices`: region of the mesh per region of the run. */
export function elementBlocks(
  client: EngineClient,
  run: number,
  { regionRuns, statistics }: Pick<EngineResult, "regionRuns" | "statistics">,
  indices: readonly number[],
): ElementBlocks | undefined {
  if (regionRuns === undefined) return undefined;
  const runs: RegionRun[] = [];
  for (let i = 0; i < regionRuns.length; i += 2) {
    const region = regionRuns[i] ?? 0;
    runs.push({ region: indices[region] ?? region, count: regionRuns[i + 1] ?? 0 });
  }
  const { nodes, tetrahedra } = statistics;
  return {
    nodes,
    tetrahedra,
    regionRuns: runs,
    readPoints: (first, count) => client.read({ run, part: "points", first, last: first + count }),
    readTetrahedra: (first, count) => client.read({ run, part: "tetrahedra", first, last: first + count }),
    release: () => client.release(run),
  };
}
