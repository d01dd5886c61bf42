/** 3MF files: units, objects at their positions, components, colours, materials, errors. */
import { zipSync } from "fflate";
import { createMesher, NO_REGION, readSurface, type Mesh, type SurfaceInput } from "tetrafront";
import { bodySurface, createBodies } from "tetrafront/project";
import { describe, expect, test } from "vitest";

import { boxSurface, joined, turned } from "../../support/surfaces.js";
import { meshTags, threeMfFile } from "../../support/threemf-files.js";

const box = boxSurface(1);
const boxTags = meshTags(box);

async function surfaceIn(file: Uint8Array): Promise<Mesh> {
  const read = await readSurface(file, { fileName: "a.3mf" });
  if (!read.success) throw new Error(read.errors[0].message);
  return read.value;
}

const messageOf = async (file: Uint8Array) => {
  const read = await readSurface(file, { fileName: "a.3mf" });
  return read.success ? "" : read.errors[0].message;
};

function boxOf({ points }: { readonly points: Float64Array }): number[][] {
  return [0, 1, 2].map((axis) => {
    const along = points.filter((_, i) => i % 3 === axis);
    return [Math.min(...along), Math.max(...along)];
  });
}

/** Replaces the triangles of a side of a box by a fan around its centre, with the same boundary. */
function withFan({ points, triangles }: SurfaceInput, x: number): SurfaceInput {
  const positionOf = (node: number) => [...points.subarray(3 * node, 3 * node + 3)].join();
  const centre = [...points.keys()].find((node) => positionOf(node) === `${x},0.5,0.5`) ?? 0;
  const kept: number[] = [];
  const edges = new Map<string, readonly [number, number]>();
  for (let t = 0; t < triangles.length; t += 3) {
    const corners = [...triangles.subarray(t, t + 3)];
    if (corners.every((node) => points[3 * node] === x)) {
      for (const [k, from] of corners.entries()) {
        const to = corners[(k + 1) % 3] ?? 0;
        if (!edges.delete(`${to} ${from}`)) edges.set(`${from} ${to}`, [from, to]);
      }
    } else kept.push(...corners);
  }
  const fan = [...edges.values()].flatMap(([from, to]) => [from, to, centre]);
  return { points, triangles: Uint32Array.of(...kept, ...fan) };
}

const namesIn = ({ patches }: Mesh) => patches.map(({ name }) => name);

test.each([
  ["micron", 0.001],
  ["millimeter", 1],
  ["centimeter", 10],
  ["inch", 25.4],
  ["foot", 304.8],
  ["meter", 1000],
])("lengths in %s are converted to millimetres", async (unit, factor) => {
  const file = threeMfFile(`<object id="1">${boxTags}</object>`, `<item objectid="1"/>`, unit);
  const surface = await surfaceIn(file);
  expect(surface.unit).toBe("mm");
  expect(boxOf(surface)).toEqual(Array.from({ length: 3 }, () => [0, expect.closeTo(factor, 9) as number]));
});

