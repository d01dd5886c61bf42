/** Patches by the sharp edges of a surface: `splitPatches`, names, bodies, and the command line. */
import { readFileSync } from "node:fs";

import {
  createMesher,
  type MeshGroup,
  type Mesher,
  readMesh,
  readSurface,
  type SplitOptions,
  type SurfaceInput,
  writeMesh,
} from "tetrafront";
import {
  bodyPatchGroups,
  bodyWithPatches,
  mergePatches,
  bodySurface,
  createBody,
  type ProjectBody,
  readProject,
} from "tetrafront/project";
import { afterAll, beforeAll, describe, expect, test } from "vitest";

import { splitGroups } from "../../../wasm/src/api/patch-names.js";
import { tetrafront } from "../../support/command-line.js";
import { plateSurface } from "../../support/plate.js";
import { offFile, stlBinary } from "../../support/surface-files.js";
import { boxSurface, sphereSurface } from "../../support/surfaces.js";
import { temporaryFolder } from "../../support/temporary-folder.js";

let mesher: Mesher;
beforeAll(async () => {
  mesher = await createMesher();
});
afterAll(() => mesher.dispose());

const folder = temporaryFolder();
const { inFolder, save } = folder;
const cli = (...args: string[]) => tetrafront(folder.path, args);

const PATCHES = [1, 2, 3, 4, 5, 6].map((number) => `patch ${number}`);
/** Sorted: some readers list patches in the order of their first triangles. */
const namesOf = (patches: readonly MeshGroup[]) => patches.map(({ name }) => name).sort();

/** Returns the name of the patch of each triangle, by the triangle's centroid. */
function namesByCentroid(
  { points, triangles }: SurfaceInput,
  { trianglePatch, patches }: { trianglePatch: Uint32Array; patches: readonly MeshGroup[] },
): Map<string, string> {
  return new Map(
    Array.from(trianglePatch, (patch, t): [string, string] => {
      const nodes = [...triangles.subarray(3 * t, 3 * t + 3)];
      const centroid = [0, 1, 2].map((axis) =>
        nodes.reduce((sum, node) => sum + (points[3 * node + axis] ?? 0) / 3, 0).toFixed(6),
      );
      return [centroid.join(" "), patches[patch]?.name ?? ""];
    }),
  );
}

