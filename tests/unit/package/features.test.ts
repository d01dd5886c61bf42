/** Lists of features evaluated by the kernel: volumes, areas, names of faces and edges, failures. */
import { beforeAll, describe, expect, test } from "vitest";

import { lengthOf, minus, pointOf } from "../../../wasm/dist/base/vectors.js";
import { partsOfBrep, trimmedModelOfBrep } from "../../../wasm/dist/cad/brep-model.js";
import { evaluate, withShape } from "../../../wasm/dist/cad/features/evaluate.js";
import { partOfFile } from "../../../wasm/dist/cad/features/import.js";
import type { Feature } from "../../../wasm/dist/cad/features/feature.js";
import { edgeName } from "../../../wasm/dist/cad/features/named-solid.js";
import type { FeatureKernel } from "../../../wasm/dist/cad/features/session.js";
import { box, CASES, drill, type FeatureCase } from "../../support/feature-cases.js";
import {
  boxFeature,
  circleLoop,
  measured,
  namesOf,
  polygonLoop,
  squareLoop,
  UPRIGHT,
} from "../../support/features.js";
import { testKernel } from "../../support/kernel-shapes.js";
import { boxSolid, drilledSolid, stepFile } from "../../support/step-files.js";
import { curveAt, edgeOf, surfaceAt, surfaceOf } from "../../support/trimmed-surfaces.js";

let kernel: FeatureKernel;
beforeAll(async () => {
  kernel = await testKernel();
});

const { PI } = Math;
const operation = "new";

describe("a file as the first feature", () => {
  const drilled = stepFile([drilledSolid("part", [0, 0, 0], [4, 4, 1], [2, 2], 1)]);
  const hole: Feature = {
    id: 2,
    type: "hole",
    position: [0.5, 0.5, 1],
    axis: [0, 0, -1],
    diameter: 0.25,
  };

  test.each([
    ["mm", 1],
    ["cm", 0.1],
  ])("has the size of the file in %s, and takes holes", (_, scale) => {
    const { brep } = partOfFile(kernel, { format: "step", bytes: drilled, scale });
    const whole: Feature = { id: 1, type: "import", operation, brep };
    const before = measured(kernel, [whole]);
    expect(before.failures).toEqual([]);
    expect(before.volume).toBeCloseTo((16 - PI) * scale ** 3, 9);
    expect(before.faces).toContain("1/face 1");
    if (scale !== 1) return;
    const after = measured(kernel, [whole, hole]);
    expect(after.failures).toEqual([]);
    expect(after.volume).toBeCloseTo(before.volume - PI / 64, 9);
    const text = new TextEncoder().encode(brep);
    expect(
      measured(kernel, [{ ...whole, ...partOfFile(kernel, { format: "brep", bytes: text, scale: 1 }) }])
        .volume,
    ).toBeCloseTo(before.volume, 9);
  });

  test("keeps the names and colours of its faces", () => {
    const red = [0.8, 0.1, 0.2] as const;
    const colors = [undefined, red];
    const solids = [1, 2].map((k) => boxSolid("box", [3 * k, 0, 0], [k, k, k], { colors }));
    let face = 0;
    const text = new TextDecoder().decode(stepFile(solids));
    const named = text.replaceAll("ADVANCED_FACE('',", () => `ADVANCED_FACE('side ${++face}',`);
    const bytes = new TextEncoder().encode(named);
    const { looks, brep } = partOfFile(kernel, { format: "step", bytes, scale: 0.1 });
    expect(looks?.map(({ name }) => name)).toEqual(Array.from({ length: 12 }, (_, f) => `side ${f + 1}`));
    looks?.forEach(({ color }, f) => {
      if (f % 6 !== 1) expect(color).toBeUndefined();
      else red.forEach((part, k) => expect(color?.[k]).toBeCloseTo(part, 12));
    });
    const { faces } = measured(kernel, [{ id: 1, type: "import", operation, brep }]);
    expect(faces).toEqual(looks?.map((_, f) => `1/face ${f + 1}`));
  });

  test("is refused without a solid", () => {
    const bytes = new TextEncoder().encode("ISO-10303-21;");
    expect(() => partOfFile(kernel, { format: "step", bytes, scale: 1 })).toThrow("no solid");
  });
});

