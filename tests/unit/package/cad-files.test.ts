/** STEP, IGES and BREP files: solids as regions, faces as patches, units, colours, interfaces, errors. */
import { readFileSync } from "node:fs";

import { createMesher, readMesh, readSurface, type Mesher, type Mesh } from "tetrafront";
import { bodySurface, createBodies, readProject } from "tetrafront/project";
import { afterAll, beforeAll, describe, expect, test, vi } from "vitest";

import { withoutPause } from "../../../wasm/dist/base/steps.js";
import { askForCad } from "../../../wasm/dist/cad/cad-client.js";
import { stepNotes, stepText } from "../../../wasm/dist/formats/step-text.js";
import { mutated, randomSource } from "../../support/random.js";
import { boxSolid, drilledSolid, pinSolid, stepFile } from "../../support/step-files.js";
import { temporaryFolder } from "../../support/temporary-folder.js";

const { save, run, inFolder } = temporaryFolder();
let mesher: Mesher;
beforeAll(async () => {
  mesher = await createMesher();
});
afterAll(() => mesher.dispose());

async function surfaceIn(file: Uint8Array, fileName: string): Promise<Mesh> {
  const read = await readSurface(file, { fileName });
  if (!read.success) throw new Error(read.errors[0].message);
  return read.value;
}

const namesIn = ({ patches }: Mesh) => patches.map(({ name }) => name);
const regionsIn = ({ surfaceRegions }: Mesh) => surfaceRegions?.regions.map(({ name }) => name);

function trianglesOf(surface: Mesh, patch: string): number {
  const index = namesIn(surface).indexOf(patch);
  return surface.trianglePatch.filter((owner) => owner === index).length;
}

/** Files that come with the library. */
const sample = (name: string) =>
  readFileSync(new URL(`../../../node_modules/occt-import-js/test/testfiles/${name}`, import.meta.url));

const plate = stepFile([drilledSolid("plate", [0, 0, 0], [20, 10, 8], [8, 5], 3)]);
const plateVolume = 20 * 10 * 8 - Math.PI * 9 * 8;

describe("a solid", () => {
  test("becomes a closed region, its faces patches in the order of the file", async () => {
    const surface = await surfaceIn(plate, "plate.step");
    expect(namesIn(surface)).toEqual([1, 2, 3, 4, 5, 6, 7].map((n) => `face ${n}`));
    expect(surface.patches.map(({ tag }) => tag)).toEqual([1, 2, 3, 4, 5, 6, 7]);
    expect(regionsIn(surface)).toEqual(["plate"]);
    expect(surface.unit).toBe("mm");
    expect(trianglesOf(surface, "face 1")).toBe(2);
    const found = await mesher.inspectSurface(surface);
    expect(found).toMatchObject({ isFillable: true, regions: 1, flippedTriangles: 0 });
    expect(Math.abs(found.volume / plateVolume - 1)).toBeLessThan(2e-4 + 0.0017 * (226 / plateVolume));
  });

  test("keeps its colours: those of faces, else that of the solid", async () => {
    const [red, grey] = [
      [0.8, 0.1, 0.2],
      [0.5, 0.5, 0.5],
    ] as const;
    const solid = boxSolid("box", [0, 0, 0], [1, 2, 3], { color: grey, colors: [undefined, red] });
    const { patches } = await surfaceIn(stepFile([solid]), "box.stp");
    patches.forEach(({ color }, p) => {
      (p === 1 ? red : grey).forEach((part, i) => expect(color?.[i]).toBeCloseTo(part, 5));
    });
  });

  test.each([
    ["mm", 1],
    ["m", 1000],
    ["inch", 25.4],
  ] as const)("in %s is converted to millimetres", async (unit, factor) => {
    const { points } = await surfaceIn(stepFile([boxSolid("box", [0, 0, 0], [1, 2, 3])], unit), "box.step");
    [0, 1, 2].forEach((axis) => {
      const all = points.filter((_, i) => i % 3 === axis);
      expect(Math.max(...all) - Math.min(...all)).toBeCloseTo((axis + 1) * factor, 8);
    });
  });

  test("is triangulated finely enough for a small target size", async () => {
    const lens = stepFile([pinSolid("disc", [0, 0, 0], 100, 1)]);
    const [coarse, fine] = await Promise.all(
      [undefined, 0.05].map(async (size) => {
        const read = await readSurface(lens, { fileName: "disc.step", size });
        return read.success ? read.value.triangles.length : 0;
      }),
    );
    expect(fine).toBeGreaterThan(3 * (coarse ?? 0));
  });

  test("is read at once and completely for a size of nearly nothing", async () => {
    const pin = stepFile([pinSolid("pin", [0, 0, 0], 3, 8)]);
    const read = await readSurface(pin, { fileName: "pin.step", size: 1e-6 });
    if (!read.success) throw new Error(read.errors[0].message);
    expect(read.value.triangles.length / 3).toBeGreaterThan(100);
    expect(read.value.triangles.length / 3).toBeLessThan(1e5);
  });

  test("that takes too long is given up, and its worker ends", async () => {
    const deflection = { distance: 0.1, isRelative: false, angle: 0.1 };
    const request = { format: "step", bytes: plate, deflection } as const;
    const late = await askForCad(request, undefined, { reading: 1e-6 });
    expect(late).toEqual({ kind: "timed-out", seconds: 1e-6 });
    expect((await askForCad(request, undefined)).kind).toBe("read");
  });

  test("of a BREP file has no unit", async () => {
    const surface = await surfaceIn(
      readFileSync(new URL("../../fixtures/plate.brep", import.meta.url)),
      "plate.brep",
    );
    expect([surface.unit, namesIn(surface).length]).toEqual([undefined, 7]);
    const { volume, isFillable } = await mesher.inspectSurface(surface);
    expect(isFillable).toBe(true);
    expect(Math.abs(volume / plateVolume - 1)).toBeLessThan(1e-3);
  });

  test("of an IGES file is closed", async () => {
    const surface = await surfaceIn(sample("cube-10x10mm/Cube 10x10.igs"), "cube.igs");
    expect(namesIn(surface)).toHaveLength(6);
    expect(await mesher.inspectSurface(surface)).toMatchObject({ isFillable: true, volume: 1000 });
  });
});

