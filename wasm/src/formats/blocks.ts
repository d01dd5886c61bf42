/** What writers of meshes share whose elements are handed out in blocks. */
import type { ElementBlocks } from "../mesh/element-blocks.js";
import type { Mesh } from "../mesh/mesh.js";
import { NO_REGION } from "../generated/constants.js";
import type { BlockedMesh, Note } from "./file-format.js";
import { fitToFormat, type FormatLimits } from "./format-limits.js";

/** Number of nodes or tetrahedra that are read at once. */
const BLOCK = 1 << 16;

/** Yields the nodes of the tetrahedra from `begin` to `end` - 1, in blocks. */
export async function* tetrahedraIn(
  blocks: ElementBlocks,
  begin = 0,
  end = blocks.tetrahedra,
): AsyncGenerator<Uint32Array, void> {
  yield* ahead(begin, end, blocks.readTetrahedra);
}

/** Yields x y z of all nodes, in blocks. */
export async function* pointsIn({ nodes, readPoints }: ElementBlocks): AsyncGenerator<Float64Array, void> {
  yield* ahead(0, nodes, readPoints);
}

/** Reads each block while the one before is used: the engine has a thread of its own. */
async function* ahead<Values>(
  begin: number,
  end: number,
  read: (first: number, count: number) => Promise<Values>,
): AsyncGenerator<Values, void> {
  const next = (first: number) => (first < end ? read(first, Math.min(BLOCK, end - first)) : undefined);
  let waiting = next(begin);
  // The block may be rejected while the one before is used.
  for (let first = begin; waiting !== undefined; first += BLOCK) {
    const block = await waiting;
    waiting = next(first + BLOCK);
    waiting?.catch(() => undefined);
    yield block;
  }
}

/** Returns the region of each tetrahedron; calls must ascend. */
export function regionInRuns({ regionRuns }: ElementBlocks): (tetrahedron: number) => number {
  let [run, end] = [-1, 0];
  return (tetrahedron) => {
    while (tetrahedron >= end && run + 1 < regionRuns.length) end += regionRuns[++run]?.count ?? 0;
    return regionRuns[run]?.region ?? 0;
  };
}

/**
 * Returns the mesh with a degenerate tetrahedron on each side of a triangle that a region sees. From them, writers learn which regions
 * are in use, and between which positions they lie.
 */
export function withExamples(mesh: Mesh): Mesh {
  const { triangles, triangleRegions = new Uint32Array() } = mesh;
  const tetrahedronRegion = triangleRegions.filter((region) => region !== NO_REGION);
  const tetrahedra = new Uint32Array(4 * tetrahedronRegion.length);
  let end = 0;
  triangleRegions.forEach((region, half) => {
    if (region === NO_REGION) return;
    const first = 3 * (half >> 1);
    tetrahedra.set(triangles.subarray(first, first + 3), end);
    tetrahedra[end + 3] = triangles[first] ?? 0;
    end += 4;
  });
  return { ...mesh, tetrahedra, tetrahedronRegion };
}

/** Returns the mesh as the format can store it. */
export function fitBlocksToFormat(blocked: BlockedMesh, limits: FormatLimits, note: Note): BlockedMesh {
  const { patches, regions } = fitToFormat(withExamples(blocked.mesh), limits, note);
  return { mesh: { ...blocked.mesh, patches, regions }, blocks: blocked.blocks };
}