describe("the kernel makes", () => {
  test.each(Object.keys(CASES))("%s", (name) => {
    const { features, volume, area, faces } = CASES[name] as FeatureCase;
    const result = measured(kernel, features);
    expect(result.failures).toEqual([]);
    expect(result.volume / volume).toBeCloseTo(1, 9);
    if (area !== undefined) expect(result.area / area).toBeCloseTo(1, 9);
    expect([...result.faces].sort()).toEqual([...faces].sort());
  });

  test.each(Object.keys(CASES))(
    "faces in the order of the written text, closed and the same twice: %s",
    (name) => {
      const { features } = CASES[name] as FeatureCase;
      const first = evaluate(kernel, features);
      expect(evaluate(kernel, features)).toEqual(first);
      const model = trimmedModelOfBrep(first.brep, name);
      expect(model.notes).toEqual([]);
      expect(model.faces).toHaveLength(first.faces.length);
      const uses = new Map<number, string[]>();
      model.faces.forEach(({ loops }, f) => {
        for (const { edge } of loops.flat())
          if (edgeOf(model, edge).curve !== undefined)
            uses.set(edge, [...(uses.get(edge) ?? []), first.faces[f] ?? ""]);
      });
      // The edges of the text are those of the evaluation, between the same faces: so each face has its own name.
      const pairs = (all: readonly (readonly string[])[]) =>
        all.map((names) => [...names].sort().join(" & ")).sort();
      expect(pairs([...uses.values()])).toEqual(pairs(first.edges.map(({ faces }) => faces)));
    },
  );
});

test("solids are imported with numbered faces", () => {
  const { brep } = evaluate(kernel, [box]);
  const result = measured(kernel, [{ id: 4, type: "import", operation, brep }]);
  expect(result.volume).toBeCloseTo(6000, 9);
  expect(result.faces).toEqual([1, 2, 3, 4, 5, 6].map((k) => `4/face ${k}`));
});

test("a loft through three circles and a spline around an axis have the volume of their sections' integral", () => {
  const loft = measured(kernel, [
    {
      id: 1,
      type: "loft",
      operation,
      sections: [0, 4, 8].map((z) => ({ outer: circleLoop(2 + z / 8, [0, 0, z]) })),
    },
  ]);
  expect(loft.volume / ((PI * 8 * (4 + 6 + 9)) / 3)).toBeCloseTo(1, 4);
  const points = Array.from({ length: 32 }, (_, k) => {
    const angle = (2 * PI * k) / 32;
    return [Math.cos(angle), Math.sin(angle), 0] as const;
  });
  const spline = measured(kernel, [
    {
      id: 1,
      type: "extrude",
      operation,
      profile: { outer: [{ kind: "spline", points, isClosed: true }] },
      vector: [0, 0, 2],
    },
  ]);
  expect(spline.volume / (2 * PI)).toBeCloseTo(1, 4);
});

/** A plate with a wall, holes, fillets and a shell; `t` changes all dimensions. */
const bracket = (t: number): Feature[] => [
  boxFeature(1, [80 + t, 40 + t, 10]),
  boxFeature(2, [10, 40 + t, 30 + t], [0, 0, 10], "join"),
  { id: 3, type: "hole", position: [70, 10, 10], axis: [0, 0, -1], diameter: 6 + t / 10 },
  { id: 4, type: "linear-array", step: [0, 20, 0], count: 2, features: [3] },
  { id: 5, type: "linear-array", step: [-40, 0, 0], count: 2, features: [3] },
  { id: 6, type: "fillet", edges: ["1/top|2/right", "2/right|2/top"], radius: 3 + t / 20 },
];