describe("an assembly", () => {
  test("of two boxes that touch has two regions with one interface", async () => {
    const file = stepFile([boxSolid("left", [0, 0, 0], [2, 1, 1]), boxSolid("right", [2, 0, 0], [3, 1, 1])]);
    const surface = await surfaceIn(file, "boxes.step");
    expect(regionsIn(surface)).toEqual(["left", "right"]);
    expect(namesIn(surface).filter((name) => name.includes("/"))).toEqual(["left / right"]);
    expect(namesIn(surface)).not.toContain("left face 2");
    expect(surface.triangles).toHaveLength(3 * 22);
    const { report, mesh: made } = await mesher.fillSurface(surface, { size: 0.5 });
    expect([report.status, report.quality.regions.length]).toEqual(["done", 2]);
    expect(report.volume).toBeCloseTo(3, 9);
    const { triangleRegions = new Uint32Array() } = made;
    const interfaces = triangleRegions.filter((region, side) => side % 2 === 1 && region === 1);
    expect(interfaces.length).toBeGreaterThan(0);
  });

  test("joins curved faces that are triangulated differently: a pin in its hole", async () => {
    const file = stepFile([
      drilledSolid("plate", [0, 0, 0], [20, 10, 8], [8, 5], 3),
      pinSolid("pin", [8, 5, 0], 3, 8),
    ]);
    const surface = await surfaceIn(file, "pin.step");
    expect(namesIn(surface)).toContain("plate / pin");
    const found = await mesher.inspectSurface(surface);
    expect(found).toMatchObject({ isFillable: true, regions: 2 });
    expect(found.volume).toBeCloseTo(1600, 6);
  });

  test("names every instance of a part differently", async () => {
    const file = stepFile([boxSolid("nut", [0, 0, 0], [1, 1, 1]), boxSolid("nut", [5, 0, 0], [6, 1, 1])]);
    const surface = await surfaceIn(file, "nuts.step");
    expect(regionsIn(surface)).toEqual(["nut", "nut 2"]);
    expect(namesIn(surface)).toContain("nut 2 face 6");
  });

  test("reads the parts of a published assembly, each closed", async () => {
    const surface = await surfaceIn(sample("cax-if/as1_pe_203.stp"), "as1.stp");
    expect(regionsIn(surface)?.length).toBe(18);
    expect(surface.notes?.filter((note) => note.startsWith("not closed")) ?? []).toEqual([]);
  });

  test("of solids that touch in faces with different boundaries gets an interface", async () => {
    save(
      "tower.step",
      stepFile([boxSolid("base", [0, 0, 0], [2, 2, 1]), boxSolid("post", [0.5, 0.5, 1], [1, 1, 3])]),
    );
    const checked = await run("check", "tower.step");
    expect([checked.code, `${checked.stdout}${checked.stderr}`]).toEqual([
      0,
      expect.stringContaining("tower.step: no problems"),
    ]);
    const meshed = await run("mesh", "tower.step", "-o", "tower.msh", "--report", "tower.json");
    expect([meshed.code, meshed.stderr]).toEqual([
      0,
      expect.stringContaining('shared faces: "base" and "post"'),
    ]);
    expect(meshed.stderr).not.toMatch(/warning|repair/);
    const report = JSON.parse(readFileSync(inFolder("tower.json"), "utf8")) as { volume: number };
    expect(report.volume).toBeCloseTo(4.5, 6);
    const written = await readMesh(readFileSync(inFolder("tower.msh")), { fileName: "tower.msh" });
    if (!written.success) throw new Error(written.errors[0].message);
    expect(written.value.regions.map(({ name }) => name)).toEqual(["base", "post"]);
  });
});