describe("splitPatches", () => {
  test("divides a cube into six patches, numbered from the bottom up", async () => {
    const cube = boxSurface(2);
    const split = (await mesher.splitPatches(cube)).mesh;
    expect(split.points).toBe(cube.points);
    expect(split.patches).toEqual(PATCHES.map((name, p) => ({ name, tag: p + 1 })));
    const heights = split.patches.map((_, p) => {
      const own = [...split.trianglePatch.keys()].filter((t) => split.trianglePatch[t] === p);
      const nodes = own.flatMap((t) => [...cube.triangles.subarray(3 * t, 3 * t + 3)]);
      return nodes.reduce((sum, node) => sum + (cube.points[3 * node + 2] ?? 0), 0) / nodes.length;
    });
    expect(heights[0]).toBe(0);
    expect(heights[5]).toBe(1);
    for (const height of heights.slice(1, 5)) expect(height).toBeCloseTo(0.5, 9);
  });

  test("gives reversed triangles the same names", async () => {
    const { points, triangles } = boxSurface(3);
    const count = triangles.length / 3;
    const reversed = triangles.map((_, i) => triangles[3 * (count - 1 - Math.floor(i / 3)) + (i % 3)] ?? 0);
    const one = namesByCentroid(
      { points, triangles },
      (await mesher.splitPatches({ points, triangles })).mesh,
    );
    const other = { points, triangles: reversed };
    expect(namesByCentroid(other, (await mesher.splitPatches(other)).mesh)).toEqual(one);
  });

  test("leaves a smooth surface whole, and divides it at a small angle", async () => {
    const sphere = sphereSurface(6);
    expect((await mesher.splitPatches(sphere)).mesh.patches).toEqual([{ name: "patch 1", tag: 1 }]);
    expect((await mesher.splitPatches(sphere, { angle: 1 })).mesh.patches.length).toBeGreaterThan(100);
  });

  test("keeps given patches apart, with their names, numbers and colours", async () => {
    const cube = boxSurface(2);
    // Two faces of eight triangles each are the wing.
    const trianglePatch = new Uint32Array(48).map((_, t) => (t < 16 ? 1 : t < 24 ? 2 : 0));
    const patches: MeshGroup[] = [
      { name: "surface", tag: 1 },
      { name: "wing", tag: 7, color: [1, 0, 0] },
      { name: "inlet", tag: 2, color: [0, 1, 0] },
    ];
    const split = (await mesher.splitPatches({ ...cube, trianglePatch, patches })).mesh;
    const byName = new Map(split.patches.map((patch) => [patch.name, patch]));
    expect([...byName.keys()].sort()).toEqual(["inlet", "patch 1", "patch 2", "patch 3", "wing", "wing 2"]);
    expect(byName.get("wing")).toEqual({ name: "wing", tag: 7 });
    expect(byName.get("inlet")).toEqual({ name: "inlet", tag: 2, color: [0, 1, 0] });
    expect(new Set(split.patches.map(({ tag }) => tag)).size).toBe(6);
    split.trianglePatch.forEach((patch, t) => {
      const name = split.patches[patch]?.name ?? "";
      expect(name.startsWith("wing")).toBe(t < 16);
      expect(name === "inlet").toBe(t >= 16 && t < 24);
    });
  });

  describe("of some patches", () => {
    const cube = boxSurface(2);
    /** Each patch consists of two opposite faces of the cube, eight triangles each. */
    const trianglePatch = new Uint32Array(48).map((_, t) => Math.floor(t / 16));
    const given: MeshGroup[] = [
      { name: "wing", tag: 4, color: [1, 0, 0] },
      { name: "patch 1", tag: 1 },
      { name: "surface", tag: 2 },
    ];
    const splitOf = async (patches: readonly number[]) =>
      (await mesher.splitPatches({ ...cube, trianglePatch, patches: given }, { patches })).mesh;

    test.each([0, 1, 2])("leaves all but patch %i as they are", async (only) => {
      const split = await splitOf([only]);
      expect(split.patches).toHaveLength(4);
      expect(new Set(split.patches.map(({ name }) => name)).size).toBe(4);
      expect(new Set(split.patches.map(({ tag }) => tag)).size).toBe(4);
      const pieces = new Set<MeshGroup | undefined>();
      split.trianglePatch.forEach((patch, t) => {
        const [before, after] = [given[trianglePatch[t] ?? 0], split.patches[patch]];
        if (before === given[only]) pieces.add(after);
        else expect(after).toEqual(before);
      });
      expect(pieces.size).toBe(2);
      const names = [
        ["wing", "wing 2"],
        ["patch 1", "patch 2"],
        ["patch 2", "patch 3"],
      ];
      expect([...pieces].map((piece) => piece?.name).sort()).toEqual(names[only]);
    });

    test("splits none if none is given, and ignores patches that do not exist", async () => {
      const split = await splitOf([]);
      expect(namesByCentroid(cube, split)).toEqual(namesByCentroid(cube, { trianglePatch, patches: given }));
      expect(split.patches).toHaveLength(3);
      expect(await splitOf([7])).toEqual(split);
    });

    test("needs no names", async () => {
      const split = (await mesher.splitPatches({ ...cube, trianglePatch }, { patches: [1] })).mesh;
      expect(split.patches).toEqual(PATCHES.slice(0, 4).map((name, p) => ({ name, tag: p + 1 })));
    });
  });

  test("names arrive in the mesh and in every file", async () => {
    const split = (await mesher.splitPatches(boxSurface(2))).mesh;
    const remesh = await mesher.remeshSurface(split, { size: 0.4 });
    const surface = remesh.mesh;
    const result = await mesher.fillSurface(surface, { size: 0.4 });
    const mesh = result.mesh;
    for (const extension of ["msh", "msh2", "inp"]) {
      const [file] = await writeMesh(mesh, `cube.${extension}`);
      const text = new TextDecoder().decode(file?.bytes);
      for (const name of PATCHES) expect(text.replaceAll("_", " ")).toContain(name);
    }
    for (const extension of ["msh", "vtu"]) {
      const fileName = `cube.${extension}`;
      const [file] = await writeMesh(mesh, fileName);
      const read = await readMesh(file?.bytes ?? new Uint8Array(), { fileName });
      if (!read.success) throw new Error(read.errors[0].message);
      expect(namesOf(read.value.patches)).toEqual(PATCHES);
      const again = (await mesher.splitPatches({ ...read.value })).mesh;
      expect(namesByCentroid(again, again)).toEqual(namesByCentroid(read.value, read.value));
    }
  });

  test("refuses invalid angles and numbers", async () => {
    const cube = boxSurface(1);
    await expect(mesher.splitPatches(cube, { angle: 0 })).rejects.toThrow("angle between patches is 0");
    await expect(mesher.splitPatches(cube, { patches: [-1] })).rejects.toThrow("list of patches to split");
    const wild = { ...cube, triangles: cube.triangles.map((node, i) => (i === 4 ? 99 : node)) };
    await expect(mesher.splitPatches(wild)).rejects.toMatchObject({ code: "invalid-input" });
  });
});

