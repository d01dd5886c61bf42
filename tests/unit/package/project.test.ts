import { readFileSync } from "node:fs";

import { LIMITS } from "tetrafront";
import {
  parseProject,
  readProject,
  writeProject,
  type Project,
  type ProjectSource,
} from "tetrafront/project";
import { describe, expect, test } from "vitest";

import { cubeProject } from "../../support/projects.js";
import { checkProject } from "../../../wasm/src/api/input-checks.js";

/** Returns the path and the message of the first error. */
function firstError(value: unknown): { path: string | undefined; message: string } {
  const read = parseProject(value);
  if (read.success) throw new Error("the project was accepted");
  const [{ path, message, remedy }] = read.errors;
  expect(remedy).toMatch(/\.$/);
  return { path, message };
}

function addSource(cube: PlainProject, ...sources: unknown[]): void {
  Object.assign(cube.background ?? {}, { sources });
}

/** The cube as plain JSON, to be damaged. */
function damaged(damage: (cube: ReturnType<typeof plainCube>) => void): unknown {
  const cube = plainCube();
  damage(cube);
  return cube;
}

interface PlainProject {
  [key: string]: unknown;
  points: { id: unknown; position: unknown }[];
  lines: { points: unknown[] }[];
  patches: { loops: unknown[][] }[];
  background?: { nodes?: object[]; tetrahedra: unknown[]; sources?: unknown[]; overhang?: unknown };
}

function plainCube(): PlainProject {
  return JSON.parse(JSON.stringify(cubeProject())) as PlainProject;
}

const SOURCES = [
  { id: 7, name: "tip", type: "point", positions: [[0, 0, 0]], size: 0.1, distance: 0.05, growth: 0 },
  {
    id: 2,
    type: "segment",
    positions: [
      [0, 0, 0],
      [0, 0, 1],
    ],
    size: 0.1,
  },
  {
    id: 9,
    type: "triangle",
    positions: [
      [0, 0, 0],
      [1, 0, 0],
      [0, 1, 0],
    ],
    size: 0.2,
    growth: 0.5,
  },
] as const satisfies readonly ProjectSource[];

describe("a valid project", () => {
  test("is read back unchanged", () => {
    const cube = cubeProject();
    expect(readProject(writeProject(cube))).toEqual({ success: true, value: cube });
  });

  test("is written with one entity per line", () => {
    const lines = writeProject(cubeProject()).split("\n");
    expect(lines).toContain('    {"id":2,"position":[1,0,0]},');
    expect(lines.filter((line) => line.includes('"loops"'))).toHaveLength(6);
  });

  test("can omit the background grid", () => {
    const { background: _, ...cube } = cubeProject();
    expect(parseProject(cube)).toMatchObject({ value: { background: { nodes: [], tetrahedra: [] } } });
  });

  test("keeps the sources and the coverage margin of its grid, and omits defaults", () => {
    const background = { ...cubeProject().background, sources: SOURCES, coverageMargin: 0.25 };
    const cube = { ...cubeProject(), background };
    expect(readProject(writeProject(cube))).toEqual({ success: true, value: cube });
    expect(writeProject(cube)).toContain('\n      {"id":7,"name":"tip","type":"point",');
  });

  test("keeps its meshing settings", () => {
    const meshing = { size: 0.5, gradation: 0, order: "smallest-first", optimization: "thorough" } as const;
    const cube = { ...cubeProject(), meshing };
    expect(readProject(writeProject(cube))).toEqual({ success: true, value: cube });
    expect(writeProject(cubeProject())).not.toContain("meshing");
  });

  test("can begin with a byte order mark", () => {
    expect(readProject(`\uFEFF${writeProject(cubeProject())}`).success).toBe(true);
  });

  test("keeps names and numbers of any kind", () => {
    const cube = { ...cubeProject(), description: 'a "quoted"\nname', units: "mm" };
    const points = cube.points.map((point, i) => ({
      ...point,
      name: `p ${i}`,
      position: [1e-300, -0.1, 1e300] as const,
    }));
    const read = readProject(writeProject({ ...cube, points }));
    expect(read).toEqual({ success: true, value: { ...cube, points } });
  });
});

