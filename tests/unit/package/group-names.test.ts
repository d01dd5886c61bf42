/** Names of patches and regions: every format that can store names keeps them; the others report the loss. */
import { FILE_FORMATS, readMesh, writeMesh, type Mesh } from "tetrafront";
import { describe, expect, test } from "vitest";

import { blockMesh } from "../../support/block-mesh.js";
import { boxSurface } from "../../support/surfaces.js";

const block = blockMesh();
const NAMES = ["in let", "outlet", "floor; & <cold> -- 20 °C -", "Wand Süd", "roof", "door"];
const named: Mesh = {
  ...block,
  patches: NAMES.map((name, p) => ({ name, tag: [7, 3, 11, 4, 21, 2][p] ?? 0 })),
  regions: [
    { name: "steel", tag: 5 },
    { name: "water", tag: 9 },
  ],
};

async function roundTrip(mesh: Mesh, fileName: string): Promise<{ read: Mesh; notes: string }> {
  const files = await writeMesh(mesh, fileName);
  const others = new Map(files.map((file) => [file.fileName, file.bytes]));
  const read = await readMesh(files[0]?.bytes ?? new Uint8Array(), {
    fileName,
    openOther: (name) => Promise.resolve(others.get(name)),
  });
  if (!read.success) throw new Error(read.errors[0].message);
  return {
    read: read.value,
    notes: files.flatMap(({ notes }) => notes.map(({ message }) => message)).join("\n"),
  };
}

/** Returns the patch name of each triangle, sorted by corner positions. */
function byTriangle({ points, triangles, trianglePatch, patches }: Mesh): string[] {
  return Array.from(trianglePatch, (patch, t) => {
    const corners = [0, 1, 2].map((k) => {
      const node = triangles[3 * t + k] ?? 0;
      return Array.from(points.subarray(3 * node, 3 * node + 3), (x) => Math.fround(x) + 0).join(" ");
    });
    return `${corners.sort().join(", ")}: ${patches[patch]?.name ?? ""}`;
  }).sort();
}

const regionsOf = ({ tetrahedronRegion, regions }: Mesh) =>
  Array.from(tetrahedronRegion, (region) => regions[region]?.name);

const both = FILE_FORMATS.filter(({ readable, writable }) => readable.length > 0 && writable.length > 0);

/** Formats that never hold names. */
const WITHOUT_NAMES: readonly (string | undefined)[] = [".meshb"];
const leavesOutNames = (notes: string) => /names are left out/i.test(notes);

/** Makes a name too long for a title or a header. */
const long = (group: { readonly name: string; readonly tag: number }) => ({
  ...group,
  name: `${group.name} ${"very ".repeat(12)}long`,
});