describe("solids that overlap", () => {
  test.each([
    ["in depth", [0.5, 0.5, 0.5], [1, 1, 3]],
    ["along common planes", [1, 0, 0], [3, 2, 1]],
  ] as const)("%s are meshed, with a warning that names them", async (_, low, high) => {
    save("a.step", stepFile([boxSolid("base", [0, 0, 0], [2, 2, 1]), boxSolid("post", low, high)]));
    for (const args of [
      ["mesh", "a.step", "-o", "a.msh", "--report", "a.json"],
      ["remesh", "a.step", "-o", "a.ply"],
    ]) {
      const { code, stderr } = await run(...args);
      expect([code, stderr]).toEqual([
        0,
        expect.stringContaining('warning: a.step: The solids "base" and "post" overlap'),
      ]);
    }
    const { diagnostics } = JSON.parse(readFileSync(inFolder("a.json"), "utf8")) as {
      diagnostics: { code: string }[];
    };
    expect(diagnostics.map(({ code }) => code)).toContain("touching-solids");
  });
});

describe("bodies", () => {
  const blue = [0.1, 0.2, 0.8] as const;
  const solids = stepFile([
    boxSolid("left", [0, 0, 0], [2, 1, 1]),
    boxSolid("right", [2, 0, 0], [3, 1, 1]),
    boxSolid("far", [5, 0, 0], [6, 1, 1], { color: blue }),
  ]);

  test("are the solids that touch no other, with their names, patches and colours", async () => {
    const bodies = createBodies(await surfaceIn(solids, "a.step"), { id: 4, firstPatchId: 10, name: "a" });
    expect(bodies.map(({ id, name }) => [id, name])).toEqual([
      [4, "left + right"],
      [5, "far"],
    ]);
    const ids = bodies.flatMap(({ patches }) => patches.map(({ id }) => id));
    expect(ids).toEqual(Array.from({ length: 11 + 6 }, (_, p) => 10 + p));
    expect(bodies[0]?.patches.map(({ name }) => name)).toContain("left / right");
    bodies[1]?.patches.forEach(({ color }) => {
      blue.forEach((part, i) => expect(color?.[i]).toBeCloseTo(part, 5));
    });
    const found = await Promise.all(bodies.map((body) => mesher.inspectSurface(bodySurface(body))));
    expect(found.map(({ regions, volume }) => [regions, volume])).toEqual([
      [2, expect.closeTo(3, 9)],
      [1, expect.closeTo(1, 9)],
    ]);
  });

  test("are made of many solids in a time proportional to their triangles", () => {
    const [solids, each] = [2000, 200];
    const triangles = Uint32Array.from({ length: 3 * solids * each }, (_, i) => i % 3);
    const read = vi.spyOn(triangles, "subarray");
    const ofTriangle = Uint32Array.from({ length: solids * each }, (_, t) => Math.floor(t / each));
    const surface = {
      points: Float64Array.of(0, 0, 0, 1, 0, 0, 0, 1, 0),
      triangles,
      trianglePatch: ofTriangle,
      patches: Array.from({ length: solids }, (_, s) => ({ name: `face ${s}` })),
      surfaceRegions: {
        regions: Array.from({ length: solids }, (_, s) => ({ name: `part ${s}`, tag: s + 1 })),
        triangleRegions: Uint32Array.from({ length: 2 * solids * each }, (_, i) =>
          i % 2 === 0 ? (ofTriangle[i / 2] ?? 0) : 0xffffffff,
        ),
      },
    };
    const scans = vi.spyOn(Uint32Array.prototype, "forEach");
    const bodies = createBodies(surface, { id: 1, firstPatchId: 1 });
    expect(bodies.map(({ name, patches }) => [name, patches.length])).toEqual(
      surface.patches.map((_, s) => [`part ${s}`, 1]),
    );
    expect(read).toHaveBeenCalledTimes(solids * each);
    const isWhole = (scanned: unknown) => scanned instanceof Uint32Array && scanned.length === solids * each;
    expect(scans.mock.contexts.filter(isWhole)).toEqual([]);
    scans.mockRestore();
  });

  test("are those of a project, in millimetres, that `convert` writes and `mesh` meshes", async () => {
    save("a.step", solids);
    expect(await run("convert", "a.step", "-o", "a.json")).toMatchObject({ code: 0 });
    const read = readProject(readFileSync(inFolder("a.json"), "utf8"));
    if (!read.success) throw new Error(read.errors[0].message);
    expect([read.value.units, read.value.bodies?.length]).toEqual(["mm", 2]);
    const { code } = await run("mesh", "a.json", "-o", "a.vtu", "--size", "0.5", "--report", "a.report.json");
    const report = JSON.parse(readFileSync(inFolder("a.report.json"), "utf8")) as { volume: number };
    expect([code, report.volume]).toEqual([0, expect.closeTo(4, 6)]);
  });
});