describe("names", () => {
  test("do not depend on dimensions", () => {
    const names = namesOf(kernel, bracket(0));
    expect(names).toContain("6/fillet 1/top|2/right");
    for (const t of [-5, 1, 4, 9]) {
      const result = measured(kernel, bracket(t));
      expect(result.failures).toEqual([]);
      expect([...result.faces].sort()).toEqual(names);
    }
  });

  test("remain at surfaces of the same kind when dimensions change", () => {
    const centres = [0, 4].map((t) => {
      const { brep, faces } = evaluate(kernel, bracket(t));
      const model = trimmedModelOfBrep(brep, "bracket");
      return new Map(
        model.faces.map((face, f) => {
          const coedge = face.loops[0]?.[0];
          if (coedge === undefined) throw new Error("a face has no loop");
          const { first } = edgeOf(model, coedge.edge);
          const [u = 0, v = 0] = curveAt(coedge.inPlane, first);
          const kind = surfaceOf(model, face).kind;
          return [faces[f], { kind, at: surfaceAt(surfaceOf(model, face), u, v) }];
        }),
      );
    });
    const [before, after] = centres;
    for (const [name, { kind }] of before ?? []) expect(after?.get(name)?.kind).toBe(kind);
  });

  test("of other faces remain when features are switched off", () => {
    const all = namesOf(kernel, bracket(0));
    const off = bracket(0).map((feature) =>
      feature.id === 5 || feature.id === 6 ? { ...feature, isOff: true } : feature,
    );
    const names = namesOf(kernel, off);
    expect(names).toEqual(all.filter((name) => !/^[56]\//.test(name)));
  });

  test("remain when features change their order", () => {
    const [plate, wall, hole, ...others] = bracket(0) as [Feature, Feature, Feature, ...Feature[]];
    const names = namesOf(kernel, [plate, wall, hole, ...others]);
    expect(namesOf(kernel, [plate, hole, wall, ...others])).toEqual(names);
  });

  test("of features repeated after a motion follow it", () => {
    const array: Feature = { id: 4, type: "linear-array", step: [0, 10, 0], count: 2, features: [2] };
    const move: Feature = {
      id: 3,
      type: "move",
      rotation: { position: [0, 0, 0], axis: [1, 0, 0], angle: 90 },
    };
    const result = measured(kernel, [box, drill, move, { ...array, step: [0, 0, 10] }]);
    expect(result.volume).toBeCloseTo(measured(kernel, [box, drill, array]).volume, 6);
    expect(result.faces).toContain("4/2 2/side");
  });

  test("of the pieces of a split face are numbered by their places", () => {
    const slot = boxFeature(2, [20, 4, 40], [-5, 8, 25], "cut");
    const { faces, edges } = evaluate(kernel, [box, slot]);
    expect(faces.filter((name) => name.startsWith("1/top")).sort()).toEqual(["1/top", "1/top#2"]);
    const meanY = (name: string) => {
      const points = edges.find((edge) => edge.name === name)?.points ?? new Float64Array();
      return ((points[1] ?? NaN) + (points.at(-2) ?? NaN)) / 2;
    };
    expect(meanY(edgeName("1/top", "1/front"))).toBe(0);
    expect(meanY(edgeName("1/top#2", "1/back"))).toBe(20);
  });

  test("of edges distinguish several between the same faces", () => {
    const { edges } = evaluate(kernel, [
      { id: 1, type: "cylinder", operation, ...UPRIGHT, radius: 5, height: 10 },
      boxFeature(2, [20, 2, 10], [-10, 0, 0], "intersect"),
    ]);
    const names = edges.map(({ name }) => name);
    expect(new Set(names).size).toBe(names.length);
    expect(names).toContain("1/side|2/front");
    expect(names).toContain("1/side#2|2/front");
  });

  test("of edges run along the edges", () => {
    const { edges } = evaluate(kernel, [
      { id: 1, type: "cylinder", operation, ...UPRIGHT, radius: 5, height: 10 },
    ]);
    expect(edges.map(({ name }) => name).sort()).toEqual([
      "1/bottom|1/side",
      "1/side|1/side",
      "1/side|1/top",
    ]);
    const top = edges.find(({ name }) => name === "1/side|1/top")?.points ?? new Float64Array();
    expect(top.length).toBeGreaterThan(3 * 20);
    for (let p = 0; p < top.length / 3; p++)
      expect(lengthOf(minus(pointOf(top, p), [0, 0, 10]))).toBeCloseTo(5, 9);
  });
});

describe("a feature that fails is left out", () => {
  const failing: Record<string, readonly [feature: Feature, message: RegExp, remedy: RegExp]> = {
    "a fillet that is too large": [
      { id: 7, type: "fillet", edges: ["1/front|1/right"], radius: 50 },
      /no such faces along the edges/,
      /smaller radius/,
    ],
    "a fillet along an edge that is not there": [
      { id: 7, type: "fillet", edges: ["1/front|9/right"], radius: 1 },
      /no edge 1\/front\|9\/right/,
      /Choose the edge again/,
    ],
    "a chamfer that is too large": [
      { id: 7, type: "chamfer", edges: ["1/front|1/right"], distance: 50 },
      /./,
      /smaller distance/,
    ],
    "a shell that is too thick": [
      { id: 7, type: "shell", openFaces: ["1/top"], thickness: 8 },
      /./,
      /smaller thickness/,
    ],
    "a shell without a face": [
      { id: 7, type: "shell", openFaces: ["3/top"], thickness: 1 },
      /no face 3\/top/,
      /Choose the face again/,
    ],
    "an intersection with nothing": [
      boxFeature(7, [1, 1, 1], [100, 0, 0], "intersect"),
      /Nothing is left/,
      /Change its size or its place/,
    ],
    "a hole through all that begins at the bottom, downwards": [
      { id: 7, type: "hole", position: [5, 5, 0], axis: [0, 0, -1], diameter: 2 },
      /points away/,
      /Reverse the axis/,
    ],
    "a hole of some depth that begins there": [
      { id: 7, type: "hole", position: [5, 5, 0], axis: [0, 0, -1], diameter: 2, depth: 3 },
      /nothing is cut/,
      /its place/,
    ],
    "a cut beside the solid": [
      boxFeature(7, [1, 1, 1], [100, 0, 0], "cut"),
      /nothing is cut/,
      /Change its size or its place/,
    ],
    "a cut of everything": [boxFeature(7, [100, 100, 100], [-1, -1, -1], "cut"), /Nothing is left/, /./],
    "a box without width": [
      boxFeature(7, [1, 0, 1], [0, 0, 0], "join"),
      /width must be a positive/,
      /Change the width/,
    ],
    "a length that is no number": [
      boxFeature(7, [1, NaN, 1], [0, 0, 0], "join"),
      /not finite/,
      /Change the number/,
    ],
    "an axis without length": [
      {
        id: 7,
        type: "cylinder",
        operation: "join",
        position: [0, 0, 0],
        axis: [0, 0, 0],
        radius: 1,
        height: 1,
      },
      /./,
      /./,
    ],
    "an open loop": [
      {
        id: 7,
        type: "extrude",
        operation: "join",
        profile: { outer: squareLoop(0, 1).slice(0, 3) },
        vector: [0, 0, 1],
      },
      /Curve 1 of a loop does not begin where/,
      /loops are closed/,
    ],
    "a loop that intersects itself": [
      {
        id: 7,
        type: "extrude",
        operation: "join",
        profile: { outer: polygonLoop([0, 0, 0], [9, 9, 0], [9, 0, 0], [0, 5, 0]) },
        vector: [0, 0, 99],
      },
      /intersect itself/,
      /do not intersect/,
    ],
    "a loop in no plane": [
      {
        id: 7,
        type: "extrude",
        operation: "join",
        profile: { outer: polygonLoop([0, 0, 0], [9, 0, 0], [9, 9, 1], [0, 9, 0]) },
        vector: [0, 0, 99],
      },
      /not in one plane/,
      /./,
    ],
    "a damaged file": [
      { id: 7, type: "import", operation: "join", brep: "no shape" },
      /./,
      /file is damaged/,
    ],
    "an array of a feature without a piece": [
      { id: 7, type: "linear-array", step: [1, 0, 0], count: 2, features: [3] },
      /Feature 3 has no piece/,
      /./,
    ],
    "a tool that fails": [
      { id: 7, type: "boolean", operation: "cut", tool: [boxFeature(1, [1, 1, -1])] },
      /In feature 1 of the tool: The height must be/,
      /Change the height/,
    ],
    "an id that occurs twice": [boxFeature(1, [99, 99, 99], [0, 0, 0], "join"), /same id/, /another id/],
  };

  test.each(Object.keys(failing))("%s", (name) => {
    const [feature, message, remedy] = failing[name] as (typeof failing)[string];
    const after = { ...drill, id: 8 };
    const expected = evaluate(kernel, [box, after]);
    const { failures, ...result } = evaluate(kernel, [box, feature, after]);
    expect(failures).toHaveLength(1);
    expect(failures[0]?.feature).toBe(feature.id);
    expect(failures[0]?.message).toMatch(message);
    expect(failures[0]?.message).toMatch(/\.$/);
    expect(failures[0]?.remedy).toMatch(remedy);
    expect({ ...result, failures: [] }).toEqual(expected);
  });

  test("and nothing is left without a first piece", () => {
    const { brep, faces, failures } = evaluate(kernel, [drill, { ...box, operation: "cut" }]);
    expect([brep, faces]).toEqual(["", []]);
    expect(failures.map(({ message }) => message)).toEqual([
      "There is no solid before it.",
      "There is no solid before it.",
    ]);
  });
});

test("a crash of the kernel is reported, and that it must not be used again", () => {
  const crashing = new Proxy(kernel, {
    get: (target, key, receiver) => {
      if (key === "BRepAlgoAPI_Cut")
        return class {
          constructor() {
            throw new WebAssembly.RuntimeError("unreachable");
          }
        };
      return Reflect.get(target, key, receiver) as unknown;
    },
  });
  const result = evaluate(crashing, [box, drill]);
  expect(result.isKernelSpent).toBe(true);
  expect(result.failures.map(({ feature }) => feature)).toEqual([2]);
  expect(result.brep).toBe("");
});

test("the shape can be triangulated before it is written", () => {
  const { result: text = "", faces } = withShape(kernel, bracket(0), (shape) => {
    new kernel.BRepMesh_IncrementalMesh(shape, 0.1, false, 0.3, false).delete();
    return kernel.BRepToolsWrapper.Write(shape);
  });
  const parts = partsOfBrep(text, "bracket").flatMap((part) => part.faces);
  expect(parts).toHaveLength(faces.length);
  for (const { triangulation } of parts) expect(triangulation?.triangles.length).toBeGreaterThan(0);
});

test("the memory of the kernel does not grow", () => {
  const bytes = () => kernel.wasmMemory.buffer.byteLength;
  const features = [
    ...bracket(0).filter(({ type }) => type !== "fillet"),
    { id: 7, type: "move", translation: [1, 2, 3] } as const,
    boxFeature(8, [1, 1, -1]),
  ];
  for (let k = 0; k < 3; k++) evaluate(kernel, features);
  const before = bytes();
  for (let k = 0; k < 10; k++) evaluate(kernel, features);
  expect(bytes()).toBe(before);
});
