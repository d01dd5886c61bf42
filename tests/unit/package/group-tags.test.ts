/** Tags of patches and regions: read correctly, and written unchanged if the format permits it. */
import { readMesh, writeMesh, type Mesh } from "tetrafront";
import { describe, expect, test } from "vitest";

import { blockMesh } from "../../support/block-mesh.js";

async function read(file: string | Uint8Array<ArrayBuffer>, fileName: string): Promise<Mesh> {
  const bytes = typeof file === "string" ? new TextEncoder().encode(file) : file;
  const result = await readMesh(bytes, { fileName });
  if (!result.success) throw new Error(result.errors[0].message);
  return result.value;
}

const groupsOfTriangles = ({ trianglePatch, patches }: Mesh) =>
  Array.from(trianglePatch, (patch) => patches[patch]);

describe("Gmsh: surfaces in no physical group (Mesh.SaveAll) do not get the name of a group", () => {
  const names = '$PhysicalNames\n1\n2 2 "inlet"\n$EndPhysicalNames\n';
  const blocks = (groups: string) => `$MeshFormat\n4.1 0 8\n$EndMeshFormat\n${names}$Entities
0 0 2 0\n1 0 0 0 1 1 1 ${groups} 0\n2 0 0 0 1 1 1 0 0\n$EndEntities
$Nodes\n1 4 1 4\n2 1 0 4\n1\n2\n3\n4\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n$EndNodes
$Elements\n2 4 1 4\n2 1 2 1\n1 1 3 2\n2 2 2 3\n2 1 2 4\n3 2 3 4\n4 1 4 3\n$EndElements\n`;
  const list = (group: number) => `$MeshFormat\n2.2 0 8\n$EndMeshFormat\n${names}
$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n$EndNodes
$Elements\n4\n1 2 2 ${group} 1 1 3 2\n2 2 2 0 2 1 2 4\n3 2 2 0 2 2 3 4\n4 2 2 0 2 1 4 3\n$EndElements\n`;

  test.each([
    ["4.1", blocks("1 2")],
    ["4.1, reversed", blocks("1 -2")],
    ["2.2", list(2)],
    ["2.2, reversed", list(-2)],
  ])("%s", async (_, file) => {
    const mesh = await read(file, "a.msh");
    const [inlet, ...others] = groupsOfTriangles(mesh);
    expect(inlet).toMatchObject({ name: "inlet", tag: 2 });
    for (const other of others) expect(other?.name).toBe("entity 2");
    for (const other of others) expect(other?.tag).not.toBe(2);
    expect(mesh.patches).toHaveLength(2);
  });
});

describe("tags of groups", () => {
  const block = blockMesh();
  const withTags = (...tags: readonly number[]): Mesh => ({
    ...block,
    patches: block.patches.map((patch, p) => ({ ...patch, name: `side ${p}`, tag: tags[p] ?? 100 + p })),
    regions: block.regions.map((region, r) => ({ ...region, name: `body ${r}`, tag: 5 * r })),
  });

  test.each([".mesh", ".vtu", ".vtk", ".ele"])("are kept by %s, including zero", async (extension) => {
    const mesh = withTags(0, 10, 20);
    const files = await writeMesh(mesh, `a${extension}`);
    const others = new Map(files.map(({ fileName, bytes }) => [fileName, bytes]));
    const again = await readMesh(others.get(`a${extension}`) ?? new Uint8Array(), {
      fileName: `a${extension}`,
      openOther: (name) => Promise.resolve(others.get(name)),
    });
    if (!again.success) throw new Error(again.errors[0].message);
    const tagsOf = (given: Mesh) => groupsOfTriangles(given).map((patch) => patch?.tag);
    expect(tagsOf(again.value).sort()).toEqual(tagsOf(mesh).sort());
    expect(new Set(again.value.regions.map(({ tag }) => tag))).toEqual(
      new Set(mesh.regions.map(({ tag }) => tag)),
    );
    expect(files[0]?.notes.map(({ message }) => message).join()).not.toMatch(/numbers of/i);
  });

  test("are unique across patches and regions in Nastran, patches first", async () => {
    const [file] = await writeMesh(withTags(7, 5, 12, 100_000_000), "a.bdf");
    const numbersOf = (card: string) =>
      [...new TextDecoder().decode(file?.bytes).matchAll(new RegExp(`^${card} *(\\d+)`, "gm"))].map(([, n]) =>
        Number(n),
      );
    // Tags have at most eight digits; the tag 5 of a region is already taken by a patch.
    expect(numbersOf("PSHELL")).toEqual([7, 5, 12, 1, 104, 105]);
    expect(numbersOf("PSOLID")).toEqual([2, 3]);
    const notes = file?.notes.map(({ message }) => message).join("\n");
    expect(notes).toMatch(/numbers of patches changed.*: 100000000 as 1/i);
    expect(notes).toMatch(/numbers of regions changed.*for each patch and region: 0 as 2, 5 as 3/i);
  });

  test.each([".msh", ".msh2"])(
    "are kept by %s if they are valid, and each change is reported",
    async (extension) => {
      const [file] = await writeMesh(withTags(0, 10, 20, 10, 2.5, -1), `a${extension}`);
      const again = await read(file?.bytes ?? new Uint8Array(), "a.msh");
      const byName = new Map(again.patches.map(({ name, tag }) => [name, tag]));
      expect([byName.get("side 1"), byName.get("side 2")]).toEqual([10, 20]);
      expect(new Set(byName.values()).size).toBe(block.patches.length);
      const note = file?.notes.find(({ message }) => message.startsWith("Numbers of patches"))?.message ?? "";
      for (const [name, tag] of [
        ["0", 0],
        ["10", 3],
        ["2.5", 4],
        ["-1", 5],
      ].map(([old, p]) => [old, byName.get(`side ${p}`)] as const)) {
        expect(note).toContain(`${name} as ${tag}`);
      }
      expect(note).not.toContain("20 as");
    },
  );

  test.each([".msh", ".msh2"])(
    "of a generated mesh are made unique in %s without a note",
    async (extension) => {
      const generated = {
        ...block,
        patches: block.patches.map((_, p) => ({ name: `patch ${p + 1}`, tag: p + 1 })),
        regions: block.regions.map((_, r) => ({ name: `region ${r + 1}`, tag: r + 1 })),
      };
      const [file] = await writeMesh(generated, `a${extension}`);
      expect(file?.notes).toEqual([]);
      const again = await read(file?.bytes ?? new Uint8Array(), "a.msh");
      const tags = [...again.patches, ...again.regions].map(({ tag }) => tag);
      expect(new Set(tags).size).toBe(tags.length);
    },
  );

  test("are reported for the first ten changes only", async () => {
    const count = block.trianglePatch.length;
    const many = {
      ...block,
      trianglePatch: Uint32Array.from({ length: count }, (_, t) => t),
      patches: Array.from({ length: count }, (_, p) => ({ name: `side ${p}`, tag: -1 - p })),
    };
    const [file] = await writeMesh(many, "a.msh");
    const note = file?.notes.map(({ message }) => message).join("\n") ?? "";
    expect(note.match(/-\d+ as \d+/g)).toHaveLength(10);
    expect(note).toContain(`and ${count - 10} more`);
  });
});
