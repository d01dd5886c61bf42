/** Regions named in a surface file are those of the volume mesh made from it. */
import { createMesher, readSurface, writeMesh, type Mesh, type Mesher } from "tetrafront";
import { afterAll, beforeAll, describe, expect, test } from "vitest";

import { unmeshedNotes } from "../../../wasm/src/api/reading-notes.js";
import { blockMesh } from "../../support/block-mesh.js";
import { cavitySurface } from "../../support/surfaces.js";

let mesher: Mesher;
beforeAll(async () => {
  mesher = await createMesher();
});
afterAll(() => mesher.dispose());

/** A cube of edge 2 with two regions; the interface between them, z = 1, is a patch of its own. */
function halves(): Mesh {
  const block = blockMesh(2);
  const points = Float64Array.from({ length: 81 }, (_, i) => Math.floor(i / 3 / 3 ** (i % 3)) % 3);
  const corner = (x: number, y: number) => x + 3 * y + 9;
  const interfaceNodes = [0, 1].flatMap((y) =>
    [0, 1].flatMap((x) => [
      ...[corner(x, y), corner(x + 1, y), corner(x + 1, y + 1)],
      ...[corner(x, y), corner(x + 1, y + 1), corner(x, y + 1)],
    ]),
  );
  // Swap two nodes: the elements of the block are positive if z points down.
  const tetrahedra = block.tetrahedra.map((node, i, all) =>
    i % 4 > 1 ? node : (all[i % 4 === 0 ? i + 1 : i - 1] ?? node),
  );
  const outside = block.triangles.map((node, i, all) =>
    i % 3 === 0 ? node : (all[i % 3 === 1 ? i + 1 : i - 1] ?? node),
  );
  const interfacePatch = block.patches.length;
  return {
    ...block,
    points,
    tetrahedra,
    triangles: Uint32Array.of(...outside, ...interfaceNodes),
    trianglePatch: Uint32Array.of(
      ...block.trianglePatch,
      ...interfaceNodes.map(() => interfacePatch).slice(0, 8),
    ),
    patches: [...block.patches, { name: "wall", tag: 30 }],
  };
}

async function writeAndRead(mesh: Mesh, fileName: string): Promise<Mesh> {
  const files = await writeMesh(mesh, fileName);
  const others = new Map(files.map((file) => [file.fileName, file.bytes]));
  const first = files[0] ?? { bytes: new Uint8Array() };
  return readAs(first.bytes, fileName, (name) => Promise.resolve(others.get(name)));
}

async function readAs(
  bytes: Uint8Array | string,
  fileName: string,
  openOther?: (name: string) => Promise<Uint8Array | undefined>,
): Promise<Mesh> {
  const source = typeof bytes === "string" ? new TextEncoder().encode(bytes) : bytes;
  const read = await readSurface(source, { fileName, openOther });
  if (!read.success) throw new Error(read.errors[0].message);
  return read.value;
}

async function filled(surface: Mesh, enclosed?: "regions"): Promise<Mesh> {
  const result = await mesher.fillSurface(surface, { innerShells: enclosed });
  expect(result.report.status).toBe("done");
  return result.mesh;
}

/** Expects that each element belongs to the region that `nameAt` returns for its centroid. */
function expectNames(mesh: Mesh, nameAt: (centroid: readonly number[]) => string): void {
  const { points, tetrahedra, tetrahedronRegion, regions } = mesh;
  const wrong = Array.from(tetrahedronRegion).filter((region, t) => {
    const centroid = [0, 1, 2].map((axis) => {
      const corners = tetrahedra.subarray(4 * t, 4 * t + 4);
      return corners.reduce((sum, node) => sum + (points[3 * node + axis] ?? NaN), 0) / 4;
    });
    return regions[region]?.name !== nameAt(centroid);
  });
  expect(wrong).toHaveLength(0);
  expect(new Set(tetrahedronRegion).size).toBe(regions.length);
}

describe.each([".msh", ".vtu", ".vtk", ".mesh"])("the regions of a %s file with elements", (end) => {
  test("are kept on both sides of an interface", async () => {
    const surface = await writeAndRead(halves(), `halves${end}`);
    const mesh = await filled(surface);
    expectNames(mesh, ([, , z = 0]) => (z < 1 ? "steel" : "water (20 C)"));
    // VTU and VTK number the regions from 1 if they store ids of their own.
    if (end === ".msh") expect(mesh.regions.map(({ tag }) => tag)).toEqual([5, 9]);
  });

  test("are kept for a region enclosed by another", async () => {
    const given = cavitySurface(1);
    const first = await mesher.fillSurface(given, { innerShells: "regions" });
    const names = ["shell of steel", "core"].map((name, r) => ({ name, tag: r + 1 }));
    const made = { ...first.mesh, regions: names };
    const again = volumesByName(await filled(await writeAndRead(made, `core${end}`), "regions"));
    expect([...again.keys()].sort()).toEqual(["core", "shell of steel"]);
    for (const [name, volume] of volumesByName(made)) expect(again.get(name)).toBeCloseTo(volume, 9);
  });
});