describe("numbers are accepted up to the engine's limit and rejected above it, with their path:", () => {
  const source = { id: 1, type: "point", positions: [[0, 0, 0]], size: 1 };
  test.each<[string, number, (cube: PlainProject, value: number) => void]>([
    [
      "background.nodes[0].size",
      LIMITS.length,
      (c, size) => Object.assign(c.background?.nodes?.[0] ?? {}, { size }),
    ],
    [
      "background.nodes[0].stretching",
      LIMITS.stretching,
      (c, stretching) => Object.assign(c.background?.nodes?.[0] ?? {}, { stretching }),
    ],
    [
      "background.nodes[0].secondStretching",
      LIMITS.stretching,
      (c, secondStretching) => Object.assign(c.background?.nodes?.[0] ?? {}, { secondStretching }),
    ],
    ["background.sources[0].size", LIMITS.length, (c, size) => addSource(c, { ...source, size })],
    ["background.sources[0].distance", LIMITS.length, (c, distance) => addSource(c, { ...source, distance })],
    ["background.sources[0].growth", LIMITS.growth, (c, growth) => addSource(c, { ...source, growth })],
    ["meshing.size", LIMITS.length, (c, size) => (c["meshing"] = { size })],
    ["meshing.gradation", LIMITS.gradation, (c, gradation) => (c["meshing"] = { gradation })],
  ])("%s", (path, limit, set) => {
    for (const [value, isAccepted] of [
      [limit, true],
      [1.001 * limit, false],
    ] as const) {
      const read = parseProject(damaged((cube) => set(cube, value)));
      expect(read.success).toBe(isAccepted);
      if (read.success) continue;
      expect(read.errors[0].message).toBe(`${path}: expected at most ${limit}`);
    }
  });
});

describe("a damaged project is rejected with the path of the damage:", () => {
  test.each<[string, (cube: PlainProject) => void, string, RegExp]>([
    ["an unknown order", (c) => (c["meshing"] = { order: "largest" }), "meshing.order", /smallest-first/],
    ["settings that are a list", (c) => (c["meshing"] = []), "meshing", /an object, received a list/],
    [
      "a background that is a list",
      (c) => Object.assign(c, { background: [] }),
      "background",
      /an object, re/,
    ],
    ["a point that is a list", (c) => (c.points[1] = [] as never), "points[1]", /an object, received a list/],
    ["an unknown setting", (c) => (c["meshing"] = { sise: 1 }), "meshing", /sise/],
    [
      "a coordinate that is text",
      (c) => (c.points[1] = { id: 2, position: [0, "1", 0] }),
      "points[1].position[1]",
      /number/,
    ],
    [
      "a missing coordinate",
      (c) => (c.points[1] = { id: 2, position: [0, 1] }),
      "points[1].position[2]",
      /missing/,
    ],
    [
      "an extra coordinate",
      (c) => (c.points[1] = { id: 2, position: [0, 1, 2, 3] }),
      "points[1].position",
      /at most 3 items/,
    ],
    [
      "coordinates in a typed array",
      (c) => (c.points[1] = { id: 2, position: new Float64Array(3) }),
      "points[1].position",
      /list, received Float64Array/,
    ],
    ["an id of 0", (c) => (c.points[0] = { id: 0, position: [0, 0, 0] }), "points[0].id", /more than 0/],
    [
      "an id that is not an integer",
      (c) => (c.points[0] = { id: 1.5, position: [0, 0, 0] }),
      "points[0].id",
      /whole number/,
    ],
    ["an id used twice", (c) => (c.points[3] = { id: 2, position: [0, 0, 0] }), "points[3].id", /the id 2/],
    [
      "a missing point",
      (c) => (c.lines[4] = { ...c.lines[4], points: [1, 99] }),
      "lines[4].points[1]",
      /no point with the id 99/,
    ],
    [
      "a missing line",
      (c) => (c.patches[0] = { ...c.patches[0], loops: [[1, -77]] }),
      "patches[0].loops[0][1]",
      /no line with the id 77/,
    ],
    [
      "a missing background node",
      (c) => c.background?.tetrahedra.push([1, 2, 3, 44]),
      "background.tetrahedra[5][3]",
      /no background node with the id 44/,
    ],
    [
      "a source with a missing position",
      (c) => addSource(c, { ...SOURCES[1], positions: [[0, 0, 0]] }),
      "background.sources[0].positions",
      /"segment" needs 2 positions, found 1/,
    ],
    [
      "a source with four positions",
      (c) => addSource(c, { ...SOURCES[2], positions: [0, 1, 2, 3].map((x) => [x, 0, 0]) }),
      "background.sources[0].positions",
      /at most 3 items/,
    ],
    [
      "a source without a size",
      (c) => addSource(c, { id: 1, type: "point", positions: [[0, 0, 0]] }),
      "background.sources[0].size",
      /missing/,
    ],
    [
      "a source id used twice",
      (c) => addSource(c, SOURCES[0], SOURCES[0]),
      "background.sources[1].id",
      /another source also has the id 7/,
    ],
    [
      "a negative coverage margin",
      (c) => Object.assign(c.background ?? {}, { coverageMargin: -0.1 }),
      "background.coverageMargin",
      /at least 0/,
    ],
    ["an unknown field", (c) => (c["pionts"] = []), "", /pionts/],
    ["no lines", (c) => delete (c as Partial<PlainProject>).lines, "lines", /missing/],
  ])("%s", (_, damage, path, message) => {
    const found = firstError(damaged(damage));
    expect(found.path).toBe(path);
    expect(found.message).toMatch(message);
  });

  test("an infinite coordinate", () => {
    expect(firstError(damaged((c) => (c.points[0] = { id: 1, position: [0, Infinity, 0] }))).path).toBe(
      "points[0].position[1]",
    );
  });

  test.each([
    ["null", null],
    ["a list", []],
    ["another format", { format: "gltf" }],
  ])("%s is not a project", (_, value) => {
    expect(firstError(value).message).toMatch(/not a Tetrafront project/);
  });

  test("a later version, with only one error", () => {
    const read = parseProject({ format: "tetrafront-project", version: 3, shapes: [] });
    expect(read).toMatchObject({
      success: false,
      errors: [{ path: "version", remedy: "Update Tetrafront." }],
    });
    expect(read.success ? 0 : read.errors.length).toBe(1);
  });

  test("every damaged entity, not only the first", () => {
    const read = parseProject(damaged((c) => c.points.forEach((point) => (point.position = [1, 2]))));
    expect(read.success ? [] : read.errors.map(({ path }) => path)).toEqual(
      [0, 1, 2, 3, 4, 5, 6, 7].map((i) => `points[${i}].position[2]`),
    );
  });
});

