/** CAD files as trimmed surfaces: surfaces, curves in space and in the plane, loops, solids, errors. */
import { readFileSync } from "node:fs";

import { beforeAll, describe, expect, test } from "vitest";

import { trimmedModelOfBrep } from "../../../wasm/dist/cad/brep-model.js";
import { readTrimmedModel } from "../../../wasm/dist/cad/kernel.js";
import type { CadKernel } from "../../../wasm/dist/cad/kernel-classes.js";
import { CadFileError, type FaceSurface, type TrimmedModel } from "../../../wasm/dist/cad/trimmed-model.js";
import {
  boxAt,
  type Kernel,
  kernelVolume,
  solidMakers,
  stepOf,
  testKernel,
  together,
} from "../../support/kernel-shapes.js";
import { boxSolid, stepFile } from "../../support/step-files.js";
import {
  curveAt,
  distance,
  edgeAt,
  edgeOf,
  surfaceAt,
  surfaceOf,
  vertexAt,
  volumeOf,
} from "../../support/trimmed-surfaces.js";

let kernel: Kernel;
beforeAll(async () => {
  kernel = await testKernel();
});

const read = (format: "step" | "brep", bytes: Uint8Array, sharesFaces = false) =>
  readTrimmedModel(() => Promise.resolve(kernel as unknown as CadKernel), {
    format,
    bytes,
    fileName: "part",
    sharesFaces,
  });

const plate = readFileSync(new URL("../../fixtures/plate.brep", import.meta.url));
const plateText = plate.toString("latin1");

const SAMPLES = 12;
const samples = (first: number, last: number) =>
  Array.from({ length: SAMPLES + 1 }, (_, k) => first + ((last - first) * k) / SAMPLES);

/** Returns the largest distance of edges in the plane from edges in space, beyond their tolerance. */
function largestGap(model: TrimmedModel): number {
  let largest = 0;
  for (const face of model.faces) {
    const surface = surfaceOf(model, face);
    for (const { edge: index, inPlane } of face.loops.flat()) {
      const edge = edgeOf(model, index);
      for (const t of samples(edge.first, edge.last)) {
        const [u = 0, v = 0] = curveAt(inPlane, t);
        largest = Math.max(
          largest,
          distance(surfaceAt(surface, u, v), edgeAt(model, edge, t)) - edge.tolerance,
        );
      }
    }
  }
  return largest;
}

/** Returns the largest distance in space between the end of an edge and the beginning of the next one in its loop, in the plane. */
function largestOpening(model: TrimmedModel): number {
  const openings = model.faces.flatMap((face) =>
    face.loops.flatMap((loop) => {
      const ends = loop.map(({ edge, reversed, inPlane }) => {
        const { first, last } = edgeOf(model, edge);
        const both = [curveAt(inPlane, first), curveAt(inPlane, last)];
        return reversed ? both.toReversed() : both;
      });
      return ends.map(([, end = []], k) => distance(end, ends[(k + 1) % ends.length]?.[0] ?? []));
    }),
  );
  return Math.max(...openings);
}

/** Returns the edges that the faces of a solid do not use exactly once in each direction. */
function unpairedEdges(model: TrimmedModel, solid: number): number[] {
  const uses = new Map<number, number[]>();
  for (const face of model.faces) {
    const isBefore = face.otherSolid === solid;
    if (face.solid !== solid && !isBefore) continue;
    for (const { edge, reversed } of face.loops.flat()) {
      // A degenerate edge is one vertex, with one face.
      if (edgeOf(model, edge).curve === undefined) continue;
      const direction = reversed !== (face.reversed !== isBefore) ? 1 : -1;
      uses.set(edge, [...(uses.get(edge) ?? []), direction]);
    }
  }
  return [...uses].filter(([, all]) => all.length !== 2 || all[0] === all[1]).map(([edge]) => edge);
}

const kindsIn = (model: TrimmedModel): FaceSurface["kind"][] =>
  [...new Set(model.faces.map((face) => surfaceOf(model, face).kind))].sort();

describe("a solid made by the kernel", () => {
  const kinds: Record<keyof ReturnType<typeof solidMakers>, FaceSurface["kind"][]> = {
    "a drilled box": ["cylinder", "plane"],
    "a box with a round edge": ["cylinder", "plane"],
    "a ball": ["sphere"],
    "a ring": ["torus"],
    "a cylinder with a round rim": ["cylinder", "plane", "torus"],
    "a frustum": ["cone", "plane"],
    "a vase": ["plane", "spline"],
    "an extruded ellipse": ["extrusion", "plane"],
    "a turned ellipse": ["revolution"],
  };
  const names = Object.keys(kinds) as (keyof typeof kinds)[];

  test.each(names)("is described from STEP and from BREP: %s", async (name) => {
    const shape = solidMakers(kernel)[name]();
    const volume = kernelVolume(kernel, shape);
    const brep = new TextEncoder().encode(kernel.BRepToolsWrapper.Write(shape));
    for (const model of [await read("step", stepOf(kernel, shape)), await read("brep", brep)]) {
      expect(kindsIn(model)).toEqual(kinds[name]);
      expect(model.solids).toMatchObject([{ isSolid: true, missingFaces: 0 }]);
      expect(model.notes).toEqual([]);
      expect(largestGap(model)).toBeLessThan(1e-9);
      expect(largestOpening(model)).toBeLessThan(1e-6);
      expect(unpairedEdges(model, 0)).toEqual([]);
      expect(Math.abs(volumeOf(model, 0) / volume - 1)).toBeLessThan(3e-3);
    }
  });

  test("has the positions of the kernel on all its faces", () => {
    const { TopAbs_FACE, TopAbs_SHAPE } = kernel.TopAbs_ShapeEnum;
    for (const name of names) {
      const text = kernel.BRepToolsWrapper.Write(solidMakers(kernel)[name]());
      const model = trimmedModelOfBrep(text, name);
      const explorer = new kernel.TopExp_Explorer(
        kernel.BRepToolsWrapper.Read(text),
        TopAbs_FACE,
        TopAbs_SHAPE,
      );
      for (const face of model.faces) {
        const theirs = kernel.BRep_Tool.Surface(kernel.TopoDS.Face(explorer.Current()));
        const ours = surfaceOf(model, face);
        for (const { edge, inPlane } of face.loops.flat()) {
          const { first, last } = edgeOf(model, edge);
          for (const t of samples(first, last)) {
            const [u = 0, v = 0] = curveAt(inPlane, t);
            const point = theirs.Value(u, v);
            expect(distance(surfaceAt(ours, u, v), [point.X(), point.Y(), point.Z()])).toBeLessThan(
              1e-12 * 20,
            );
          }
        }
        explorer.Next();
      }
      expect(explorer.More()).toBe(false);
    }
  });
});

