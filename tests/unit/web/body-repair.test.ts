import { createMesher } from "tetrafront";
import {
  bodyWithPatches,
  mergePatches,
  readProject,
  writeProject,
  type ProjectBody,
} from "tetrafront/project";
import { expect, it } from "vitest";
import { setPlacement } from "../../../web/document/body-edits";
import { ownLength, placedLength, sharedVolume, withRepairs } from "../../../web/document/body-repair";
import { joinedSurface } from "../../../web/document/touching-bodies";
import { DocumentStore } from "../../../web/session/document-store";
import { replacedBody } from "../../../web/workers/replaced-body";
import { cubeProject } from "../../support/projects";
import { boxSurface } from "../../support/surfaces";

const arrayText = ({ buffer }: Float64Array | Uint32Array) => Buffer.from(buffer).toString("base64");

const tetrahedron: ProjectBody = {
  id: 1,
  points: arrayText(Float64Array.of(0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1)),
  triangles: arrayText(Uint32Array.of(0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2)),
  patches: [{ id: 77 }],
};

it("a body keeps the changes of all repairs, with the sum of their deviations, in the project file", () => {
  const change = { kind: "removed-triangle", triangle: 3, position: [0, 0, 1] } as const;
  const once = { ...tetrahedron, ...withRepairs(tetrahedron, { changes: [change], deviation: 0 }) };
  expect(once).not.toHaveProperty("repairDeviation");
  const twice = { ...once, ...withRepairs(once, { changes: [change], deviation: 0.25 }) };
  const body = { ...twice, ...withRepairs(twice, { changes: [], deviation: 0.5 }) };
  expect(body).toMatchObject({ repairDeviation: 0.75, repairs: [{ kind: "removed-triangle", count: 2 }] });
  const read = readProject(writeProject({ ...cubeProject(), bodies: [body] }));
  expect(read.success && read.value.bodies).toEqual([body]);
  expect(
    readProject(writeProject({ ...cubeProject(), bodies: [{ ...body, repairDeviation: -1 }] })),
  ).toMatchObject({
    success: false,
    errors: [{ path: "bodies[0].repairDeviation" }],
  });
});

it("a deviation is one of the body's own coordinates, whatever its placement", async () => {
  // Two of the nodes of a tetrahedron are torn apart by 1e-3, which a weld closes.
  const torn = {
    points: Float64Array.of(0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 1e-3, 1),
    triangles: Uint32Array.of(0, 2, 1, 0, 1, 3, 1, 2, 4, 0, 4, 2),
  };
  const mesher = await createMesher();
  try {
    const { deviation } = await mesher.repairSurface(torn, { weld: 0.01 });
    expect(deviation).toBeCloseTo(1e-3, 12);
    const inches = { placement: { scale: 25.4 } };
    expect(placedLength(deviation, inches)).toBeCloseTo(0.0254, 12);
    expect(placedLength(deviation, {})).toBe(deviation);
    // The user types a weld distance in model units, and reads the deviation in them.
    const weld = ownLength(0.0255, inches);
    expect((await mesher.repairSurface(torn, { weld })).deviation).toBeGreaterThan(0);
    expect((await mesher.repairSurface(torn, { weld: ownLength(0.0253, inches) })).deviation).toBe(0);
    expect(placedLength(weld, inches)).toBeCloseTo(0.0255, 12);
  } finally {
    mesher.dispose();
  }
});

it("repairs and their deviation stay together when a body is changed", () => {
  const known = {
    repairs: [{ kind: "welded-node", count: 1, positions: [[0, 0, 1]] }],
    repairDeviation: 0.5,
  } as const;
  const body: ProjectBody = { ...tetrahedron, ...known };
  const surface = { trianglePatch: Uint32Array.of(0, 0, 1, 1), patches: [{ name: "a" }, { name: "b" }] };
  const split = bodyWithPatches(body, surface, 90);
  expect(split).toMatchObject(known);
  expect(
    mergePatches(
      split,
      split.patches.map(({ id }) => id),
    ),
  ).toMatchObject(known);
  const project = { ...cubeProject(), bodies: [body] };
  const documents = new DocumentStore(project);
  documents.edit(setPlacement(1, { scale: 2 }));
  expect(documents.project.bodies?.[0]).toMatchObject({ ...known, placement: { scale: 2 } });
  // A new surface comes with repairs of its own; its arrays leave nothing of the given ones.
  const [points, triangles] = [
    Float64Array.of(0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1),
    Uint32Array.of(0, 2, 1, 0, 1, 3),
  ];
  const fewer = { points, triangles, trianglePatch: new Uint32Array(2) };
  const replaced = replacedBody({
    body: { ...split, ...withRepairs(split, { changes: [], deviation: 0.25 }) },
    surface: fewer,
    patches: split.patches.slice(0, 1),
  });
  expect(replaced).toMatchObject({ repairDeviation: 0.75, repairs: known.repairs });
  expect(replaced).not.toHaveProperty("trianglePatch");
  expect(readProject(writeProject({ ...cubeProject(), bodies: [replaced] })).success).toBe(true);
});

it("parts of a surface share what they enclose beyond the repaired surface, wherever it lies", async () => {
  const mesher = await createMesher();
  const far = 1000;
  const parts = [
    boxSurface(1, [far, 0, 0], [far + 1, 1, 1]),
    boxSurface(2, [far + 0.75, 0.25, 0.25], [far + 1.75, 0.5, 0.75]),
  ];
  const [one, other] = parts.map(({ points, triangles }) => ({
    points,
    triangles,
    trianglePatch: new Uint32Array(triangles.length / 3),
  }));
  if (!one || !other) throw new Error("no parts");
  const given = joinedSurface([
    [one, 1],
    [other, 1],
  ]);
  const { mesh: surface } = await mesher.repairSurface(given);
  const { volume } = await mesher.inspectSurface(surface);
  expect(sharedVolume(given, volume)).toBeCloseTo(0.25 * 0.25 * 0.5, 9);
  expect(sharedVolume(surface, volume)).toBe(0);
  mesher.dispose();
});
