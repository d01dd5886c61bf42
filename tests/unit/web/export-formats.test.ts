import { FILE_FORMATS, type Mesh, formatOf, readMesh, writeMesh } from "tetrafront";
import { describe, expect, it } from "vitest";
import { encodingsOf, exportFormats, extensionIn } from "../../../web/document/export-formats";
import { exportStrings } from "../../../web/strings";
import { gridMesh } from "./grid-mesh";

/** Two regions with names, and two triangles with names that no program makes up. */
function namedMesh(): Mesh {
  const { points, tetrahedra } = gridMesh(2);
  return {
    points,
    nodeData: new Map(),
    triangles: Uint32Array.of(0, 1, 3, 1, 4, 3),
    trianglePatch: Uint32Array.of(0, 1),
    patches: [
      { tag: 3, name: "inlet of the tank" },
      { tag: 4, name: "outlet" },
    ],
    tetrahedra,
    tetrahedronRegion: Uint32Array.from({ length: tetrahedra.length / 4 }, (_, t) => t % 2),
    regions: [
      { tag: 1, name: "steel" },
      { tag: 2, name: "water" },
    ],
  };
}

const solverFormats = new Set(["su2", "ugrid", "foam"]);

const cases = exportFormats.flatMap((format) =>
  encodingsOf(format).map((encoding) => ({ name: `${format.id}, ${encoding}`, format, encoding })),
);

describe.each(cases)("$name", ({ format, encoding }) => {
  const fileName = `a.${extensionIn(format, encoding)}`;
  const known = formatOf(fileName);

  it("is a format of the package that can be written, with the content and orders that the dialog states", () => {
    expect(known?.writable).toContain(format.content === "volume" ? "volume" : "surface");
    expect(known?.hasSecondOrder ?? false).toBe(format.hasSecondOrder);
    expect(exportStrings.formats[format.id]).toBeDefined();
  });

  if (solverFormats.has(format.id)) return;
  it("keeps what the dialog states", async () => {
    const [file] = await writeMesh(namedMesh(), fileName);
    const text = Buffer.from(file?.bytes ?? []).toString("latin1");
    if (known?.readable.includes("volume")) {
      const read = await readMesh(new Blob([file?.bytes ?? new Uint8Array()]).stream(), { fileName });
      if (!read.success) throw new Error(read.errors[0].message);
      const names = (groups: readonly { readonly name: string }[]) => groups.map(({ name }) => name);
      if (format.patches === "names")
        expect(names(read.value.patches)).toEqual(["inlet of the tank", "outlet"]);
      if (format.regions === "names") expect(names(read.value.regions)).toEqual(["steel", "water"]);
    } else if (format.patches === "names" && !fileName.endsWith("zip")) {
      expect(text).toMatch(/inlet.of.the.tank/);
    }
    // A file of text has no bytes that are not characters.
    const isText = [...text.slice(0, 2000)].every((character) => character >= " " || /\s/.test(character));
    if (!fileName.endsWith("zip") && format.id !== "vtu") expect(isText).toBe(encoding === "text");
  });
});

it("offers every format of the package that can be written, except other names of the same one", () => {
  const offered = new Set(
    exportFormats.flatMap((format) =>
      encodingsOf(format).map((encoding) => formatOf(`a.${extensionIn(format, encoding)}`)?.id),
    ),
  );
  const writable = FILE_FORMATS.filter(({ writable: contents }) => contents.length > 0).map(({ id }) => id);
  // TetGen's three files are offered as one archive.
  expect(writable.filter((id) => !offered.has(id))).toEqual(["tetgen"]);
});
