/** Damaged files of every readable format: the result is a consistent mesh, or an error with a remedy. */
import {
  FILE_FORMATS,
  formatOf,
  readMesh,
  readSurface,
  writeMesh,
  type ByteSource,
  type Mesh,
} from "tetrafront";
import { readProject, writeProject } from "tetrafront/project";
import { describe, expect, test } from "vitest";

import { blockMesh } from "../../support/block-mesh.js";
import { vtkBinary } from "../../support/mesh-files.js";
import { cubeProject } from "../../support/projects.js";
import { mutated, randomSource } from "../../support/random.js";
import { offBinary, offFile, plyBinary, plyStrips, stlText } from "../../support/surface-files.js";
import { boxSurface } from "../../support/surfaces.js";
import { meshTags, threeMfFile } from "../../support/threemf-files.js";

/** Damaged files per format, divided equally among its samples. */
const SEEDS = Number(process.env["TETRAFRONT_FUZZ"] ?? 400);
/**
 * Limit of the memory that reading may allocate in arrays: a constant plus an amount per byte of the file.
 * docs/FORMAT.md promises these values.
 */
const BASE_BYTES = 4 << 20;
const BYTES_PER_FILE_BYTE = 300;

const mesh = blockMesh(1);
const cube = boxSurface(1);
const encoded = (file: string) => new TextEncoder().encode(file);

async function written(fileName: string): Promise<Map<string, Uint8Array>> {
  return new Map((await writeMesh(mesh, fileName)).map((file) => [file.fileName, file.bytes]));
}

/** Text files as other programs write them: damage turns their words into other words. */
const textVtu = `<VTKFile type="UnstructuredGrid" byte_order="LittleEndian"><Piece NumberOfPoints="4" NumberOfCells="2">
<Points><DataArray type="Float64" format="ascii">0 0 0 1 0 0 0 1 0 0 0 1</DataArray></Points><Cells>
<DataArray type="Int32" Name="connectivity" format="binary">HAAAAAAAAAABAAAAAgAAAAMAAAAAAAAAAQAAAAIAAAA=</DataArray>
<DataArray type="Int32" Name="offsets" format="ascii">4 7</DataArray>
<DataArray type="UInt8" Name="types" format="ascii">10 5</DataArray></Cells>
<PointData><DataArray type="Float32" Name="size" format="ascii">1 2 3 4</DataArray></PointData>
<CellData><DataArray type="Int64" Name="patch" format="ascii">1 2</DataArray></CellData></Piece></VTKFile>`;
const textVtp = `<VTKFile type="PolyData" byte_order="LittleEndian"><Piece NumberOfPoints="4" NumberOfPolys="1">
<Points><DataArray type="Float64" format="ascii">0 0 0 1 0 0 1 1 0 0 1 0</DataArray></Points>
<Strips><DataArray type="Int32" Name="connectivity" format="ascii">0 1 2 3</DataArray>
<DataArray type="Int32" Name="offsets" format="ascii">4</DataArray></Strips>
<Polys><DataArray type="Int32" Name="connectivity" format="ascii">0 1 2 3</DataArray>
<DataArray type="Int32" Name="offsets" format="ascii">4</DataArray></Polys></Piece></VTKFile>`;
const textVtk = `# vtk DataFile Version 5.1\nmade by a test\nASCII\nDATASET UNSTRUCTURED_GRID
POINTS 4 float\n0 0 0 1 0 0 0 1 0 0 0 1\nCELLS 3 7\nOFFSETS vtktypeint64\n0 4 7
CONNECTIVITY vtktypeint64\n0 1 2 3 0 1 2\nCELL_TYPES 2\n10 5\nCELL_DATA 2
FIELD FieldData 1\npatch 1 2 int\n1 2\nPOINT_DATA 4\nSCALARS size double 1\nLOOKUP_TABLE default\n1 2 3 4\n`;
const textMsh = `$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n2 5 "wall"\n$EndPhysicalNames
$Entities\n0 0 1 1\n1 0 0 0 1 1 0 1 5 0\n1 0 0 0 1 1 1 0 0\n$EndEntities
$Nodes\n1 4 1 4\n3 1 0 4\n1\n2\n3\n4\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n$EndNodes
$Elements\n2 2 1 2\n2 1 2 1\n1 1 2 3\n3 1 4 1\n2 1 2 3 4\n$EndElements
$NodeData\n1\n"size"\n1\n0.0\n3\n0\n1\n1\n1 0.5\n$EndNodeData
$ElementData\n1\n"p"\n1\n0.0\n3\n0\n1\n2\n1 0.25\n2 0.5\n$EndElementData\n`;
const textMsh2 = `$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n$EndNodes
$Elements\n2\n1 2 2 5 1 1 2 3\n2 4 2 0 1 1 2 3 4\n$EndElements
$ElementData\n1\n"p"\n1\n0.0\n3\n0\n1\n2\n1 0.25\n2 0.5\n$EndElementData\n`;
const smesh = `# a square\n4 3 0 0\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n2 1\n4 1 2 3 4 7\n3 1 2 3 8\n0\n0\n`;
const poly = `4 3 0 0\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n1 1\n2 0 3\n4 1 2 3 4\n2 1 3\n0\n`;