describe.each(both.map(({ name, extensions, writable }) => [name, extensions[0], writable] as const))(
  "%s",
  (_, extension, writable) => {
    const fileName = `a${extension}`;

    test("keeps names, or reports that it cannot store them", async () => {
      const short = {
        ...named,
        patches: named.patches.map(({ name, tag }) => ({ name: name.replace(/;.*|\s/g, ""), tag })),
      };
      for (const mesh of [short, named, { ...named, patches: named.patches.map(long) }]) {
        const { read, notes } = await roundTrip(mesh, fileName);
        if (leavesOutNames(notes)) {
          expect([".stl", ".vtk", ...WITHOUT_NAMES]).toContain(extension);
          if (!WITHOUT_NAMES.includes(extension)) expect(mesh === short, notes).toBe(false);
          continue;
        }
        // Ignore changed whitespace (OBJ) and the part of a name after ";" (formats that join names by "; ").
        const plain = (triangles: string[]) =>
          triangles.map((line) =>
            line.replace(
              /: .*$/,
              (name) =>
                `: ${name
                  .slice(2)
                  .replace(/[\s_]+/g, "_")
                  .replace(/;.*/, "")}`,
            ),
          );
        expect(plain(byTriangle(read))).toEqual(plain(byTriangle(mesh)));
        if (writable.includes("volume")) expect(regionsOf(read)).toEqual(regionsOf(mesh));
      }
    });

    test("keeps the names of regions if there is only one patch", async () => {
      if (!writable.includes("volume")) return;
      const one = {
        ...named,
        patches: [{ name: "skin", tag: 1 }],
        trianglePatch: new Uint32Array(block.trianglePatch.length),
      };
      const { read, notes } = await roundTrip(one, fileName);
      expect(leavesOutNames(notes), notes).toBe(WITHOUT_NAMES.includes(extension));
      if (leavesOutNames(notes)) return;
      expect(regionsOf(read)).toEqual(regionsOf(one));
      expect(new Set(read.patches.map(({ name }) => name))).toEqual(new Set(["skin"]));
    });

    test("gives no group the name of an empty group", async () => {
      const patches = [
        { name: "nowhere", tag: 7 },
        { name: "patch 3", tag: 3 },
      ];
      const regions = [
        { name: "nothing", tag: 5 },
        { name: "region 9", tag: 9 },
      ];
      const mesh = {
        ...block,
        patches,
        trianglePatch: block.trianglePatch.map(() => 1),
        regions,
        tetrahedronRegion: block.tetrahedronRegion.map(() => 1),
      };
      const { read } = await roundTrip(mesh, fileName);
      const used = new Set(Array.from(read.trianglePatch, (patch) => read.patches[patch]?.name));
      expect([...used, ...regionsOf(read)]).not.toContain("nowhere");
      expect(regionsOf(read)).not.toContain("nothing");
    });

    test("keeps long names, or reports which ones it cuts", async () => {
      const end = (p: number) => `${"long ".repeat(180)}end of ${p}`;
      const mesh = { ...named, patches: named.patches.map(({ tag }, p) => ({ name: end(p), tag })) };
      const { read, notes } = await roundTrip(mesh, fileName);
      const names = new Set(Array.from(read.trianglePatch, (patch) => read.patches[patch]?.name ?? ""));
      const isKept = [...names].every((name) => / *end of \d$/.test(name.replaceAll("_", " ")));
      if (!isKept) expect(notes).toMatch(/truncated|left out|changed to what the format permits|takes them/);
      if (!isKept)
        for (const { tag } of named.patches) expect(notes).toMatch(new RegExp(`\\b${tag}\\b|end of`));
    });

    test("keeps the name of the only patch of a surface", async () => {
      const { points, triangles } = boxSurface(1);
      const one = {
        ...block,
        points,
        triangles,
        trianglePatch: new Uint32Array(triangles.length / 3),
        patches: [{ name: "skin", tag: 1 }],
        tetrahedra: new Uint32Array(),
        tetrahedronRegion: new Uint32Array(),
        regions: [],
      };
      const { read, notes } = await roundTrip(one, fileName);
      expect(leavesOutNames(notes), notes).toBe(WITHOUT_NAMES.includes(extension));
      if (leavesOutNames(notes)) return;
      expect(new Set(Array.from(read.trianglePatch, (patch) => read.patches[patch]?.name))).toEqual(
        new Set(["skin"]),
      );
    });
  },
);

test("VTU keeps the names and tags of patches and regions of a Gmsh file", async () => {
  // A project's mesh in a Gmsh file: numbers are shared, so the first region has another tag than its name says.
  const regions = [
    { name: "region 1", tag: 61 },
    { name: "core", tag: 62 },
  ];
  const { read: gmsh } = await roundTrip({ ...named, regions }, "a.msh");
  const { read: vtu } = await roundTrip(gmsh, "a.vtu");
  const { read: again } = await roundTrip(vtu, "b.msh");
  for (const mesh of [gmsh, vtu, again]) {
    expect(mesh.regions).toEqual(regions);
    expect(new Set(mesh.patches)).toEqual(new Set(gmsh.patches));
    expect(regionsOf(mesh)).toEqual(regionsOf(gmsh));
  }
});