function volumesByName({ points, tetrahedra, tetrahedronRegion, regions }: Mesh): Map<string, number> {
  const volumes = new Map<string, number>();
  tetrahedronRegion.forEach((region, t) => {
    const [a, b, c, d] = [0, 1, 2, 3].map((k) => {
      const node = tetrahedra[4 * t + k] ?? 0;
      return points.subarray(3 * node, 3 * node + 3);
    }) as [Float64Array, Float64Array, Float64Array, Float64Array];
    const [u, v, w] = [b, c, d].map((p) => p.map((x, axis) => x - (a[axis] ?? 0)));
    const [ux = 0, uy = 0, uz = 0] = u ?? [];
    const [vx = 0, vy = 0, vz = 0] = v ?? [];
    const [wx = 0, wy = 0, wz = 0] = w ?? [];
    const six = (uy * vz - uz * vy) * wx + (uz * vx - ux * vz) * wy + (ux * vy - uy * vx) * wz;
    const name = regions[region]?.name ?? "";
    volumes.set(name, (volumes.get(name) ?? 0) + six / 6);
  });
  return volumes;
}

/** A tetrahedron that is given only by its surface. */
const SURFACES = `$Entities
0 0 4 1
1 0 0 0 1 1 1 0 0
2 0 0 0 1 1 1 0 0
3 0 0 0 1 1 1 0 0
4 0 0 0 1 1 1 0 0
8 0 0 0 1 1 1 1 9 4 -1 2 -3 4
$EndEntities
$Nodes
1 4 1 4
3 8 0 4
1
2
3
4
0 0 0
1 0 0
0 1 0
0 0 1
$EndNodes
$Elements
4 4 1 4
2 1 2 1
1 1 3 2
2 2 2 1
2 1 2 4
2 3 2 1
3 1 4 3
2 4 2 1
4 2 3 4
$EndElements
`;
const named = (names: string) =>
  `$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$PhysicalNames\n${names}\n$EndPhysicalNames\n${SURFACES}`;

describe("the region of a Gmsh file with triangles only", () => {
  test("is named after the physical group of its volume", async () => {
    const mesh = await filled(await readAs(named('2\n3 9 "core"\n3 4 "other"'), "a.msh"));
    expect(mesh.regions).toEqual([{ name: "core", tag: 9 }]);
  });

  test("gets the only region name of a file of version 2.2, which stores no volumes", async () => {
    const nodes = "$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n$EndNodes\n";
    const elements = "1 2 2 0 1 1 3 2\n2 2 2 0 1 1 2 4\n3 2 2 0 1 1 4 3\n4 2 2 0 1 2 3 4";
    const old = (names: string) =>
      `$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n${names}\n$EndPhysicalNames\n${nodes}$Elements\n4\n${elements}\n$EndElements\n`;
    const mesh = await filled(await readAs(old('1\n3 9 "core"'), "a.msh"));
    expect(mesh.regions).toEqual([{ name: "core", tag: 9 }]);
    const file = await readAs(old('2\n3 9 "core"\n3 4 "other"'), "a.msh");
    expect((await filled(file)).regions).toEqual([{ name: "region 1", tag: 1 }]);
    expect(file.unlocatedRegions).toEqual(["core", "other"]);
  });
});

test("a refined surface keeps the regions on both sides of its triangles", async () => {
  const surface = await writeAndRead(halves(), "halves.msh");
  const refinement = await mesher.refineSurface(surface, { size: 0.6 });
  expect(refinement.splitEdges).toBeGreaterThan(0);
  const mesh = await filled(refinement.mesh);
  expectNames(mesh, ([, , z = 0]) => (z < 1 ? "steel" : "water (20 C)"));
});

test("the only patch of a surface keeps its name", async () => {
  const mesh = { ...halves(), trianglePatch: new Uint32Array(56), patches: [{ name: "skin", tag: 8 }] };
  expect((await filled(await writeAndRead(mesh, "skin.msh"))).patches).toEqual([{ name: "skin", tag: 8 }]);
});

test("regions of triangles that are not in the list of regions are refused", async () => {
  const surface = await writeAndRead(halves(), "halves.msh");
  const { regions = [], triangleRegions = new Uint32Array() } = surface.surfaceRegions ?? {};
  const invalid = { ...surface, surfaceRegions: { regions, triangleRegions: triangleRegions.with(5, 7) } };
  const { report } = await mesher.fillSurface(invalid);
  expect(report.status).toBe("invalid-input");
  expect(report.diagnostics[0]?.message).toMatch(
    /triangleRegions\[5\] is 7, but the number of regions is 2/i,
  );
});

test("the command line reports regions of the file that are not meshed", () => {
  const [steel, water] = [
    { name: "steel", tag: 4 },
    { name: "water", tag: 9 },
  ];
  const surfaceRegions = { regions: [steel, water], triangleRegions: new Uint32Array() };
  expect(unmeshedNotes({ surfaceRegions }, { regions: [water] })).toEqual([
    expect.stringMatching(/"steel"; `innerShells/),
  ]);
  expect(unmeshedNotes({ surfaceRegions }, { regions: [water, steel] })).toEqual([]);
  expect(unmeshedNotes({}, { regions: [water] })).toEqual([]);
});