describe("the command line", () => {
  test("meshes a STEP file well without options", async () => {
    save("plate.step", plate);
    const { code, stderr } = await run("mesh", "plate.step", "-o", "plate.msh", "--report", "plate.json");
    expect([code, stderr]).toEqual([0, expect.stringContaining("plate.step: remeshed: ")]);
    const report = JSON.parse(readFileSync(inFolder("plate.json"), "utf8")) as {
      volume: number;
      dihedral: { min: number };
      radiusRatio: { mean: number };
    };
    expect(report.dihedral.min).toBeGreaterThan(20);
    expect(report.radiusRatio.mean).toBeGreaterThan(0.8);
    // All nodes are on the faces, and the edges around the hole are chords.
    expect(Math.abs(report.volume / plateVolume - 1)).toBeLessThan(0.004);
    const written = await readMesh(readFileSync(inFolder("plate.msh")), { fileName: "plate.msh" });
    if (!written.success) throw new Error(written.errors[0].message);
    expect(written.value.patches.map(({ name }) => name)).toEqual(
      [1, 2, 3, 4, 5, 6, 7].map((n) => `face ${n}`),
    );
    expect(written.value.regions.map(({ name }) => name)).toEqual(["plate"]);
  });

  test("keeps the triangles of a STEP file if that is asked for", async () => {
    save("box.step", stepFile([boxSolid("box", [0, 0, 0], [1, 1, 1])]));
    const { code, stderr } = await run("mesh", "box.step", "-o", "box.vtu", "--surface", "keep");
    expect([code, stderr]).toEqual([0, expect.not.stringContaining("remeshed")]);
  });

  test("prints unit, solids and faces", async () => {
    save(
      "nuts.step",
      stepFile([boxSolid("nut", [0, 0, 0], [1, 1, 1]), boxSolid("bolt", [5, 0, 0], [6, 1, 1])]),
    );
    const { stdout } = await run("info", "nuts.step");
    expect(stdout).toContain("STEP, in mm\n");
    expect(stdout).toContain('region 2 "bolt": 12 triangles around it');
    expect(stdout).toContain('patch 12 "bolt face 6": 2');
  });

  test("converts, remeshes and checks STEP files", async () => {
    save("plate.step", plate);
    for (const args of [
      ["convert", "plate.step", "-o", "plate.stl"],
      ["remesh", "plate.step", "-o", "plate.ply"],
      ["check", "plate.step"],
    ]) {
      const { code, stdout, stderr } = await run(...args);
      const said = args[0] === "check" ? stdout : stderr;
      expect([args[0], code, said]).toEqual([args[0], 0, expect.stringContaining("plate.step: ")]);
    }
  });
});

