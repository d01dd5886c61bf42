import { expect, it } from "vitest";
import type { Project } from "tetrafront/project";
import { setCommonNumber } from "../../../web/document/common-edits";
import { addSourceAt, emptyProject, offerTetrahedron } from "../../../web/document/create";
import type { Axis } from "../../../web/document/draft-records";
import type { Entity } from "../../../web/document/entities";
import { offerSplit } from "../../../web/document/grid-edits";
import { setDirections, type DirectionField } from "../../../web/document/node-directions";
import { setNodeSecondStretching, setNodeStretching } from "../../../web/document/size-edits";
import type { Affine } from "../../../web/document/transforms/affine";
import { offerTransform } from "../../../web/document/transforms/transform";
import type { Position } from "../../../web/document/position";
import { distance, dot } from "../../../web/document/vectors";
import { DocumentStore } from "../../../web/session/document-store";
import { draggedTo, handledOf, handlesOf, type HandleRole } from "../../../web/tools/handles/size-handles";
import { glyphEnds } from "../../../web/viewer/layers/size-glyph-layer";

const node = (id: number): Entity => ({ kind: "background-node", id });

/** A grid of two tetrahedra with a common face; node i has size i. */
function twoTetrahedra(): Project {
  const positions: Position[] = [
    [0, 0, 0],
    [1, 0, 0],
    [0, 1, 0],
    [0, 0, 1],
    [1, 1, 1],
  ];
  const nodes = positions.map(([x, y, z], i) => ({
    id: i + 1,
    position: [x, y, z] as [number, number, number],
    size: i + 1,
  }));
  return {
    ...emptyProject(),
    background: {
      nodes,
      tetrahedra: [
        [1, 2, 3, 4],
        [2, 3, 4, 5],
      ],
    },
  };
}

function volumeOf({ background: { nodes, tetrahedra } }: Project): number {
  const at = (id: number): Position => nodes.find((one) => one.id === id)?.position ?? [NaN, NaN, NaN];
  return tetrahedra.reduce((sum, [a, b, c, d]) => {
    const [u, v, w] = [b, c, d].map((id) => at(id).map((x, k) => x - (at(a)[k] ?? 0)));
    if (!u || !v || !w) return NaN;
    const [x = 0, y = 0, z = 0] = u;
    const across = [
      (v[1] ?? 0) * (w[2] ?? 0) - (v[2] ?? 0) * (w[1] ?? 0),
      (v[2] ?? 0) * (w[0] ?? 0) - (v[0] ?? 0) * (w[2] ?? 0),
      (v[0] ?? 0) * (w[1] ?? 0) - (v[1] ?? 0) * (w[0] ?? 0),
    ];
    return sum + Math.abs(x * (across[0] ?? 0) + y * (across[1] ?? 0) + z * (across[2] ?? 0)) / 6;
  }, 0);
}

it.each([
  ["an edge of one tetrahedron", [1, 2], 3, 1.5],
  ["an edge of both tetrahedra", [2, 3], 4, 2.5],
  ["the common face", [2, 3, 4], 6, 3],
  ["a whole tetrahedron", [1, 2, 3, 4], 5, 2.5],
])("splits at %s and keeps the volume", (_, ids, tetrahedra, size) => {
  const documents = new DocumentStore(twoTetrahedra());
  const before = volumeOf(documents.project);
  const offer = offerSplit(documents.project, ids.map(node));
  if (!offer.possible) throw new Error(offer.reason);
  documents.edit(offer.creation.edit);
  const { background } = documents.project;
  expect(background.tetrahedra).toHaveLength(tetrahedra);
  expect(background.nodes.at(-1)).toMatchObject({ id: 6, size });
  expect(volumeOf(documents.project)).toBeCloseTo(before, 12);
  documents.undo();
  expect(documents.project).toEqual(twoTetrahedra());
});

it("splits nothing at nodes without a common tetrahedron, and at a single node", () => {
  const project = twoTetrahedra();
  for (const ids of [[1, 5], [1], [1, 2, 3, 4, 5]]) {
    expect(offerSplit(project, ids.map(node)).possible).toBe(false);
  }
});

it("makes no tetrahedron of four nodes in one plane", () => {
  const project = twoTetrahedra();
  const flat = {
    ...project,
    background: {
      ...project.background,
      nodes: project.background.nodes.map((one) => ({
        ...one,
        position: one.position.with(2, 0) as [number, number, number],
      })),
    },
  };
  expect(offerTetrahedron(flat, [1, 2, 3, 5].map(node)).possible).toBe(false);
  expect(offerTetrahedron(project, [1, 2, 3, 5].map(node)).possible).toBe(true);
});

