/** Names of features and faces as the tree shows them, and how solids are drawn and chosen from. */
import { expect, test } from "vitest";
import { createBody, type SolidFeature } from "tetrafront/project";
import { emptyProject } from "../../../web/document/create";
import { drawnSurface, withoutInnerEdges } from "../../../web/document/drawn-surface";
import { faceLabel, faceLook, featureLabel } from "../../../web/document/operations/feature-names";
import { holeStart, startOf } from "../../../web/document/operations/start";

const place = { position: [0, 0, 0], axis: [0, 0, 1] } as const;
const features: readonly SolidFeature[] = [
  { id: 3, type: "box", operation: "new", ...place, size: [1, 1, 1] },
  { id: 4, type: "fillet", edges: [], radius: 0.1 },
  { id: 5, type: "hole", ...place, diameter: 0.2 },
  { id: 9, type: "fillet", edges: [], radius: 0.1 },
  { id: 10, type: "shell", openFaces: [], thickness: 0.1, name: "skin" },
  { id: 11, type: "linear-array", step: [1, 0, 0], count: 3 },
  { id: 12, type: "import", operation: "new", brep: "", looks: [{ name: "seat", color: [1, 0, 0] }, {}] },
];

test("features are counted by kind, and may have names of their own", () => {
  const labels = features.map(({ id }) => featureLabel(features, id));
  expect(labels).toEqual(["Box 1", "Fillet 1", "Hole 1", "Fillet 2", "skin", "Linear array 1", "Part 1"]);
});

test.each([
  ["3/top", "Box 1 top"],
  ["9/fillet 3/front|3/top", "Fillet 2 front–top"],
  ["9/fillet corner", "Fillet 2 corner"],
  ["5/side", "Hole 1 wall"],
  ["5/side#2", "Hole 1 wall 2"],
  ["10/inner 3/top", "skin inner top"],
  ["11/2 3/top", "Linear array 1 2 top"],
  ["12/face 1", "seat"],
  ["12/face 1#2", "seat 2"],
  ["12/face 2", "Part 1 face 2"],
  ["77/top", "77/top"],
])("the face %s is called %s", (origin, label) => {
  expect(faceLabel(features, origin)).toBe(label);
});

test("the full name of a face names the features that made it", () => {
  expect(faceLabel(features, "9/fillet 3/front|5/side", true)).toBe("Fillet 2 Box 1 front–Hole 1 side");
  expect(faceLabel(features, "3/top", true)).toBe("Box 1 top");
});

test("faces of a file have its colours", () => {
  const colorOf = (origin: string) => faceLook(features, origin)?.color;
  expect(["12/face 1", "12/face 1#2"].map(colorOf)).toEqual([
    [1, 0, 0],
    [1, 0, 0],
  ]);
  expect(["12/face 2", "12/face 3", "3/face 1"].map(colorOf)).toEqual([undefined, undefined, undefined]);
});

/** Two squares of two triangles each, which meet at a right angle. */
const folded = {
  points: Float64Array.of(0, 0, 0, 2, 0, 0, 2, 2, 0, 0, 2, 0, 0, 0, 2, 2, 0, 2),
  triangles: Uint32Array.of(0, 1, 2, 0, 2, 3, 1, 0, 4, 1, 4, 5),
  trianglePatch: Uint32Array.of(0, 0, 1, 1),
};

test("edges within a patch are not drawn, those between patches and at the border are", () => {
  const { hiddenEdges } = withoutInnerEdges(drawnSurface(folded, 2), folded);
  // The diagonals are opposite to the second corner of the first triangle of a square, and to the third one of the other.
  expect([...(hiddenEdges ?? [])]).toEqual([2, 2, 2, 4, 4, 4, 2, 2, 2, 4, 4, 4]);
});

test("a piece or a hole begins in the middle of the selected face of a solid", () => {
  const body = createBody(
    { ...folded, patches: [{ name: "floor" }, { name: "wall" }] },
    { id: 1, firstPatchId: 1 },
  );
  const selection = [{ kind: "body-patch", id: 2 }] as const;
  const project = { ...emptyProject(), bodies: [{ ...body, features }] };
  expect(startOf(project, selection)).toEqual({ position: [1, 0, 1], axis: [0, 1, 0] });
  expect(startOf({ ...project, bodies: [body] }, selection).position).toEqual([0, 0, 0]);
  expect(holeStart(project, selection, body)).toEqual(startOf(project, selection));
});

test("without a selection, a hole begins above the middle of the solid, so that it goes through it", () => {
  const body = createBody(folded, { id: 1, firstPatchId: 1 });
  expect(holeStart(emptyProject(), [], body)).toEqual({ position: [1, 1, 2], axis: [0, 0, 1] });
});
