import {
  fileMeshOf,
  readProject,
  readSurface,
  readVolume,
  writeMesh,
  writeProject,
  type MeshResult,
} from "tetrafront";
import { describe, expect, test } from "vitest";

import { cubeProject } from "../../support/projects.js";
import { objFile, offFile, plyBinary, plyText, stlBinary, stlText } from "../../support/surface-files.js";
import { boxSurface } from "../../support/surfaces.js";

/** A small generator of whole numbers below 2^32, the same on every machine (Marsaglia's xorshift). */
function randomSource(seed: number): () => number {
  let state = seed;
  return () => {
    state ^= state << 13;
    state ^= state >>> 17;
    state ^= state << 5;
    return state >>> 0;
  };
}

/** Some bytes changed, a piece cut out, or a piece repeated. */
function mutated(file: Uint8Array, random: () => number): Uint8Array {
  const at = random() % file.length;
  const length = random() % 40;
  switch (random() % 3) {
    case 0:
      return file.map((byte) => (random() % 50 === 0 ? random() & 255 : byte));
    case 1:
      return Uint8Array.of(...file.subarray(0, at), ...file.subarray(at + length));
    default:
      return Uint8Array.of(...file.subarray(0, at + length), ...file.subarray(at));
  }
}

const text = new TextDecoder();
const cube = boxSurface(2);

describe.each<[string, Uint8Array, string]>([
  ["text STL", stlText(cube), "a.stl"],
  ["binary STL", stlBinary(cube), "a.stl"],
  ["OFF", offFile(cube), "a.off"],
  ["OBJ", objFile(cube), "a.obj"],
  ["text PLY", plyText(cube), "a.ply"],
  ["binary PLY", plyBinary(cube, true), "a.ply"],
])("damaged %s files, seeds 1 to 300,", (_, file, fileName) => {
  test("give a surface that holds together or a problem with a remedy", async () => {
    for (let seed = 1; seed <= 300; seed++) {
      const result = await readSurface(mutated(file, randomSource(seed)), { fileName });
      if (result.success) {
        const { points, triangles } = result.value;
        expect([points.length % 3, triangles.length % 3]).toEqual([0, 0]);
        expect(triangles.every((node) => node < points.length / 3)).toBe(true);
      } else {
        expect(result.problems[0].message, `seed ${seed}`).toMatch(/\S/);
        expect(result.problems[0].remedy, `seed ${seed}`).toMatch(/\.$/);
      }
    }
  });
});

test("damaged projects, seeds 1 to 300, are read or refused with a remedy", () => {
  const file = new TextEncoder().encode(writeProject(cubeProject()));
  let refused = 0;
  for (let seed = 1; seed <= 300; seed++) {
    const result = readProject(text.decode(mutated(file, randomSource(seed))));
    if (result.success) continue;
    refused++;
    for (const { message, remedy } of result.problems) {
      expect(message, `seed ${seed}`).toMatch(/\S/);
      expect(remedy, `seed ${seed}`).toMatch(/\.$/);
    }
  }
  expect(refused).toBeGreaterThan(200);
});

/** A surface and a volume with nothing but what the writers need. */
const block: Pick<MeshResult, "surface" | "volume"> = {
  surface: {
    ...cube,
    trianglePatch: new Uint32Array(cube.triangles.length / 3),
    sides: new Uint32Array(),
    sideLine: new Uint32Array(),
  },
  volume: {
    points: cube.points,
    tetrahedra: Uint32Array.from({ length: 40 }, (_, i) => (7 * i) % (cube.points.length / 3)),
    regions: new Uint32Array(10),
    front: new Uint32Array(),
  },
};
/** As programs other than this one write it: in words, which damage turns into other words. */
const textVtu = `<VTKFile type="UnstructuredGrid" byte_order="LittleEndian"><Piece NumberOfPoints="4" NumberOfCells="1">
<Points><DataArray type="Float64" format="ascii">0 0 0 1 0 0 0 1 0 0 0 1</DataArray></Points><Cells>
<DataArray type="Int32" Name="connectivity" format="binary">EAAAAAAAAAABAAAAAgAAAAMAAAA=</DataArray>
<DataArray type="Int32" Name="offsets" format="ascii">4</DataArray>
<DataArray type="UInt8" Name="types" format="ascii">10</DataArray></Cells></Piece></VTKFile>`;
const textMsh = `$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n1 4 1 4\n3 1 0 4\n1\n2\n3\n4\n0 0 0\n1 0 0\n0 1 0\n0 0 1
$EndNodes\n$Elements\n1 1 1 1\n3 1 4 1\n1 1 2 3 4\n$EndElements\n$NodeData\n1\n"size"\n1\n0.0\n3\n0\n1\n1\n1 0.5\n$EndNodeData\n`;
const encoded = (file: string) => new TextEncoder().encode(file);

/** The bytes of the block in a format. */
async function blockAs(fileName: string): Promise<Uint8Array> {
  const [file] = await writeMesh(fileMeshOf(block), fileName);
  return file?.bytes ?? new Uint8Array();
}

describe.each<[string, string, () => Promise<Uint8Array>]>([
  ["raw VTU", "a.vtu", () => blockAs("a.vtu")],
  ["text VTU", "a.vtu", () => Promise.resolve(encoded(textVtu))],
  ["binary MSH", "a.msh", () => blockAs("a.msh")],
  ["text MSH", "a.msh", () => Promise.resolve(encoded(textMsh))],
])("damaged %s files, seeds 1 to 300,", (_, fileName, fileOf) => {
  test("give tetrahedra of nodes that are there or a problem with a remedy", async () => {
    const file = await fileOf();
    expect((await readVolume(file, { fileName })).success).toBe(true);
    for (let seed = 1; seed <= 300; seed++) {
      const result = await readVolume(mutated(file, randomSource(seed)), { fileName });
      if (result.success) {
        const { points, tetrahedra, nodeData } = result.value;
        expect([points.length % 3, tetrahedra.length % 4]).toEqual([0, 0]);
        expect(points.every(Number.isFinite)).toBe(true);
        expect(tetrahedra.every((node) => node < points.length / 3)).toBe(true);
        for (const { components, values } of nodeData.values()) {
          expect(values.length).toBe((components * points.length) / 3);
        }
      } else {
        expect(result.problems[0].message, `seed ${seed}`).toMatch(/\S/);
        expect(result.problems[0].remedy, `seed ${seed}`).toMatch(/\.$/);
      }
    }
  });
});