it("the first tetrahedron replaces a uniform size, which would leave the grid without effect", () => {
  const corners = [1, 2, 3, 4].map(node);
  const made = (project: Project): [Project, string | undefined] => {
    const offer = offerTetrahedron(project, corners);
    if (!offer.possible) throw new Error(offer.reason);
    const documents = new DocumentStore(project);
    documents.edit(offer.creation.edit);
    return [documents.project, offer.creation.note];
  };
  const { background, ...rest } = twoTetrahedra();
  const nodes = { ...rest, background: { ...background, tetrahedra: [] } };
  const meshing = { size: 0.1, growth: 0.2 };
  const [first, note] = made({ ...nodes, meshing });
  expect(first.meshing).toEqual({ growth: 0.2 });
  expect(first.background.tetrahedra).toEqual([[1, 2, 3, 4]]);
  expect(note).toContain("background grid");
  expect(made(nodes)[1]).toBeUndefined();
  // A grid that has been without effect stays so.
  const tetrahedra = [[1, 2, 3, 5] as [number, number, number, number]];
  const [further] = made({ ...nodes, meshing, background: { ...background, tetrahedra } });
  expect(further.meshing).toEqual(meshing);
});

/** Drags the handle of a role of the only selected entity to a position. */
function drag(
  documents: DocumentStore,
  entity: Entity,
  role: HandleRole,
  to: (at: Position) => Position,
): void {
  const handled = handledOf(documents.project, [entity]);
  if (!handled) throw new Error("nothing has handles");
  const handle = handlesOf(handled, 1e-6).find((one) => JSON.stringify(one.role) === JSON.stringify(role));
  if (!handle) throw new Error("there is no such handle");
  documents.edit(draggedTo(handled, handle, to(handle.position)));
}

it("changes size, stretching and direction of a node by its handles", () => {
  const documents = new DocumentStore(twoTetrahedra());
  const at = () => documents.project.background.nodes[1];
  // The handle is half a size away, so twice as far is twice the size.
  drag(documents, node(2), "size", ([x, y, z]) => [2 * x - 1, 2 * y, 2 * z]);
  expect(at()).toMatchObject({ size: 4 });
  expect(at()?.stretching).toBeUndefined();
  drag(documents, node(2), "direction", () => [1, 6, 0]);
  expect(at()).toMatchObject({ size: 4, stretching: 3, direction: [0, 1, 0] });
  drag(documents, node(2), "size", ([x, y, z]) => [(x + 1) / 2, y / 2, z / 2]);
  expect(at()).toMatchObject({ size: 2, stretching: 3, direction: [0, 1, 0] });
  // Back to a ball: neither stretching nor direction remain.
  drag(documents, node(2), "direction", () => [1, 1, 0]);
  expect(at()).toEqual({ id: 2, position: [1, 0, 0], size: 2 });
});

it("a second direction stays orthogonal to the first", () => {
  const documents = new DocumentStore(twoTetrahedra());
  const at = () => documents.project.background.nodes[1];
  documents.edit(setNodeStretching(2, 3));
  documents.edit(setNodeSecondStretching(2, 2));
  expect(at()).toMatchObject({ direction: [1, 0, 0], secondStretching: 2, secondDirection: [0, 1, 0] });
  const cosine = () => dot(at()?.direction ?? [NaN, 0, 0], at()?.secondDirection ?? [NaN, 0, 0]);
  drag(documents, node(2), "direction", () => [3, 2, 1]);
  expect(cosine()).toBeCloseTo(0, 12);
  const direct = (field: DirectionField, axis: Axis, value: number, expression: string | null = null) =>
    documents.edit(setDirections(documents.project, [2], field, { axis, value, expression }));
  direct("direction", 0, 0.3);
  expect(cosine()).toBeCloseTo(0, 12);
  // A typed component is kept where it is possible, with its expression.
  direct("secondDirection", 2, 5, "5");
  expect(cosine()).toBeCloseTo(0, 12);
  expect(at()?.secondDirection?.[2]).not.toBe(5);
  expect(documents.project.expressions).toBeUndefined();
  expect(at()?.secondStretching).toBe(2);
  // Scaled in one direction, drawn directions are no longer orthogonal.
  const { project } = documents;
  const columns: Affine["columns"] = [
    [5, 0, 0],
    [0, 1, 0],
    [0, 0, 1],
  ];
  const map: Affine = { columns, offset: [0, 0, 0], similarity: null };
  const scaled = offerTransform(project, [node(2)], map, { label: "scale", join: false });
  if (!scaled.possible) throw new Error(scaled.reason);
  documents.edit(scaled.creation.edit);
  expect(cosine()).toBeCloseTo(0, 12);
});