describe("a file that cannot be read", () => {
  const errorOf = async (file: Uint8Array, fileName: string) => {
    const read = await readSurface(file, { fileName });
    return read.success ? undefined : read.errors[0];
  };

  test.each(["part.step", "part.iges", "part.brep"])(
    "as %s gives an error that names it",
    async (fileName) => {
      const nonsense = await errorOf(new TextEncoder().encode("nonsense"), fileName);
      expect(nonsense).toMatchObject({ code: "malformed-file", fileName });
      expect(nonsense?.message).toMatch(/^OpenCascade |a STEP file must begin/);
      expect(nonsense?.remedy).toMatch(/^Export the part /);
      expect(await errorOf(new Uint8Array(), fileName)).toMatchObject({ code: "empty-file", fileName });
    },
  );

  test("however it is damaged, gives a surface or an error with a remedy; the next file is read", async () => {
    const [box, iges, brep] = [
      stepFile([drilledSolid("plate", [0, 0, 0], [20, 10, 8], [8, 5], 3)]),
      sample("cube-10x10mm/Cube 10x10.igs"),
      readFileSync(new URL("../../fixtures/plate.brep", import.meta.url)),
    ];
    const files = [
      [box, "a.step"],
      [iges, "a.igs"],
      [brep, "a.brep"],
    ] as const;
    let refused = 0;
    const readOne = async (seed: number): Promise<void> => {
      const [file, fileName] = files[seed % 3] ?? files[0];
      const read = await readSurface(mutated(file, randomSource(seed)), { fileName });
      if (read.success) {
        const { points, triangles, trianglePatch, patches } = read.value;
        expect(points.every(Number.isFinite), `seed ${seed}`).toBe(true);
        expect(triangles.every((node) => 3 * node < points.length)).toBe(true);
        expect(trianglePatch.every((patch) => patch < patches.length)).toBe(true);
      } else {
        refused++;
        expect(read.errors[0].message, `seed ${seed}`).toMatch(
          /OpenCascade|no solids|empty|damaged|truncated|must begin/,
        );
        expect(read.errors[0].remedy).toMatch(/^[A-Z].*\.$/);
      }
    };
    // A file that keeps OpenCascade busy forever takes its whole time.
    let next = 1;
    const reader = async (): Promise<void> => {
      while (next <= SEEDS) await readOne(next++);
    };
    await Promise.all(Array.from({ length: READERS }, reader));
    expect(refused).toBeGreaterThan(SEEDS / 10);
    expect((await surfaceIn(box, "a.step")).triangles.length).toBeGreaterThan(100);
  });

  test("as BREP with other words in it, ends within the limit; the next file is read", async () => {
    const file = readFileSync(new URL("../../fixtures/plate.brep", import.meta.url));
    const request = {
      format: "brep",
      deflection: { distance: 0.001, isRelative: true, angle: 0.5 },
    } as const;
    const kinds = new Map<string, number>();
    const readOne = async (seed: number): Promise<void> => {
      const bytes = withOtherWords(file, randomSource(seed));
      // One file in twenty keeps OpenCascade busy: edges between vertices that are elsewhere. The others are read in 0.1 s.
      const reply = await askForCad({ ...request, bytes }, undefined, { reading: 2 });
      kinds.set(reply.kind, (kinds.get(reply.kind) ?? 0) + 1);
      const shapes = reply.kind === "read" ? reply.shapes : [];
      for (const { points, triangles, faces } of shapes) {
        expect(
          triangles.every((node) => 3 * node < points.length),
          `seed ${seed}`,
        ).toBe(true);
        const counted = faces.reduce((sum, face) => sum + face.triangles, 0);
        expect(3 * counted, `seed ${seed}`).toBe(triangles.length);
      }
    };
    let next = 1;
    const reader = async (): Promise<void> => {
      while (next <= SEEDS) await readOne(next++);
    };
    await Promise.all(Array.from({ length: READERS }, reader));
    expect(["failed", "read", "rejected", "timed-out"]).toEqual(expect.arrayContaining([...kinds.keys()]));
    expect((kinds.get("failed") ?? 0) + (kinds.get("rejected") ?? 0)).toBeGreaterThan(SEEDS / 10);
    expect((await surfaceIn(file, "a.brep")).triangles.length).toBeGreaterThan(100);
  });
});

