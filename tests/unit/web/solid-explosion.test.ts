/** Solids that become patches: their names, marks and painted sizes stay, and faces that no patch fits are said. */
import { beforeAll, expect, test } from "vitest";
import { createBody, readProject, type Project, type SolidFeature } from "tetrafront/project";
import { drawnSolid } from "../../../wasm/dist/cad/features/drawing.js";
import type { FeatureKernel } from "../../../wasm/dist/cad/features/session.js";
import { emptyProject } from "../../../web/document/create";
import { documentKey } from "../../../web/document/content-keys";
import type { SolidMaker } from "../../../web/document/operations/operation";
import { explode } from "../../../web/document/operations/solid-explosion";
import type { Solid } from "../../../web/document/operations/solids";
import { DocumentStore } from "../../../web/session/document-store";
import { boxFeature, UPRIGHT } from "../../support/features";
import { testKernel } from "../../support/kernel-shapes";

let kernel: FeatureKernel;
beforeAll(async () => {
  kernel = await testKernel();
});

const solids: SolidMaker = {
  bodyOf: () => Promise.reject(new Error("no body")),
  edgesOf: () => Promise.resolve([]),
  samplesOf: () => Promise.reject(new Error("not sampled")),
  drawn: (features) => Promise.resolve(drawnSolid(kernel, features)),
};

const surface = createBody(
  { points: Float64Array.of(0, 0, 0, 1, 0, 0, 0, 1, 1), triangles: Uint32Array.of(0, 1, 2) },
  { id: 1, firstPatchId: 1 },
);

const hole: SolidFeature = { id: 2, type: "hole", position: [2, 2, 2], axis: [0, 0, -1], diameter: 2 };
const drilled: Solid = {
  ...surface,
  name: "plate",
  patches: [
    { id: 5, name: "lid", origin: "1/top" },
    { id: 6, name: "bore", origin: "2/side" },
  ],
  placement: { position: [0, 0, 10] },
  features: [boxFeature(1, [4, 4, 2]), hole],
};

const withSolid = (solid: Solid): Project => ({
  ...emptyProject(),
  bodies: [solid],
  groups: [
    { id: 1, name: "bolts", members: [{ kind: "patch", id: 6 }] },
    { id: 2, name: "all", members: [{ kind: "body", id: 1 }] },
  ],
  problem: { kind: "heat", conditions: [{ patch: 6, kind: "value", value: 5 }] },
  background: {
    nodes: [],
    tetrahedra: [],
    sources: [{ id: 1, type: "point", positions: [[2, 2, 12]], size: 0.1, body: 1 }],
  },
});

const explosion = (project: Project) => {
  const offer = explode.makeLater?.({ project, selection: [] }, {}, solids);
  if (!offer) throw new Error("no offer");
  return offer;
};

test("a placed solid becomes patches with its names, in its groups, in one step", async () => {
  const documents = new DocumentStore(withSolid(drilled));
  const before = documentKey(documents.project);
  const offer = await explosion(documents.project);
  if (!offer.possible) throw new Error(offer.reason);
  expect(offer.creation.note).toContain("7 faces keep their exact shape.");
  documents.edit(offer.creation.edit);
  const { project } = documents;
  expect(project.bodies ?? []).toEqual([]);
  expect(project.patches.map(({ type }) => type).toSorted()).toEqual([
    ...Array.from({ length: 6 }, () => "planar"),
    "tube",
  ]);
  expect(project.patches.map(({ name }) => name)).toContain("Box 1 front");
  const bore = project.patches.find(({ name }) => name === "bore");
  expect(bore?.type).toBe("tube");
  const lid = project.patches.find(({ name }) => name === "lid");
  expect(lid?.loops.map(({ length }) => length)).toEqual([4, 1]);
  expect(Math.max(...project.points.map(({ position }) => position[2]))).toBe(12);
  expect(project.groups?.[0]?.members).toEqual([{ kind: "patch", id: bore?.id }]);
  expect(project.groups?.[1]?.members).toHaveLength(2);
  expect(project.problem?.conditions).toEqual([{ patch: bore?.id, kind: "value", value: 5 }]);
  expect(project.background.sources).toEqual([{ id: 1, type: "point", positions: [[2, 2, 12]], size: 0.1 }]);
  const read = readProject(JSON.stringify(project));
  expect(read.success ? [] : read.errors).toEqual([]);
  const after = documentKey(project);
  documents.undo();
  expect(documentKey(documents.project)).toBe(before);
  documents.redo();
  expect(documentKey(documents.project)).toBe(after);
});

test("faces that are only near their patches are said, with numbers where they become several", async () => {
  const ball: SolidFeature = { id: 1, type: "sphere", operation: "new", ...UPRIGHT, radius: 1 };
  const offer = await explosion(withSolid({ ...drilled, features: [ball], placement: {} }));
  if (!offer.possible) throw new Error(offer.reason);
  expect(offer.creation.note).toContain("between them: Sphere 1 side.");
  const { edit } = offer.creation;
  const names = "replace" in edit ? edit.replace.patches?.map(({ name }) => name) : [];
  expect(names).toEqual([1, 2, 3, 4, 5, 6, 7, 8].map((number) => `Sphere 1 side ${number}`));
});

test("a face that no patch fits is said, and scaled solids and projects without solids are refused", async () => {
  const cylinder: SolidFeature = {
    id: 1,
    type: "cylinder",
    operation: "new",
    ...UPRIGHT,
    radius: 1,
    height: 4,
  };
  const across: SolidFeature = { id: 2, type: "hole", position: [-2, 0, 2], axis: [1, 0, 0], diameter: 0.5 };
  const offer = await explosion(withSolid({ ...drilled, features: [cylinder, across], placement: {} }));
  expect(offer).toMatchObject({
    possible: false,
    reason: expect.stringContaining("No kind of patch fits Cylinder 1 side:") as string,
  });
  expect(() => explosion(withSolid({ ...drilled, placement: { scale: 2 } }))).toThrow("scaled");
  expect(explode.makeLater?.({ project: emptyProject(), selection: [] }, {}, solids)).toBeNull();
});