describe("names of split patches", () => {
  test("are unique, also beside given names that look like them", () => {
    const given = [
      { name: "wing", tag: 1 },
      { name: "wing 2", tag: 2 },
    ];
    expect(splitGroups(Uint32Array.of(0, 1, 0, 0, 1), given)).toEqual([
      { name: "wing", tag: 1 },
      { name: "wing 2", tag: 2 },
      { name: "wing 3", tag: 3 },
      { name: "wing 4", tag: 4 },
      { name: "wing 2 2", tag: 5 },
    ]);
  });

  test.each(["#b51010", "color 3", "attribute 7"])("do not follow %s, if all triangles have it", (name) => {
    const pieces = splitGroups(Uint32Array.of(0, 0), [{ name, tag: 1 }]);
    expect(pieces).toEqual([
      { name: "patch 1", tag: 1 },
      { name: "patch 2", tag: 2 },
    ]);
    const two = [
      { name, tag: 1 },
      { name: "#00ff00", tag: 2 },
    ];
    expect(splitGroups(Uint32Array.of(0, 1, 0), two).map((piece) => piece.name)).toEqual([
      name,
      "#00ff00",
      `${name} 2`,
    ]);
  });

  test("are found in linear time", () => {
    const groups = splitGroups(new Uint32Array(100_000), [{ name: "wing", tag: 1 }]);
    expect(groups.at(-1)).toEqual({ name: "wing 100000", tag: 100_000 });
  });
});

describe("patches of a body", () => {
  const newBody = () => createBody(boxSurface(2), { id: 1, firstPatchId: 4, name: "box" });
  const splitBody = async (body: ProjectBody, nextPatchId: number, options?: SplitOptions) =>
    bodyWithPatches(
      body,
      (await mesher.splitPatches({ ...bodySurface(body), patches: bodyPatchGroups(body) }, options)).mesh,
      nextPatchId,
    );

  test("are split: the first piece keeps the id", async () => {
    const body = await splitBody(newBody(), 10);
    expect(body.patches).toEqual([4, 10, 11, 12, 13, 14].map((id) => ({ id })));
    expect(new Set(bodySurface(body).trianglePatch).size).toBe(6);
    expect(await splitBody(body, 20)).toEqual(body);
  });

  test("are split one alone: the others keep their ids, names and triangles", async () => {
    const surface = plateSurface({ half: 5, thickness: 1, radius: 2, corners: 24 });
    const plate = await splitBody(createBody(surface, { id: 1, firstPatchId: 5, name: "plate" }), 8);
    // The bottom, four sides, the hole and the top.
    expect(plate.patches).toEqual([5, 8, 9, 10, 11, 12, 13].map((id) => ({ id })));
    const before = bodySurface(plate).trianglePatch;
    const hole = plate.patches.findIndex((_, p) => before.filter((patch) => patch === p).length === 48);
    const names = plate.patches.map((_, p) => (p === hole ? "hole" : `region ${p}`));
    const named = { ...plate, patches: plate.patches.map(({ id }, p) => ({ id, name: names[p] ?? "" })) };

    const split = await splitBody(named, 20, { angle: 5, patches: [hole] });
    const after = bodySurface(split).trianglePatch;
    const pieces = new Map<number, number>();
    after.forEach((patch, t) => {
      if (before[t] === hole) pieces.set(patch, (pieces.get(patch) ?? 0) + 1);
      else expect(split.patches[patch]).toEqual(named.patches[before[t] ?? 0]);
    });
    expect([...pieces.values()]).toEqual(Array.from({ length: 24 }, () => 2));
    expect(split.patches).toHaveLength(6 + 24);
    const ofHole = split.patches.filter((_, p) => pieces.has(p));
    expect(ofHole[0]).toEqual(named.patches[hole]);
    expect(ofHole.slice(1)).toEqual(
      Array.from({ length: 23 }, (_, i) => ({ id: 20 + i, name: `hole ${i + 2}` })),
    );
    const flat = await splitBody(named, 20, { angle: 1, patches: [0] });
    expect(flat.patches).toEqual(named.patches);
  });

  test("keep their names where the surface is smooth", async () => {
    const ball = createBody(sphereSurface(6), { id: 1, firstPatchId: 1, name: "ball" });
    expect((await splitBody(ball, 2)).patches).toEqual([{ id: 1, name: "ball" }]);
  });

  test("are merged into the first of them", async () => {
    const body = await splitBody(newBody(), 10);
    const merged = mergePatches(body, [12, 10, 99]);
    expect(merged.patches.map(({ id }) => id)).toEqual([4, 10, 11, 13, 14]);
    const before = bodySurface(body).trianglePatch;
    const after = bodySurface(merged).trianglePatch;
    const idOf = (one: ProjectBody, patch: number | undefined) => one.patches[patch ?? -1]?.id;
    before.forEach((patch, t) => {
      const id = idOf(body, patch);
      expect(idOf(merged, after[t])).toBe(id === 12 ? 10 : id);
    });
    const whole = mergePatches(
      body,
      body.patches.map(({ id }) => id),
    );
    expect(whole.patches).toEqual([{ id: 4 }]);
    expect(whole).not.toHaveProperty("trianglePatch");
    expect(mergePatches(body, [99])).toEqual(body);
  });

  test("must fit its triangles", () => {
    const surface = { trianglePatch: new Uint32Array(3), patches: [{ name: "a" }] };
    expect(() => bodyWithPatches(newBody(), surface, 10)).toThrow("one index per triangle");
    const wild = { ...surface, trianglePatch: new Uint32Array(48).fill(1) };
    expect(() => bodyWithPatches(newBody(), wild, 10)).toThrow("beyond its patches");
  });
});