/**
 * Replaces one to four words of a text file by others of it, or by absurd ones: kinds, counts, indices, orientations and
 * coordinates then contradict each other, in a file whose syntax is valid.
 */
function withOtherWords(file: Uint8Array, random: () => number): Uint8Array {
  const words = new TextDecoder().decode(file).split(/(\s+)/);
  // Words and the space between them alternate.
  const any = () => 2 * (random() % Math.ceil(words.length / 2));
  for (let changes = 1 + (random() % 4); changes > 0; changes--) {
    const at = any();
    const absurd = ABSURD_WORDS[random() % ABSURD_WORDS.length] ?? "";
    words[at] = random() % 2 === 0 ? absurd : (words[any()] ?? "");
  }
  return new TextEncoder().encode(words.join(""));
}

const ABSURD_WORDS = [
  "0",
  "-1",
  "1",
  "7",
  "99",
  "65536",
  "2147483647",
  "-2147483648",
  "1e308",
  "1e-308",
  "nan",
  "*",
  "+9",
  "-2",
  "",
];

/** Number of damaged files. */
const SEEDS = Number(process.env["TETRAFRONT_FUZZ"] ?? 12);

/** Number of files that are read at a time. */
const READERS = 4;

describe("a damaged STEP file", () => {
  const text = new TextDecoder().decode(
    stepFile([boxSolid("one", [0, 0, 0], [1, 1, 1]), boxSolid("two", [3, 0, 0], [1, 1, 1])]),
  );
  const textOf = (whole: string) => withoutPause(stepText(new TextEncoder().encode(whole)));
  const notesOf = async (damage: (whole: string) => string) => {
    const damaged = damage(text);
    expect(damaged).not.toBe(text);
    return (await surfaceIn(new TextEncoder().encode(damaged), "a.step")).notes ?? [];
  };

  test("is read without a note if it is whole", async () => {
    expect((await surfaceIn(new TextEncoder().encode(text), "a.step")).notes ?? []).toEqual([]);
  });

  test("says how many of its solids could be read", async () => {
    const notes = await notesOf((whole) =>
      whole.replace("PRODUCT_DEFINITION_SHAPE", "PRODUCT_DEFINITOON_SHAPE"),
    );
    expect(notes).toContain(
      "the file defines 2 solids, of which at most 1 was read completely; the others could not be read, or are not used",
    );
  });

  test("does not count a solid of which only some faces could be read", async () => {
    const notes = await notesOf((whole) => whole.replace("ADVANCED_FACE", "ADVANCED_FAXE"));
    expect(notes.map((note) => note.split(",")[0])).toEqual([
      "the file defines 2 solids",
      'not closed: "one"',
    ]);
  });

  test.each([
    ["its unit", (whole: string) => whole.replace(".METRE.", ".'ETRE.")],
    [
      "the reference to its unit",
      (whole: string) => whole.replace("UNIT_ASSIGNED_CONTEXT((#", "UNIT_ASSIGNED_CONTEXT((#99"),
    ],
  ])("says that %s is not valid", async (_, damage) => {
    expect((await notesOf(damage)).join()).toMatch(
      /^the file gives no valid unit of length for #\d+; the scale of parts may be wrong/,
    );
  });

  test("says that its head or its end is missing", async () => {
    expect(await notesOf((whole) => whole.replace(/FILE_SCHEMA.*\n/, ""))).toEqual([
      "the head of the file is damaged: it names no schema",
    ]);
    const cut = textOf(text.replace(/END-ISO.*\n/, ""));
    expect(stepNotes(cut, 2)).toEqual(["the file does not end with END-ISO-10303-21; parts may be missing"]);
  });

  test("does not count solids that an assembly uses several times", () => {
    const whole = textOf(text);
    expect(whole).toEqual({ solids: 2, withoutUnit: [], hasSchema: true, isComplete: true });
    expect(stepNotes(whole, 5)).toEqual([]);
    expect(textOf("")).toMatchObject({ solids: 0, hasSchema: false, isComplete: false });
  });
});