describe("a file", () => {
  test("of STEP has names and colours: those of faces, else that of the solid", async () => {
    const [red, grey] = [
      [0.8, 0.1, 0.2],
      [0.5, 0.5, 0.5],
    ] as const;
    const step = stepFile([
      boxSolid("K\\X\\F6rper", [0, 0, 0], [1, 2, 3], { color: grey, colors: [undefined, red] }),
    ]);
    const { faces, solids } = await read("step", step);
    expect(solids.map(({ name }) => name)).toEqual(["Körper"]);
    faces.forEach(({ color }, f) => {
      (f === 1 ? red : grey).forEach((part, i) => expect(color?.[i]).toBeCloseTo(part, 12));
    });
  });

  test("of BREP needs no kernel, also in the format's first version", async () => {
    const never = () => Promise.reject(new Error("loaded"));
    const model = await readTrimmedModel(never, { format: "brep", bytes: plate, fileName: "plate.brep" });
    expect(kindsIn(model)).toEqual(["cylinder", "plane"]);
    expect(model.faces).toHaveLength(7);
    expect(Math.abs(volumeOf(model, 0) / (20 * 10 * 8 - Math.PI * 9 * 8) - 1)).toBeLessThan(1e-3);
  });

  test("gives the same model each time", async () => {
    const bytes = stepOf(kernel, solidMakers(kernel)["a drilled box"]());
    expect(await read("step", bytes)).toEqual(await read("step", bytes));
  });

  test.each([
    ["mm", 1],
    ["m", 1000],
    ["inch", 25.4],
  ] as const)("in %s is converted to millimetres", async (unit, factor) => {
    const model = await read("step", stepFile([boxSolid("box", [0, 0, 0], [1, 2, 3])], unit));
    expect(Math.abs(volumeOf(model, 0) / (6 * factor ** 3) - 1)).toBeLessThan(1e-9);
  });

  test("with two solids has each face at its solid", async () => {
    const step = stepOf(kernel, together(kernel, [boxAt(kernel, [0, 0, 0], 1), boxAt(kernel, [5, 0, 0], 1)]));
    const model = await read("step", step);
    expect(model.solids).toHaveLength(2);
    const lefts = model.faces.map((face) => {
      const { start } = edgeOf(model, face.loops[0]?.[0]?.edge ?? -1);
      return [face.solid, (vertexAt(model, start)[0] ?? 0) > 3 ? 1 : 0];
    });
    expect(lefts.every(([solid, side]) => solid === side)).toBe(true);
  });
});

describe("two solids", () => {
  test("that touch share the common part of their faces after the general fuse", async () => {
    const boxes = together(kernel, [boxAt(kernel, [0, 0, 0], 2), boxAt(kernel, [2, 1, 0], 2)]);
    const bytes = stepOf(kernel, boxes);
    const apart = await read("step", bytes);
    expect(apart.faces.filter(({ otherSolid }) => otherSolid !== undefined)).toEqual([]);
    const model = await read("step", bytes, true);
    // Both faces x = 2 are cut along the common half: three pieces instead of two faces.
    expect(model.faces).toHaveLength(13);
    const shared = model.faces.filter(({ otherSolid }) => otherSolid !== undefined);
    expect(shared.map(({ solid, otherSolid }) => [solid, otherSolid])).toEqual([[0, 1]]);
    for (const solid of [0, 1]) {
      expect(unpairedEdges(model, solid)).toEqual([]);
      expect(Math.abs(volumeOf(model, solid) / 8 - 1)).toBeLessThan(1e-9);
    }
  });
});

describe("a damaged file", () => {
  const failureOf = (text: string): CadFileError => {
    try {
      trimmedModelOfBrep(text, "plate.brep");
    } catch (failure) {
      if (failure instanceof CadFileError) return failure;
      throw failure;
    }
    throw new Error("the file was read");
  };

  test("is named, with the line and what to do", () => {
    const failure = failureOf(plateText.replace("2 10 5 1 0 -0 1 3", "2 10 x 1 0 -0 1 3"));
    expect(failure.message).toBe('plate.brep: line 24: expected a number, found "x"');
    expect(failure.remedy).toMatch(/^Export the part again/);
  });

  test("ends with an error wherever it is cut off", () => {
    for (let length = 0; length < plateText.length - 20; length += 97)
      expect(failureOf(plateText.slice(0, length)).fileName).toBe("plate.brep");
  });

  test("of STEP ends with an error", async () => {
    const bytes = new TextEncoder().encode("ISO-10303-21;\nHEADER;\nENDSEC;\nEND-ISO-10303-21;\n");
    await expect(read("step", bytes)).rejects.toThrow(CadFileError);
  });
});