const polygonObj = `mtllib a.mtl\no part\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv .2 .2 0\nvt 0 0\nvn 0 0 1\nusemtl red
f 1/1/1 2/1/1 3/1/1 4/1/1\ng top\nf -5//1 -4//1 \\\n-3//1 -1//1\nl 1 2\n`;

const colouredOff = new TextDecoder()
  .decode(offFile(cube))
  .replace(/^3 .*$/gm, (face) => `${face} 255 128 0`);

/** The other files of the sample by name; they are not damaged. */
type Others = ReadonlyMap<string, Uint8Array>;
type Sample = readonly [string, string, () => Promise<readonly [Uint8Array, Others]>];

const sample = (title: string, fileName: string, file: Uint8Array | string): Sample => [
  title,
  fileName,
  () => Promise.resolve([typeof file === "string" ? encoded(file) : file, new Map()]),
];
const own = (title: string, fileName: string, writtenAs = fileName): Sample => [
  title,
  fileName,
  async () => {
    const files = await written(writtenAs);
    return [files.get(fileName) ?? new Uint8Array(), files];
  },
];

const samples: readonly Sample[] = [
  sample("text STL", "a.stl", stlText(cube)),
  own("binary STL", "a.stl"),
  sample("OFF with colours", "a.off", colouredOff),
  sample("binary OFF", "a.off", offBinary(cube, "COFF", 4)),
  own("OBJ", "a.obj"),
  sample("OBJ with normals, groups and polygons", "a.obj", polygonObj),
  own("text PLY", "a.ply"),
  sample("binary PLY", "a.ply", plyBinary(cube, true)),
  sample("binary PLY, high byte first", "a.ply", plyBinary(cube, false)),
  sample("PLY of strips", "a.ply", plyStrips([0, 1, 2, 3, -1, 3, 2, 4], false)),
  own("compressed VTU", "a.vtu"),
  sample("text VTU", "a.vtu", textVtu),
  sample(
    "VTP in two pieces",
    "a.vtp",
    textVtp.replace(/<Piece.*<\/Piece>/s, (piece) => piece + piece),
  ),
  sample("binary VTK", "a.vtk", vtkBinary(mesh.points, mesh.tetrahedra)),
  own("text VTK of version 3", "a.vtk"),
  sample("text VTK of version 5", "a.vtk", textVtk),
  own("binary MSH 4.1", "a.msh"),
  sample("text MSH 4.1", "a.msh", textMsh),
  own("binary MSH 2.2", "a.msh2"),
  sample("text MSH 2.2", "a.msh", textMsh2),
  own("Medit", "a.mesh"),
  own("binary Medit", "a.meshb"),
  own("TetGen nodes", "a.node"),
  own("TetGen elements", "a.ele"),
  own("TetGen faces", "a.face", "a.node"),
  sample("3MF", "a.3mf", threeMfFile(`<object id="1">${meshTags(cube)}</object>`, `<item objectid="1"/>`)),
  sample("TetGen .smesh", "a.smesh", smesh),
  sample("TetGen .poly", "a.poly", poly),
];

test("every readable format has a sample, except those of CAD files, which have tests of their own", () => {
  const damaged = new Set(samples.map(([, fileName]) => formatOf(fileName)?.id));
  const missing = FILE_FORMATS.filter(({ readable, id }) => readable.length > 0 && !damaged.has(id));
  expect(missing.filter(({ isCad }) => isCad !== true)).toEqual([]);
});

/** Returns the bytes of the arrays allocated while a function runs. */
async function allocatedBy(run: () => Promise<void>): Promise<number> {
  const originals = { Float64Array, Uint32Array, Uint8Array };
  let bytes = 0;
  for (const [name, Original] of Object.entries(originals)) {
    const construct = (target: typeof Uint8Array, args: never[], newTarget: () => void): object => {
      const made = Reflect.construct(target, args, newTarget) as Uint8Array;
      if (typeof args[0] === "number") bytes += made.byteLength;
      return made;
    };
    Object.assign(globalThis, { [name]: new Proxy(Original as typeof Uint8Array, { construct }) });
  }
  try {
    await run();
  } finally {
    Object.assign(globalThis, originals);
  }
  return bytes;
}

function isConsistent(read: Mesh): boolean {
  const count = read.points.length / 3;
  return (
    Number.isInteger(count) &&
    read.points.every(Number.isFinite) &&
    read.triangles.length === 3 * read.trianglePatch.length &&
    read.tetrahedra.length === 4 * read.tetrahedronRegion.length &&
    read.triangles.every((node) => node < count) &&
    read.tetrahedra.every((node) => node < count) &&
    read.trianglePatch.every((patch) => patch < read.patches.length) &&
    read.tetrahedronRegion.every((region) => region < read.regions.length) &&
    [...read.nodeData.values()].every(({ components, values }) => values.length === components * count)
  );
}