describe("objects", () => {
  test.each([
    ["the same mesh beside it", box, "1 0 0"],
    ["another triangulation of the common side", boxSurface(1, [1, 0, 0], [3, 1, 1]), "0 0 0"],
    ["a mesh with a node within the common side", boxSurface(2, [1, 0, 0], [3, 1, 1]), null],
  ])("with a whole side in common get an interface there: %s", async (_, second, move) => {
    const first = move === null ? boxSurface(2) : box;
    const resources = `<object id="1" name="a">${meshTags(first)}</object><object id="2" name="b">${meshTags(second)}</object>`;
    const items = `<item objectid="1"/><item objectid="2" transform="1 0 0 0 1 0 0 0 1 ${move ?? "0 0 0"}"/>`;
    const surface = await surfaceIn(threeMfFile(resources, items));
    const sides = surface.surfaceRegions?.triangleRegions ?? new Uint32Array();
    const between = surface.trianglePatch.filter(
      (_patch, t) => sides[2 * t] !== NO_REGION && sides[2 * t + 1] !== NO_REGION,
    );
    expect(between).toHaveLength(move === null ? 8 : 2);
    expect(namesIn(surface)).toContain("a / b");
    const mesher = await createMesher();
    const { isFillable, regions, volume } = await mesher.inspectSurface(surface);
    expect([isFillable, regions]).toEqual([true, 2]);
    expect(volume).toBeCloseTo(move === "1 0 0" ? 2 : 3, 9);
    mesher.dispose();
  });

  test.each([
    ["as they are", (value: number) => value],
    ["rounded as in binary STL", Math.fround],
    ["rounded to six digits", (value: number) => Number(value.toPrecision(6))],
  ])(
    "with an oblique side in common, finely divided in one, get an interface there: nodes %s",
    async (_, rounded) => {
      const meshes = [boxSurface(4), withFan(boxSurface(4, [1, 0, 0], [3, 1, 1]), 1)].map((mesh) => {
        const points = mesh.points.slice();
        for (let i = 0; i < points.length; i += 3) {
          const [x = 0, y = 0, z = 0] = mesh.points.subarray(i, i + 3);
          const [u, v] = [0.8 * x - 0.6 * y, 0.6 * x + 0.8 * y];
          points.set([u, 0.28 * v - 0.96 * z, 0.96 * v + 0.28 * z].map(rounded), i);
        }
        return meshTags({ ...mesh, points });
      });
      const resources = meshes.map(
        (mesh, m) => `<object id="${m + 1}" name="${"ab"[m] ?? ""}">${mesh}</object>`,
      );
      const surface = await surfaceIn(
        threeMfFile(resources.join(""), `<item objectid="1"/><item objectid="2"/>`),
      );
      expect(namesIn(surface)).toEqual(["a", "a / b", "b"]);
      const mesher = await createMesher();
      const { isFillable, regions, volume } = await mesher.inspectSurface(surface);
      expect([isFillable, regions, volume]).toEqual([true, 2, expect.closeTo(3, 4)]);
      mesher.dispose();
    },
  );

  test("are built where their items and components say, each a region and a body", async () => {
    const turn = "0 1 0 -1 0 0 0 0 1";
    const resources = `<object id="1" name="part">${boxTags}</object><object id="2" name="unused">${boxTags}</object>
      <object id="3" name="group"><components><component objectid="1"/><component objectid="1" transform="${turn} 5 0 0"/></components></object>
      <object id="4" type="support">${boxTags}</object>`;
    const items = `<item objectid="3" transform="1 0 0 0 1 0 0 0 1 0 0 10"/><item objectid="4"/>`;
    const surface = await surfaceIn(threeMfFile(resources, items));
    expect(surface.surfaceRegions?.regions.map(({ name }) => name)).toEqual(["part", "part 2"]);
    expect(surface.notes).toEqual(["supports are left out"]);
    const bodies = createBodies(surface, { id: 1, firstPatchId: 1 });
    expect(bodies.map((body) => boxOf(bodySurface(body)))).toEqual([
      [
        [0, 1],
        [0, 1],
        [10, 11],
      ],
      [
        [4, 5],
        [0, 1],
        [10, 11],
      ],
    ]);
  });

  test("that are mirrored face outward", async () => {
    const item = `<item objectid="1" transform="-1 0 0 0 1 0 0 0 1 0 0 0"/>`;
    const surface = await surfaceIn(threeMfFile(`<object id="1">${boxTags}</object>`, item));
    const mesher = await createMesher();
    expect(await mesher.inspectSurface(surface)).toMatchObject({
      isFillable: true,
      flippedTriangles: 0,
      volume: 1,
    });
    mesher.dispose();
  });

  test("that touch have an interface", async () => {
    const items = `<item objectid="1"/><item objectid="1" transform="1 0 0 0 1 0 0 0 1 1 0 0"/>`;
    const surface = await surfaceIn(threeMfFile(`<object id="1" name="cell">${boxTags}</object>`, items));
    expect(namesIn(surface)).toEqual(["cell", "cell / cell 2", "cell 2"]);
    const mesher = await createMesher();
    expect(await mesher.inspectSurface(surface)).toMatchObject({ isFillable: true, regions: 2, volume: 2 });
    mesher.dispose();
  });
});

test("an object that fills a cavity of another is meshed; an empty cavity is not", async () => {
  const core = boxSurface(1, [0.25, 0.25, 0.25], [0.5, 0.5, 0.5]);
  const empty = boxSurface(1, [0.625, 0.625, 0.625], [0.75, 0.75, 0.75]);
  const matrix = meshTags(joined(box, joined(turned(core), turned(empty))));
  const resources = `<object id="1" name="matrix">${matrix}</object><object id="2" name="core">${meshTags(core)}</object>`;
  const surface = await surfaceIn(threeMfFile(resources, `<item objectid="1"/><item objectid="2"/>`));
  const mesher = await createMesher();
  const { report, mesh: volume } = await mesher.fillSurface(surface);
  expect([report.status, report.volume]).toEqual(["done", expect.closeTo(1 - 1 / 512, 9) as number]);
  expect(new Set(volume.regions).size).toBe(2);
  mesher.dispose();
});

