/** The faces of an imported CAD file: as patches, they have its names and colours. */
import { expect, test } from "vitest";
import type { SolidFeature } from "tetrafront/project";
import { emptyProject } from "../../../web/document/create";
import { testKernel } from "../../support/kernel-shapes";
import { kernelSolids } from "../../support/kernel-solids";
import { boxSolid, stepFile } from "../../support/step-files";

test("patches have the names and colours of the file, also pieces of a face, and keep changed ones", async () => {
  const red = [1, 0, 0] as const;
  let face = 0;
  const text = new TextDecoder()
    .decode(stepFile([boxSolid("box", [0, 0, 0], [4, 4, 4], { colors: [red] })]))
    .replaceAll("ADVANCED_FACE('',", () => `ADVANCED_FACE('side ${++face}',`);
  const solids = kernelSolids(testKernel);
  const part = await solids.importPart({ format: "step", bytes: new TextEncoder().encode(text), scale: 1 });
  const imported = { id: 1, type: "import", operation: "new", ...part } as const;
  const made = await solids.bodyOf(emptyProject(), { name: "box" }, [imported]);
  expect(made.patches.map(({ name }) => name).sort()).toEqual([1, 2, 3, 4, 5, 6].map((k) => `side ${k}`));
  expect(made.patches.map(({ color }) => color).filter((color) => color !== undefined)).toEqual([red]);
  const renamed = made.patches.map((patch) => ({ ...patch, name: `my ${patch.name}` }));
  const slot: SolidFeature = {
    ...{ id: 2, type: "box", operation: "cut" },
    ...{ position: [2, 2, -1], axis: [0, 0, 1], x: [1, 0, 0], size: [1, 9, 9] },
  };
  const cut = await solids.bodyOf(emptyProject(), { ...made, patches: renamed }, [imported, slot]);
  const names = cut.patches.map(({ name }) => name);
  // The slot divides four faces.
  expect(names.filter((name) => /^my side \d$/.test(name ?? ""))).toHaveLength(6);
  expect(names.filter((name) => /^side \d 2$/.test(name ?? ""))).toHaveLength(4);
});