describe("a project of version 1", () => {
  const file = new URL("../../fixtures/project-version-1.json", import.meta.url);
  const current = new URL("../../../public/models/bracket.json", import.meta.url);

  test("is read as the same project of the current version", () => {
    const read = readProject(readFileSync(file, "utf8"));
    expect(read).toEqual({ success: true, value: JSON.parse(readFileSync(current, "utf8")) as unknown });
  });

  test("gets every renamed key and value upgraded, and is not changed itself", () => {
    const earlier = {
      ...cubeProject(),
      version: 1,
      points: cubeProject().points.map(({ id, position }) => ({ id, at: position })),
      meshing: { enclosed: "regions", optimization: "strive" },
      background: {
        nodes: [{ id: 1, at: [0, 0, 0], size: 1 }],
        tetrahedra: [],
        sources: [{ id: 1, type: "point", places: [[0, 0, 0]], size: 0.1 }],
        overhang: 0.25,
      },
    };
    const before = structuredClone(earlier);
    expect(parseProject(earlier)).toEqual({
      success: true,
      value: {
        ...cubeProject(),
        meshing: { innerShells: "regions", optimization: "thorough" },
        background: {
          nodes: [{ id: 1, position: [0, 0, 0], size: 1 }],
          tetrahedra: [],
          sources: [{ id: 1, type: "point", positions: [[0, 0, 0]], size: 0.1 }],
          coverageMargin: 0.25,
        },
      },
    });
    expect(earlier).toEqual(before);
  });

  test.each([
    ["points", "points"],
    ["meshing", "meshing"],
    ["background", "background"],
  ])("with %s that are neither object nor list is rejected with their path", (key, path) => {
    expect(firstError({ ...cubeProject(), version: 1, [key]: 7 }).path).toBe(path);
  });

  test("is rejected by the mesher, which names the remedy", () => {
    const earlier = { ...cubeProject(), version: 1 } as unknown as Project;
    const [found] = checkProject(earlier);
    expect(found?.message).toMatch(/version 2, found version 1/);
    expect(found?.remedy).toMatch(/readProject/);
  });
});

describe("text that is not JSON", () => {
  test("is rejected with its line", () => {
    const read = readProject('{\n  "format": "tetrafront-project",\n  "version": 1\n  "name": "x"\n}');
    expect(read).toMatchObject({ success: false, errors: [{ line: 4 }] });
  });

  test.each(["", "  \n"])("that is empty (%j) is reported as empty", (text) => {
    expect(readProject(text)).toMatchObject({
      errors: [{ message: expect.stringMatching(/empty/) as string }],
    });
  });
});

test("the JSON schema names every part of a project", () => {
  const file = new URL("../../../wasm/dist/project.schema.json", import.meta.url);
  const schema = JSON.parse(readFileSync(file, "utf8")) as { properties: object; required: string[] };
  expect(Object.keys(schema.properties)).toEqual(
    expect.arrayContaining(["format", "version", "name", "points", "lines", "patches", "background"]),
  );
  expect(schema.required).not.toContain("background");
});

test("the published JSON schema is that of the package: npm run schema writes it", () => {
  const text = (path: string) =>
    readFileSync(new URL(`../../../${path}/project.schema.json`, import.meta.url), "utf8");
  expect(text("docs")).toBe(text("wasm/dist"));
});
