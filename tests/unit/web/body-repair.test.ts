import { readProject, writeProject, type ProjectBody } from "tetrafront";
import { expect, it } from "vitest";
import { withRepairs } from "../../../web/document/body-repair";
import { cubeProject } from "../../support/projects";

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
