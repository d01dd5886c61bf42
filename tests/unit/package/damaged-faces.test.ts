/** What is wrong with a CAD file or a part is named as the file has it. */
import { createMesher, type Mesher, meshFile } from "tetrafront";
import { afterAll, beforeAll, expect, test } from "vitest";
import { refuse } from "../../../wasm/src/diagnostics/mesher-error.js";
import { withWholeNumbers } from "../../../wasm/src/api/whole-numbers.js";
import { boxSolid, stepFile } from "../../support/step-files.js";

let mesher: Mesher;
beforeAll(async () => {
  mesher = await createMesher();
});
afterAll(() => mesher.dispose());

const box = new TextDecoder().decode(stepFile([boxSolid("box", [0, 0, 0], [4, 3, 2])]));

const notesOf = async (text: string) => {
  const made = await meshFile(new TextEncoder().encode(text), { fileName: "box.step", mesher });
  expect(made.success).toBe(true);
  return made.report.diagnostics.filter(({ code }) => code === "damaged-faces");
};

test("a warning names the faces of a STEP file at which the surface was repaired, and what to do", async () => {
  const shell = /(CLOSED_SHELL\s*\('[^']*',\s*\()#\d+,\s*/;
  expect(box).toMatch(shell);
  const [found, ...others] = await notesOf(box.replace(shell, "$1"));
  expect(others).toEqual([]);
  expect(found).toMatchObject({ severity: "warning" });
  // The faces around the missing one; the one across from it is sound.
  expect(found?.message.match(/face \d/g)).toHaveLength(4);
  expect(found?.remedy).toMatch(/^Heal them in the CAD program, or export the part again/);
});

test("a sound STEP file gives no such warning", async () => {
  expect(await notesOf(box)).toEqual([]);
});

test("a solid that is refused is named by the triangles of the file", async () => {
  const surface = {
    points: Float64Array.of(0, 0, 0, 1, 0, 0, 0, 1, 0),
    triangles: Uint32Array.of(0, 1, 2),
    trianglePatch: Uint32Array.of(0),
    patches: [],
  };
  const numbers = { wholeTriangles: Uint32Array.of(70), wholeNodes: Uint32Array.of(7, 8, 9) };
  const { diagnostics } = await mesher.inspectSurface(surface);
  const refused = withWholeNumbers(
    numbers,
    Promise.resolve().then(() => refuse(diagnostics)),
  );
  await expect(refused).rejects.toThrow(/triangle 70\b/);
});
