/** Names and numbers of patches and regions through every pair of formats that can hold them. */
import { FILE_FORMATS, type Mesh, readMesh, writeMesh } from "tetrafront";
import { describe, expect, test } from "vitest";

import { blockMesh } from "../../support/block-mesh.js";

const block = blockMesh();
/** Patches and regions have the same numbers; region 2 comes first. */
const mesh: Mesh = {
  ...block,
  patches: block.patches.map((patch, p) => ({ ...patch, name: `side ${"abcdef"[p]}`, tag: p + 1 })),
  regions: [
    { name: "hot steel", tag: 2 },
    { name: "water", tag: 1 },
  ],
};

/** Formats whose files can hold names. */
const volumes = FILE_FORMATS.filter(
  ({ id, readable, writable }) =>
    readable.includes("volume") && writable.includes("volume") && id !== "medit-binary",
).map(({ extensions }) => extensions[0]);

async function passedThrough(given: Mesh, extension: string): Promise<Mesh> {
  const files = await writeMesh(given, `a${extension}`);
  const openOther = (name: string) => Promise.resolve(files.find(({ fileName }) => fileName === name)?.bytes);
  const [file] = files;
  const read = await readMesh(file?.bytes ?? new Uint8Array(), { fileName: file?.fileName ?? "", openOther });
  if (!read.success) throw new Error(read.errors[0].message);
  return read.value;
}

/**
 * "side a: 3" per group, with the number of its elements and the sum of the positions of their corners, which tell which
 * they are.
 */
function groupsOf(given: Mesh, kind: "patches" | "regions"): string[] {
  const [nodes, owners, width] =
    kind === "patches"
      ? ([given.triangles, given.trianglePatch, 3] as const)
      : ([given.tetrahedra, given.tetrahedronRegion, 4] as const);
  return given[kind]
    .map(({ name }, g) => {
      const own = [...owners].flatMap((owner, e) =>
        owner === g ? [...nodes.subarray(width * e, width * (e + 1))] : [],
      );
      const sum = [0, 1, 2].map((axis) =>
        own.reduce((total, node) => total + (given.points[3 * node + axis] ?? 0), 0).toFixed(6),
      );
      return `${name}: ${own.length / width} at ${sum.join(" ")}`;
    })
    .sort();
}

const tagsOf = ({ patches, regions }: Mesh) => ({
  patches: Object.fromEntries(patches.map(({ name, tag }) => [name, tag])),
  regions: Object.fromEntries(regions.map(({ name, tag }) => [name, tag])),
});

const isGmsh = (extension: string) => extension.startsWith(".msh");

describe.each(volumes)("from %s", (first) => {
  test.each(volumes)("to %s", async (second) => {
    const one = await passedThrough(mesh, first);
    const two = await passedThrough(one, second);
    for (const kind of ["patches", "regions"] as const) {
      expect(groupsOf(one, kind)).toEqual(groupsOf(mesh, kind));
      expect(groupsOf(two, kind)).toEqual(groupsOf(mesh, kind));
    }
    // Gmsh's numbers are unique over both dimensions, and later formats keep them.
    const unique = isGmsh(first) || isGmsh(second);
    expect(tagsOf(two)).toEqual({
      patches: tagsOf(mesh).patches,
      regions: unique ? { "hot steel": 7, water: 8 } : tagsOf(mesh).regions,
    });
    expect(tagsOf(await passedThrough(two, second))).toEqual(tagsOf(two));
  });
});

test("numbers that are unique already are kept by every format", async () => {
  const regions = mesh.regions.map((region) => ({ ...region, tag: region.tag + 10 }));
  for (const extension of volumes) {
    expect(tagsOf(await passedThrough({ ...mesh, regions }, extension))).toEqual(
      tagsOf({ ...mesh, regions }),
    );
  }
});

describe("properties and groups of solids and shells have different numbers in", () => {
  const numbersIn = async (extension: string, pattern: RegExp) => {
    const [file] = await writeMesh(mesh, `a${extension}`);
    return [...new TextDecoder("latin1").decode(file?.bytes).matchAll(pattern)].map(([, tag]) => Number(tag));
  };

  test.each([
    [".bdf", /^P(?:SOLID|SHELL)\s+(\d+)/gm],
    [".msh", /^[23] (\d+) "/gm],
    [".msh2", /^[23] (\d+) "/gm],
  ])("%s", async (extension, pattern) => {
    const numbers = await numbersIn(extension, pattern);
    expect(numbers).toHaveLength(mesh.patches.length + mesh.regions.length);
    expect(new Set(numbers).size).toBe(numbers.length);
  });
});