describe("--split-patches", () => {
  const patchesIn = async (name: string) => {
    const read = await readMesh(readFileSync(inFolder(name)), { fileName: name });
    if (!read.success) throw new Error(read.errors[0].message);
    return namesOf(read.value.patches);
  };

  test("gives mesh, remesh and convert the patches of a plain STL file", async () => {
    save("cube.stl", stlBinary(boxSurface(2)));
    const meshed = await cli("mesh", "cube.stl", "-o", "cube.msh", "--size", "0.3", "--split-patches");
    expect(meshed).toMatchObject({ code: 0 });
    expect(meshed.stderr).toContain("split: 1 patch before, 6 after");
    expect(await patchesIn("cube.msh")).toEqual(PATCHES);

    const remeshed = await cli(
      "remesh",
      "cube.stl",
      "-o",
      "cube.ply",
      "--size",
      "0.3",
      "--split-patches",
      "30",
    );
    expect(remeshed).toMatchObject({ code: 0 });
    expect(await patchesIn("cube.ply")).toEqual(PATCHES);

    expect(await cli("convert", "cube.stl", "-o", "cube.off", "--split-patches=50")).toMatchObject({
      code: 0,
    });
    const read = await readSurface(readFileSync(inFolder("cube.off")), { fileName: "cube.off" });
    expect(read.success && namesOf(read.value.patches)).toEqual(PATCHES);
  });

  test("gives a project's body its patches, and the boundary of a volume mesh", async () => {
    save("cube.stl", stlBinary(boxSurface(2)));
    await cli("convert", "cube.stl", "-o", "cube.json", "--split-patches", "-q");
    const project = readProject(readFileSync(inFolder("cube.json"), "utf8"));
    expect(project.success && project.value.bodies?.[0]?.patches).toHaveLength(6);
    await cli("mesh", "cube.stl", "-o", "plain.vtu", "-q");
    expect(await patchesIn("plain.vtu")).toHaveLength(1);
    await cli("convert", "plain.vtu", "-o", "split.vtu", "--split-patches", "-q");
    expect(await patchesIn("split.vtu")).toEqual(PATCHES);
  });

  test("keeps named patches", async () => {
    save("box.off", offFile(boxSurface(2)));
    await cli("convert", "box.off", "-o", "again.off", "--split-patches", "-q");
    expect(await patchesIn("again.off")).toEqual(PATCHES);
  });

  test("reports invalid angles, and is not for projects", async () => {
    save("cube.stl", stlBinary(boxSurface(1)));
    const { code, stderr } = await cli("mesh", "cube.stl", "-o", "cube.msh", "--split-patches", "400");
    expect(code).toBe(2);
    expect(stderr).toContain("angle between patches");
    await cli("convert", "cube.stl", "-o", "cube.json", "-q");
    const refused = await cli("mesh", "cube.json", "-o", "cube.msh", "--split-patches");
    expect(refused.code).toBe(2);
    expect(refused.stderr).toContain("--split-patches is for surfaces");
  });
});