test("VTU names come from field data if another program has dropped the comments", async () => {
  const [file] = await writeMesh(named, "a.vtu");
  const text = new TextDecoder("latin1").decode(file?.bytes);
  const bytes = Uint8Array.from(text.replace(/<!--.*-->\n/g, ""), (letter) => letter.charCodeAt(0));
  expect(bytes.length).toBeLessThan(text.length);
  const read = await readMesh(bytes, { fileName: "a.vtu" });
  if (!read.success) throw new Error(read.errors[0].message);
  expect(new Set(read.value.patches)).toEqual(new Set(named.patches));
  expect(read.value.regions).toEqual(named.regions);
});

test("OFF: reads comments of any length at the end of the file", async () => {
  const [file] = await writeMesh(named, "a.off");
  const text = new TextDecoder().decode(file?.bytes);
  const begin = text.indexOf("# patch");
  const longer = `${text.slice(0, begin)}${"# of no use\n".repeat(60_000)}${text.slice(begin)}`;
  const read = await readMesh(new TextEncoder().encode(longer), { fileName: "a.off" });
  expect(read.success && read.value.patches).toHaveLength(NAMES.length);
});

test("OFF: ignores comments about the faces of a patch that do not match the faces", async () => {
  const [file] = await writeMesh(named, "a.off");
  const text = new TextDecoder().decode(file?.bytes);
  for (const [from, to] of [
    [/faces of patch 7: 0-7/, "faces of patch 7: 0-6"],
    [/faces of patch 7: 0-7/, "faces of patch 7: 1-8"],
    [/faces of patch 7: 0-7/, "faces of patch 7: 0-99999999999"],
    [/faces of patch 7: 0-7/, "faces of patch 7: 7-0"],
  ] as const) {
    expect(text).toMatch(from);
    const read = await readMesh(new TextEncoder().encode(text.replace(from, to)), { fileName: "a.off" });
    expect(read.success && read.value.patches).toHaveLength(1);
  }
});

/** Returns the renamed groups that notes report as "old" as "new". */
const renamedGroups = (notes: string) =>
  new Map([...notes.matchAll(/"([^"]*)" as "([^"]*)"/g)].map(([, was = "", is = ""]) => [was, is]));

test.each([
  [".su2", /^[\p{L}\p{M}\p{N}_.+-]+$/u, /^MARKER_TAG= (.*)$/gm],
  [".inp", /^[A-Za-z]\w*$/, /^\*NSET, NSET=(.*)$/gm],
])("%s: writes valid unique names and reports each renamed group", async (end, usable, line) => {
  const odd = ["in (1)", "in {1}", "a:b,c%d;e", "none", "Süd", "plain"];
  const [file] = await writeMesh(
    { ...named, patches: odd.map((name, p) => ({ name, tag: p + 1 })) },
    `a${end}`,
  );
  const text = new TextDecoder().decode(file?.bytes);
  const names = [...text.matchAll(line)].map(([, name = ""]) => name);
  expect(names).toHaveLength(odd.length);
  expect(new Set(names.map((name) => name.toLowerCase())).size).toBe(odd.length);
  for (const name of names) expect(name).toMatch(usable);
  if (end === ".su2") expect(names).not.toContain("none");
  const changed = renamedGroups(file?.notes.map(({ message }) => message).join("\n") ?? "");
  expect(odd.map((name) => changed.get(name) ?? name)).toEqual(names);
});

test("binary STL: notes list omitted patch names by the numbers in the file", async () => {
  const [file] = await writeMesh({ ...named, patches: named.patches.map(long) }, "a.stl");
  const view = new DataView(file?.bytes.buffer ?? new ArrayBuffer(0));
  for (const [t, patch] of named.trianglePatch.entries()) {
    const number = view.getUint16(84 + 50 * t + 48, true);
    const messages = file?.notes.map(({ message }) => message).join("\n");
    expect(messages).toContain(`${number} for "${NAMES[patch]} very`);
  }
});
