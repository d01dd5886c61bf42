/** Groups, parameters, expressions and problems of projects. */
import type { ReadError } from "tetrafront";
import { liveNotes, parseProject, readProject, writeProject, type Project } from "tetrafront/project";
import { describe, expect, test } from "vitest";

import { cubeProject } from "../../support/projects.js";

const NOTES = {
  groups: [
    {
      id: 1,
      name: "left",
      members: [
        { kind: "point", id: 1 },
        { kind: "line", id: 2 },
      ],
    },
    {
      id: 3,
      name: "",
      color: [1, 0.5, 0],
      members: [
        { kind: "patch", id: 1 },
        { kind: "source", id: 7 },
      ],
    },
  ],
  parameters: [
    { name: "width", expression: "2" },
    { name: "half_2", expression: "width/2" },
  ],
  expressions: [
    { kind: "point", id: 2, field: "position.0", expression: "width" },
    { kind: "source", id: 7, field: "size", expression: "half_2/10" },
    { kind: "source", id: 7, field: "positions.0.2", expression: "half_2" },
    { kind: "background-node", id: 1, field: "size", expression: "width/20" },
  ],
} as const satisfies Partial<Project>;

function notedCube(notes: object = {}): Project {
  const cube = cubeProject();
  const sources = [{ id: 7, type: "point", positions: [[0, 0, 1]], size: 0.1 }] as const;
  return { ...cube, background: { ...cube.background, sources }, ...NOTES, ...notes };
}

function firstError(project: unknown): Pick<ReadError, "path" | "message"> {
  const read = parseProject(project);
  if (read.success) throw new Error("the project was accepted");
  return read.errors[0];
}

test("notes are read back unchanged, one per line after the background", () => {
  const text = writeProject(notedCube());
  expect(readProject(text)).toEqual({ success: true, value: notedCube() });
  expect(text).toContain('\n    {"name":"width","expression":"2"},\n');
  expect(text.indexOf('"groups"')).toBeGreaterThan(text.indexOf('"background"'));
});

test("a project without notes has no keys for them", () => {
  expect(writeProject(cubeProject())).not.toMatch(/groups|parameters|expressions/);
});

test("the uniform size may have an expression", () => {
  const project = notedCube({
    meshing: { size: 0.1 },
    expressions: [{ kind: "meshing", field: "size", expression: "width/20" }],
  });
  expect(readProject(writeProject(project))).toEqual({ success: true, value: project });
  const { meshing: _, ...without } = project;
  expect(liveNotes(without).expressions).toEqual([]);
});

test("a group may hold patches of bodies", () => {
  const { id, patches, ...body } = bodyOf(5, 77);
  const project = notedCube({
    bodies: [{ ...body, id, patches }],
    groups: [
      {
        id: 1,
        name: "body",
        members: [
          { kind: "body", id: 5 },
          { kind: "patch", id: 77 },
        ],
      },
    ],
  });
  expect(parseProject(project).success).toBe(true);
});

/** A tetrahedron. */
function bodyOf(id: number, patch: number) {
  const points = new Float64Array([0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1]);
  const triangles = new Uint32Array([0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2]);
  const text = ({ buffer }: { readonly buffer: ArrayBuffer }) => Buffer.from(buffer).toString("base64");
  return { id, points: text(points), triangles: text(triangles), patches: [{ id: patch }] };
}

