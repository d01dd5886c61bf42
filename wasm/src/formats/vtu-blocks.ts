/** Writes VTU, as vtu.ts does, of a mesh whose elements are handed out in blocks: the same bytes. */
import { inPieces } from "../base/steps.js";
import { pointsIn, regionInRuns, tetrahedraIn, withExamples } from "./blocks.js";
import type { Part } from "./bytes.js";
import type { BlockedMesh, Note } from "./file-format.js";
import type { Spool } from "./spool.js";
import { type CellValues, vtkCellData } from "./vtk.js";
import { ArrayPacker, type PackedArray, VTU_ARRAYS, vtuFile } from "./vtu.js";

/** Yields the content of a VTU file. */
export async function* writeVtuBlocks(
  { mesh, blocks }: BlockedMesh,
  note: Note,
  createSpool: () => Spool,
): AsyncGenerator<Part, void> {
  const spool = createSpool();
  try {
    const tets = blocks.tetrahedra;
    const { count, types, regions, patches } = vtkCellData(mesh, tets, regionInRuns(blocks));
    const perCell = (values: CellValues, pack = (own: Int32Array): ArrayBufferView => own) =>
      inPieces(count, (begin, end) => pack(values(begin, end)));
    const offsets: CellValues = (begin, end) =>
      Int32Array.from({ length: end - begin }, (_, c) => {
        const cells = begin + c + 1;
        return 4 * Math.min(cells, tets) + 3 * Math.max(cells - tets, 0);
      });
    const packed = new Map<{ readonly attributes: string }, PackedArray>();
    const pack = async (
      attributes: string,
      values: AsyncIterable<ArrayBufferView> | Iterable<ArrayBufferView>,
    ) => {
      const packer = new ArrayPacker(spool);
      for await (const block of values) packer.add(block);
      packed.set({ attributes }, packer.end());
    };
    await pack(VTU_ARRAYS.patch, perCell(patches));
    await pack(VTU_ARRAYS.region, perCell(regions));
    await pack(
      VTU_ARRAYS.types,
      perCell(types, (own) => Uint8Array.from(own)),
    );
    await pack(VTU_ARRAYS.offsets, perCell(offsets));
    await pack(VTU_ARRAYS.connectivity, connectivity({ mesh, blocks }));
    await pack(VTU_ARRAYS.points, pointsIn(blocks));
    yield* vtuFile({ mesh: withExamples(mesh), nodes: blocks.nodes, cells: count, note }, packed, spool, 0);
  } finally {
    spool.close();
  }
}

async function* connectivity({ mesh, blocks }: BlockedMesh): AsyncGenerator<Uint32Array, void> {
  yield* tetrahedraIn(blocks);
  yield mesh.triangles;
}