test("colours and materials become patches", async () => {
  const properties = `<basematerials id="5"><base name="steel" displaycolor="#808080FF"/></basematerials>
    <m:colorgroup id="6"><m:color color="#FF0000"/><m:color color="#0000FF80"/></m:colorgroup>`;
  const kinds = [`pid="6" p1="0"`, `pid="6" p1="1" p2="1" p3="1"`, ""];
  const tags = meshTags(box, (t) => kinds[t % 3] ?? "");
  const object = `<object id="1" pid="5" pindex="0">${tags}</object>`;
  const surface = await surfaceIn(threeMfFile(properties + object, `<item objectid="1"/>`));
  expect(surface.patches.map(({ name, color }) => [name, color])).toEqual([
    ["steel", [128 / 255, 128 / 255, 128 / 255]],
    ["#ff0000", [1, 0, 0]],
    ["#0000ff", [0, 0, 1]],
  ]);
  expect([0, 1, 2].map((p) => surface.trianglePatch.filter((owner) => owner === p).length)).toEqual([
    4, 4, 4,
  ]);
});

test("a triangle that names a colour but no group has one of the object's group", async () => {
  const colors = `<m:colorgroup id="6"><m:color color="#FF0000"/><m:color color="#0000FF"/></m:colorgroup>`;
  const tags = meshTags(box, (t) => (t % 3 === 0 ? `p1="1"` : ""));
  const object = `<object id="1" pid="6" pindex="0">${tags}</object>`;
  const surface = await surfaceIn(threeMfFile(colors + object, `<item objectid="1"/>`));
  const blue = namesIn(surface).indexOf("#0000ff");
  expect([...namesIn(surface)].sort()).toEqual(["#0000ff", "#ff0000"]);
  expect(surface.trianglePatch.filter((patch) => patch === blue)).toHaveLength(4);
});

test("an object without a colour is one patch without a name", async () => {
  const surface = await surfaceIn(threeMfFile(`<object id="1">${boxTags}</object>`, ""));
  expect(namesIn(surface)).toEqual(["surface"]);
});

describe("errors", () => {
  const item = `<item objectid="1"/>`;
  test.each([
    ["no zip", new TextEncoder().encode("nonsense"), /^byte 0: the file is not a zip file/],
    [
      "no model",
      zipSync({ "a.txt": new Uint8Array(3) }),
      /^byte 0: the file is a zip file without a 3D model/,
    ],
    [
      "a bomb",
      zipSync({ "3D/a.model": new Uint8Array(9_000_000) }),
      /^byte 0: the model unpacks to far more than the size of the file/,
    ],
    [
      "parts in other files",
      threeMfFile(
        `<object id="1"><components><component p:path="/3D/b.model" objectid="2"/></components></object>`,
        item,
      ),
      /^line 4: the model is divided into several files \(production extension\), which is not supported/,
    ],
    [
      "an object that contains itself",
      threeMfFile(`<object id="1"><components><component objectid="1"/></components></object>`, item),
      /nested too deeply, or contain themselves/,
    ],
    ["a missing object", threeMfFile("", item), /^line 5: there is no object 1/],
    [
      "a missing vertex",
      threeMfFile(`<object id="1"><mesh><triangle v1="0" v2="1" v3="2"/></mesh></object>`, item),
      /^line 4: v1 is 0, but the object has no such vertex/,
    ],
    ["no triangles", threeMfFile(`<object id="1"></object>`, item), /the model builds no triangles/],
    ["an unknown unit", threeMfFile("", "", "mile"), /^line 2: unknown unit "mile"/],
  ])("name %s", async (_, file, message) => {
    expect(await messageOf(file)).toMatch(message);
  });

  test("come at once if objects contain each other many times", async () => {
    const objects = Array.from({ length: 30 }, (_, i) => {
      const use = `<component objectid="${i + 2}"/>`;
      return `<object id="${i + 1}"><components>${use}${use}</components></object>`;
    });
    expect(
      await messageOf(threeMfFile(`${objects.join("")}<object id="31">${boxTags}</object>`, item)),
    ).toMatch(/too many triangles/);
  });
});