describe("rejected with their path:", () => {
  const member = (kind: string, id: number) => [{ id: 1, name: "g", members: [{ kind, id }] }];
  const expression = (kind: string, id: number, field: string) => [{ kind, id, field, expression: "1" }];

  test.each([
    ["a dead member", { groups: member("patch", 99) }, "groups[0].members[0]", /no patch with the id 99/],
    ["a member of no kind", { groups: member("loop", 1) }, "groups[0].members[0].kind", /expected one of/],
    [
      "a repeated member",
      {
        groups: [
          {
            id: 1,
            name: "g",
            members: [
              { kind: "point", id: 1 },
              { kind: "point", id: 1 },
            ],
          },
        ],
      },
      "groups[0].members[1]",
      /already has point 1/,
    ],
    [
      "two groups with one id",
      {
        groups: [
          { id: 1, name: "a", members: [] },
          { id: 1, name: "b", members: [] },
        ],
      },
      "groups[1].id",
      /another group/,
    ],
    [
      "a parameter with a name that is no word",
      { parameters: [{ name: "2r", expression: "1" }] },
      "parameters[0].name",
      /letters, digits and underscores/,
    ],
    [
      "two parameters with one name",
      {
        parameters: [
          { name: "r", expression: "1" },
          { name: "r", expression: "2" },
        ],
      },
      "parameters[1].name",
      /another parameter/,
    ],
    [
      "a blank expression",
      { parameters: [{ name: "r", expression: " " }] },
      "parameters[0].expression",
      /expected an expression/,
    ],
    [
      "a long expression",
      { parameters: [{ name: "r", expression: "1".repeat(1001) }] },
      "parameters[0].expression",
      /expected at most 1000 characters/,
    ],
    [
      "a dead expression",
      { expressions: expression("point", 99, "position.0") },
      "expressions[0].id",
      /no point/,
    ],
    [
      "an expression of an id",
      { expressions: expression("point", 1, "id") },
      "expressions[0].field",
      /point 1 has no number "id"/,
    ],
    [
      "an expression of a missing corner",
      { expressions: expression("source", 7, "positions.1.0") },
      "expressions[0].field",
      /source 7 has no number/,
    ],
    [
      "an expression of a uniform size that is not there",
      { expressions: [{ kind: "meshing", field: "size", expression: "1" }] },
      "expressions[0].field",
      /meshing has no number "size"/,
    ],
    [
      "an expression of another mesh setting",
      {
        meshing: { gradation: 1.2 },
        expressions: [{ kind: "meshing", field: "gradation", expression: "1" }],
      },
      "expressions[0].field",
      /expected one of size/,
    ],
    [
      "an expression of nothing",
      { expressions: [{ kind: "line", id: 1, field: "size", expression: "1" }] },
      "expressions[0].kind",
      /expected .*"point".*"meshing".*received "line"/,
    ],
    [
      "two expressions of one number",
      { expressions: [...expression("point", 1, "position.1"), ...expression("point", 1, "position.1")] },
      "expressions[1]",
      /another expression also defines "position.1" of point 1/,
    ],
  ])("%s", (_, notes, path, message) => {
    const found = firstError(notedCube(notes));
    expect(found.path).toBe(path);
    expect(found.message).toMatch(message);
  });
});

const PROBLEM = {
  kind: "heat",
  conductivity: 2,
  velocity: [0, 1, 0],
  conditions: [
    { patch: 1, kind: "value", value: 20 },
    { patch: 1, kind: "fixed" },
    { patch: 2, kind: "traction", traction: [0, 0, -1] },
  ],
} as const satisfies Project["problem"];

describe("the problem of a project", () => {
  const withProblem = (change: object = {}) => ({ ...cubeProject(), problem: { ...PROBLEM, ...change } });

  test("is read back unchanged, with a condition per line", () => {
    const text = writeProject(withProblem());
    expect(readProject(text)).toEqual({ success: true, value: withProblem() });
    expect(text).toContain('\n      {"patch":1,"kind":"value","value":20},\n');
  });

  test.each<[string, object, string, RegExp]>([
    [
      "a missing patch",
      { conditions: [{ patch: 99, kind: "value" }] },
      "conditions[0].patch",
      /no patch .* 99/,
    ],
    [
      "two conditions of one kind of problem",
      {
        conditions: [
          { patch: 2, kind: "value" },
          { patch: 2, kind: "flux" },
        ],
      },
      "conditions[1]",
      /another condition .* patch 2/,
    ],
    ["an unknown field", { density: 1 }, "", /"density"/],
    ["a material that cannot be", { poissonRatio: 0.5 }, "poissonRatio", /0\.5/],
  ])("rejects %s", (_, change, path, message) => {
    const found = firstError(withProblem(change));
    expect(found.path).toBe(path === "" ? "problem" : `problem.${path}`);
    expect(found.message).toMatch(message);
  });

  test("loses the conditions of patches that are removed", () => {
    const project = withProblem();
    expect(liveNotes(project).problem).toBe(project.problem);
    const without = { ...project, patches: project.patches.filter(({ id }) => id !== 1) };
    expect(liveNotes(without).problem).toEqual({ ...PROBLEM, conditions: [PROBLEM.conditions[2]] });
  });
});

describe("liveNotes", () => {
  test("returns the same lists if everything exists", () => {
    const project = notedCube();
    const live = liveNotes(project);
    expect(live.groups).toBe(project.groups);
    expect(live.expressions).toBe(project.expressions);
    expect(liveNotes(cubeProject())).toEqual({});
  });

  test("drops what refers to removed entities, and keeps groups that become empty", () => {
    const project = notedCube();
    const { sources: _, ...background } = project.background;
    const without = { ...project, patches: [], background };
    const live = { ...without, ...liveNotes(without) };
    expect(live.groups?.[0]).toBe(project.groups?.[0]);
    expect(live.groups?.[1]?.members).toEqual([]);
    expect(live.expressions).toEqual([NOTES.expressions[0], NOTES.expressions[3]]);
    expect(parseProject(live).success).toBe(true);
  });
});