const seedsOf = (fileName: string) => {
  const ofFormat = samples.filter(([, other]) => formatOf(other) === formatOf(fileName));
  return Math.ceil(SEEDS / ofFormat.length);
};

describe.each(samples)("%s", (_, fileName, load) => {
  test("with any damage gives a consistent mesh or an error with a remedy, in bounded memory", async () => {
    const [file, others] = await load();
    const openOther = (name: string): Promise<ByteSource | undefined> => Promise.resolve(others.get(name));
    const undamaged = await readMesh(file, { fileName, openOther });
    expect(undamaged.success ? "" : undamaged.errors[0].message).toBe("");
    let refused = 0;
    const seeds = seedsOf(fileName);
    for (let seed = 1; seed <= seeds; seed++) {
      const damaged = mutated(file, randomSource(seed));
      let result: Awaited<ReturnType<typeof readMesh>> | undefined;
      const bytes = await allocatedBy(async () => {
        result = await readMesh(damaged, { fileName, openOther });
      });
      const total = [...others.values()].reduce((sum, other) => sum + other.length, damaged.length);
      expect(bytes, `seed ${seed}`).toBeLessThan(BASE_BYTES + BYTES_PER_FILE_BYTE * total);
      if (result?.success === true) expect(isConsistent(result.value), `seed ${seed}`).toBe(true);
      else {
        refused++;
        const [problem] = result?.errors ?? [];
        const hasMessageAndRemedy =
          /\S/.test(problem?.message ?? "") && /^[A-Z].*\.$/.test(problem?.remedy ?? "");
        expect(hasMessageAndRemedy, `seed ${seed}: ${problem?.message}`).toBe(true);
        // The file itself can be valid if the nodes that it needs from another file are missing.
        if (problem?.code === "missing-file") continue;
        const hasLocation = problem?.line !== undefined || problem?.offset !== undefined;
        expect(hasLocation, `seed ${seed}: ${problem?.message}`).toBe(true);
        expect([problem?.code, problem?.message]).toEqual(
          problem?.code === "empty-file"
            ? ["empty-file", "the file is empty"]
            : ["malformed-file", expect.stringMatching(/^(line [1-9]|byte \d+|the file ends at byte)/)],
        );
        expect(problem?.message).not.toMatch(/NaN|undefined/);
        expect(problem?.fileName).toMatch(/^a\./);
      }
    }
    expect(refused).toBeGreaterThan(seeds / 10);
  });
});

test("damaged projects are read, or rejected with a remedy (seeds 1 to 300)", () => {
  const file = encoded(writeProject(cubeProject()));
  const text = new TextDecoder();
  let refused = 0;
  for (let seed = 1; seed <= 300; seed++) {
    const result = readProject(text.decode(mutated(file, randomSource(seed))));
    if (result.success) continue;
    refused++;
    for (const { message, remedy } of result.errors) {
      expect(message, `seed ${seed}`).toMatch(/\S/);
      expect(remedy, `seed ${seed}`).toMatch(/\.$/);
    }
  }
  expect(refused).toBeGreaterThan(200);
});

describe("rejects a hostile file quickly:", () => {
  const problemOf = async (fileName: string, file: Uint8Array) => {
    const read = await readSurface(file, { fileName });
    return read.success ? "" : read.errors[0].message;
  };

  test("many arrays that share the same compressed bytes", async () => {
    const tags = Array.from(
      { length: 20_000 },
      (_, i) => `<DataArray type="UInt8" Name="${i}" format="appended" offset="0"/>`,
    ).join("");
    const none = ["connectivity", "offsets", "types"].map(
      (name) => `<DataArray Name="${name}" format="ascii"/>`,
    );
    const file = `<VTKFile type="UnstructuredGrid"><Piece NumberOfPoints="1" NumberOfCells="0">
<Points><DataArray format="ascii">0 0 0</DataArray></Points><Cells>${none.join("")}</Cells>
<PointData>${tags}</PointData></Piece><AppendedData encoding="base64">_AQAAAAU=${"AAAA".repeat(100_000)}</AppendedData></VTKFile>`;
    expect(await problemOf("a.vtu", encoded(file))).toMatch(/unpack to far more/);
  });

  test("an endless attribute", async () => {
    expect(await problemOf("a.vtu", encoded(`<VTKFile ${"a".repeat(3_000_000)}></VTKFile>`))).toMatch(
      /neither VTU nor/,
    );
  });

  test("values at nodes in thousands of empty sections", async () => {
    const nodes = Array.from({ length: 20_000 }, (_, i) => `${i + 1} 0 0 0`).join("\n");
    const empty = `$NodeData\n0\n0\n3\n0\n9\n0\n$EndNodeData\n`.repeat(20_000);
    const file = `$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n20000\n${nodes}\n$EndNodes\n${empty}`;
    expect(await problemOf("a.msh", encoded(file))).toMatch(/more than 16 sections/);
  });

  test("an endless line", async () => {
    expect(await problemOf("a.off", encoded(`OFF\n${"1".repeat(2_000_000)}`))).toMatch(/longer than/);
  });
});
