/** Names of regions: those of the parts of an assembly, and of solids with the same name. */
import { readFileSync } from "node:fs";

import { createMesher, readSurface, type Mesh } from "tetrafront";
import { expect, test } from "vitest";

import { withoutPause } from "../../../wasm/dist/base/steps.js";
import { productSolids, productsOf } from "../../../wasm/dist/formats/step-products.js";
import { boxSolid, stepFile } from "../../support/step-files.js";
import { stlText } from "../../support/surface-files.js";
import { boxSurface } from "../../support/surfaces.js";

async function surfaceIn(file: Uint8Array, fileName: string): Promise<Mesh> {
  const read = await readSurface(file, { fileName });
  if (!read.success) throw new Error(read.errors[0].message);
  return read.value;
}

test("solids of sub-assemblies have the names of the parts", async () => {
  const file = new URL(
    "../../../node_modules/occt-import-js/test/testfiles/cax-if/as1_pe_203.stp",
    import.meta.url,
  );
  const { surfaceRegions } = await surfaceIn(readFileSync(file), "as1_pe_203.stp");
  const names = surfaceRegions?.regions.map(({ name }) => name) ?? [];
  expect(names.slice(0, 4)).toEqual(["PLATE", "L-BRACKET", "BOLT", "NUT"]);
  const parts = ["BOLT", "L-BRACKET", "NUT", "PLATE", "ROD"];
  const counts = parts.map((part) => names.filter((name) => name.replace(/ \d+$/, "") === part).length);
  expect(counts).toEqual([6, 2, 8, 1, 1]);
  expect(new Set(names).size).toBe(18);
});

test("products of a file are those of its solids; escapes in names are decoded", () => {
  const solids = ["a", "Geh\\X2\\00E4\\X0\\use", "d''e"].map((name, x) =>
    boxSolid(name, [2 * x, 0, 0], [2 * x + 1, 1, 1]),
  );
  const found = withoutPause(productSolids(stepFile(solids)));
  expect(found).toEqual(["a", "Gehäuse", "d'e"].map((product) => ({ product, faces: 6 })));
});

test("a solid that could be one of several products gets no name", () => {
  const solids = [
    { product: "box", faces: 6 },
    { product: "pin", faces: 3 },
    { product: "nut", faces: 8 },
    { product: "cap", faces: 8 },
  ];
  expect(productsOf([6, 3, 8, 8], solids)).toEqual(["box", "pin", "nut", "cap"]);
  expect(productsOf([3, 8, 6], solids)).toEqual(["pin", undefined, "box"]);
});

test("solids of an STL file with the same name are numbered", async () => {
  const text = [0, 3, 6].map((x) => new TextDecoder().decode(stlText(shifted(x), "x"))).join("");
  const surface = await surfaceIn(new TextEncoder().encode(text), "x.stl");
  const mesher = await createMesher();
  const result = await mesher.fillSurface(surface, { size: 2 });
  expect(result.mesh.regions.map(({ name }) => name)).toEqual(["x", "x 2", "x 3"]);
  mesher.dispose();
});

function shifted(x: number) {
  const { points, triangles } = boxSurface(1);
  return { points: points.map((value, i) => (i % 3 === 0 ? value + x : value)), triangles };
}