it("changes the second stretching and direction of a node by its handle", () => {
  const documents = new DocumentStore(twoTetrahedra());
  const at = () => documents.project.background.nodes[1];
  documents.edit(setNodeStretching(2, 3));
  drag(documents, node(2), "second direction", ([x, y, z]) => [2.5 * (x - 1) + 1, 2.5 * y, 2.5 * z]);
  expect(at()).toMatchObject({ size: 2, stretching: 3, direction: [1, 0, 0], secondStretching: 2.5 });
  // Half a size times the stretching away from the node, whose size does not change.
  drag(documents, node(2), "second direction", () => [4, 0, 5]);
  expect(at()).toMatchObject({ size: 2, stretching: 3, direction: [1, 0, 0], secondDirection: [0, 0, 1] });
  // Along the second direction alone.
  drag(documents, node(2), "direction", () => [1, 0.01, 0]);
  expect(at()).not.toHaveProperty("stretching");
  drag(documents, node(2), "second direction", () => [1, 0, 0.01]);
  expect(at()).toEqual({ id: 2, position: [1, 0, 0], size: 2 });
});

it("sets directions of several nodes, which stay orthogonal", () => {
  const documents = new DocumentStore(twoTetrahedra());
  const nodes = [node(2), node(3)];
  documents.edit(setCommonNumber(nodes, "secondStretching", 2, null));
  documents.edit(setCommonNumber(nodes, "stretching", 4, null));
  const set = (field: DirectionField, axis: Axis, value: number) =>
    documents.edit(setDirections(documents.project, [2, 3], field, { axis, value, expression: null }));
  set("direction", 1, 1);
  set("secondDirection", 0, 3);
  const { nodes: after } = documents.project.background;
  for (const { stretching, secondStretching, direction, secondDirection } of after.slice(1, 3)) {
    expect([stretching, secondStretching]).toEqual([4, 2]);
    expect(direction?.[1]).toBe(1);
    expect(dot(direction ?? [1, 1, 1], secondDirection ?? [1, 1, 1])).toBeCloseTo(0, 12);
  }
  expect(after[0]).not.toHaveProperty("direction");
});

it("changes corners, size and distance of a source by its handles", () => {
  const documents = new DocumentStore(twoTetrahedra());
  documents.edit(
    addSourceAt(documents.project, "segment", [
      [0, 0, 0],
      [1, 0, 0],
    ]).edit,
  );
  const source = () => documents.project.background.sources?.[0];
  const entity: Entity = { kind: "source", id: 1 };
  const [size = 0, distanceBefore = 0] = [source()?.size, source()?.distance];
  drag(documents, entity, { corner: 1 }, () => [1, 2, 3]);
  expect(source()?.positions).toEqual([
    [0, 0, 0],
    [1, 2, 3],
  ]);
  drag(documents, entity, "size", (p) => [3 * p[0], 3 * p[1], 3 * p[2]]);
  expect(source()?.size).toBeCloseTo(3 * size, 12);
  drag(documents, entity, "distance", (p) => [p[0] / 2, p[1] / 2, p[2] / 2]);
  expect(source()?.distance).toBeCloseTo(distanceBefore / 2, 12);
});

it("places handles in true size, but no nearer than a few pixels", () => {
  const [entity] = [node(3)];
  const handled = handledOf(twoTetrahedra(), [entity]);
  if (!handled) throw new Error("nothing has handles");
  for (const { from, position } of handlesOf(handled, 1e-6)) expect(distance(from, position)).toBe(1.5);
  for (const { from, position } of handlesOf(handled, 10))
    expect(distance(from, position)).toBeGreaterThan(200);
  expect(handledOf(twoTetrahedra(), [entity, node(1)])).toBeNull();
});

it("draws ellipsoids with three half axes", () => {
  const second = { axis: [3, 0, 0], along: 1.5 } as const;
  const ends = glyphEnds({ centre: [1, 2, 3], axis: [0, 0, 2], across: 0.5, along: 2, second });
  for (const [x, y, z] of ends) {
    expect(((x - 1) / 1.5) ** 2 + ((y - 2) / 0.5) ** 2 + ((z - 3) / 2) ** 2).toBeCloseTo(1, 9);
  }
});

it("draws ellipsoids whose points satisfy their equation", () => {
  const ends = glyphEnds({ centre: [1, 2, 3], axis: [0, 0, 2], across: 0.5, along: 2 });
  expect(ends.length).toBeGreaterThan(100);
  for (const [x, y, z] of ends) {
    expect(((x - 1) ** 2 + (y - 2) ** 2) / 0.25 + (z - 3) ** 2 / 4).toBeCloseTo(1, 9);
  }
});
