import type { ProjectBody } from "tetrafront/project";
import { describe, expect, it } from "vitest";
import { setCommonSurface, setPlacement, setRemeshing } from "../../../web/document/body-edits";
import {
  commonNumbers,
  commonSurface,
  commonType,
  ownChanges,
  setCommonLineType,
  setCommonNumber,
  setNumbers,
  steppedChanges,
} from "../../../web/document/common-edits";
import type { Entity } from "../../../web/document/entities";
import { keepingExpression } from "../../../web/document/expression-edits";
import { isAllowed } from "../../../web/document/number-paths";
import { addParameter, setParameter } from "../../../web/document/parameters";
import { DocumentStore } from "../../../web/session/document-store";
import { cubeProject } from "../../support/projects";

const cube = cubeProject();
const points: readonly Entity[] = cube.points.slice(0, 4).map(({ id }) => ({ kind: "point", id }));
const nodes: readonly Entity[] = cube.background.nodes.map(({ id }) => ({ kind: "background-node", id }));

function opened() {
  const documents = new DocumentStore(cube, () => 0);
  const heights = () => documents.project.points.map(({ position }) => position[2]);
  return { documents, heights };
}

describe("what a selection has in common", () => {
  it("is the numbers of all its kinds, without a value where they differ", () => {
    expect(commonNumbers(cube, nodes).map(({ field }) => field)).toEqual([
      "position.0",
      "position.1",
      "position.2",
      "size",
      "stretching",
      "secondStretching",
    ]);
    expect(commonNumbers(cube, [...points, ...nodes]).map(({ field }) => field)).toEqual([
      "position.0",
      "position.1",
      "position.2",
    ]);
    expect(commonNumbers(cube, [...points, { kind: "line", id: 1 }])).toEqual([]);
    const values = new Map(commonNumbers(cube, points).map(({ field, value }) => [field, value]));
    const xs = new Set(cube.points.slice(0, 4).map(({ position }) => position[0]));
    expect(xs.size).toBeGreaterThan(1);
    expect(values.get("position.0")).toBeNull();
    expect(commonNumbers(cube, nodes).find(({ field }) => field === "stretching")?.value).toBe(1);
  });

  it("changes in all entities as one step, with its expression", () => {
    const { documents, heights } = opened();
    const before = heights();
    documents.edit(addParameter("h", "3"));
    documents.edit(setCommonNumber(points, "position.2", 3, "h"));
    expect(documents.project.expressions).toHaveLength(4);
    expect(commonNumbers(documents.project, points)[2]).toEqual({
      field: "position.2",
      value: 3,
      isAutomatic: false,
      smallest: 3,
      expression: "h",
    });
    documents.edit(setParameter("h", "5"));
    expect(heights()).toEqual([5, 5, 5, 5, ...before.slice(4)]);
    documents.undo();
    documents.undo();
    expect(heights()).toEqual(before);
  });

  it("gives stretched nodes a direction", () => {
    const { documents } = opened();
    documents.edit(setCommonNumber(nodes, "stretching", 2, null));
    for (const { stretching, direction } of documents.project.background.nodes) {
      expect([stretching, direction]).toEqual([2, [1, 0, 0]]);
    }
  });

  it("includes the type of lines", () => {
    const { documents } = opened();
    const lines: readonly Entity[] = [1, 2].map((id) => ({ kind: "line", id }));
    expect(commonType(cube, lines, "line")).toBe("straight");
    expect(commonType(cube, lines, "patch")).toBeUndefined();
    documents.edit(setCommonLineType(lines.slice(0, 1), "spline"));
    expect(commonType(documents.project, lines, "line")).toBeNull();
  });
});

describe("an expression in terms of each entity's own numbers", () => {
  const positions = (documents: DocumentStore) => documents.project.points.map(({ position }) => position);
  const change = (documents: DocumentStore, field: "position.2" | "size", text: string, of = points) => {
    const changes = ownChanges(documents.project, of, text);
    expect(changes).toHaveLength(of.length);
    documents.edit(setNumbers(field, changes ?? []));
  };

  it("gives each its own result, as one step without kept expressions", () => {
    const { documents } = opened();
    const before = positions(documents);
    change(documents, "position.2", "2*x-y^2 + z + 0.1");
    expect(positions(documents)).toEqual(
      before.map(([x, y, z], i) => [x, y, i < 4 ? 2 * x - y ** 2 + z + 0.1 : z]),
    );
    expect(documents.project.expressions).toBeUndefined();
    documents.undo();
    expect(positions(documents)).toEqual(before);
    const sizes = documents.project.background.nodes.map(({ size }) => size);
    change(documents, "size", "size/2", nodes);
    expect(documents.project.background.nodes.map(({ size }) => size)).toEqual(sizes.map((size) => size / 2));
  });

  it("keeps the parameters of the text and of the former expressions", () => {
    const { documents, heights } = opened();
    documents.edit(addParameter("r", "2"));
    documents.edit(setCommonNumber(points.slice(0, 1), "position.2", 1, "r-1"));
    change(documents, "position.2", "2*z+1", points.slice(0, 1));
    change(documents, "position.2", "z+r", points.slice(1, 2));
    expect(documents.state.getState().history.past.at(-1)?.label).toBe("Set z of 1 entity");
    expect(heights().slice(0, 2)).toEqual([3, 2]);
    documents.edit(setParameter("r", "5"));
    expect(heights().slice(0, 2)).toEqual([9, 5]);
  });

  it("prefers a parameter of the same name, and refuses what an entity does not have", () => {
    const { documents } = opened();
    expect(ownChanges(documents.project, points, "size+1")).toBeNull();
    expect(ownChanges(documents.project, [...points, ...nodes], "size+1")).toBeNull();
    expect(ownChanges(documents.project, points, "1/(z-z)")).toBeNull();
    expect(ownChanges(documents.project, points, "1+1")).toBeUndefined();
    documents.edit(addParameter("z", "7"));
    expect(ownChanges(documents.project, points, "z+1")).toBeUndefined();
    // Also if it has no value: the text must not mean something else until it has one again.
    const broken = { ...documents.project, parameters: [{ name: "z", expression: "1/0" }] };
    expect(ownChanges(broken, points, "z+1")).toBeUndefined();
  });

  it("steps each from its own value", () => {
    const { documents, heights } = opened();
    documents.edit(addParameter("r", "2"));
    documents.edit(setCommonNumber(points.slice(0, 1), "position.2", 2, "r"));
    for (let i = 0; i < 3; ++i) {
      documents.edit(
        setNumbers("position.2", steppedChanges(documents.project, points, "position.2", 0.1) ?? []),
      );
    }
    expect(heights().slice(0, 4)).toEqual([2.3, 0.3, 0.3, 0.3]);
    documents.edit(setParameter("r", "3"));
    expect(heights()[0]).toBeCloseTo(3.3, 12);
    expect(steppedChanges(documents.project, points, "size", 0.1)).toBeNull();
  });
});

describe("a jump in the history", () => {
  it("goes to the model after any step, and back, without losing steps", () => {
    const { documents, heights } = opened();
    const states = [heights()];
    for (let step = 1; step <= 5; ++step) {
      documents.edit(setCommonNumber(points, "position.2", 10 * step, `5+5*${2 * step - 1}`));
      documents.edit(setCommonNumber(points.slice(0, 1), "position.0", step, null));
      states.push(heights());
    }
    for (const step of [2, 5, 0, 4, 1, 5]) {
      documents.jumpTo(2 * step);
      expect(heights()).toEqual(states[step]);
      const { past, future } = documents.state.getState().history;
      expect(past.length + future.length).toBe(10);
    }
  });
});

describe("what bodies have in common", () => {
  const body = (id: number): ProjectBody => ({ id, points: "", triangles: "", patches: [{ id: 100 + id }] });
  const bodies: readonly Entity[] = [1, 2].map((id) => ({ kind: "body", id }));
  const openedBodies = () => new DocumentStore({ ...cube, bodies: [body(1), body(2)] }, () => 0);

  it("is scale, remeshing size, tolerance and treatment, automatic until one is set", () => {
    const documents = openedBodies();
    const numbers = () =>
      commonNumbers(documents.project, bodies).map(({ field, value, isAutomatic, smallest }) => [
        field,
        value,
        isAutomatic,
        smallest,
      ]);
    expect(numbers()).toEqual([
      ["placement.scale", 1, false, 1],
      ["remeshing.size", null, true, null],
      ["remeshing.tolerance", null, true, null],
    ]);
    documents.edit(setRemeshing(1, "size", 0.5));
    expect(numbers()[1]).toEqual(["remeshing.size", null, false, null]);
    documents.edit(setRemeshing(2, "size", 0.125));
    expect(numbers()[1]).toEqual(["remeshing.size", null, false, 0.125]);
    documents.edit(setCommonNumber(bodies, "remeshing.size", 0.25, null));
    expect(numbers()[1]).toEqual(["remeshing.size", 0.25, false, 0.25]);
    expect(documents.project.bodies?.map(({ remeshing }) => remeshing)).toEqual([
      { size: 0.25 },
      { size: 0.25 },
    ]);
    expect(commonNumbers(documents.project, [...bodies, ...points])).toEqual([]);
    expect(commonSurface(documents.project, bodies)).toBe("remesh");
    documents.edit(setCommonSurface([2], "keep"));
    expect(commonSurface(documents.project, bodies)).toBeNull();
    documents.edit(setCommonSurface([1, 2], "refine"));
    expect(commonSurface(documents.project, bodies)).toBe("refine");
    documents.undo();
    expect(commonSurface(documents.project, bodies)).toBeNull();
    expect(commonSurface(documents.project, points)).toBeUndefined();
  });

  it("follows parameters: scale, placement and remeshing, also where the file omits the default", () => {
    const documents = openedBodies();
    documents.edit(addParameter("s", "1"));
    documents.edit(setCommonNumber(bodies, "placement.scale", 1, "s"));
    documents.edit(setCommonNumber(bodies, "remeshing.size", 0.1, "s/10"));
    const path = { kind: "body", id: 2, field: "placement.position.1" } as const;
    documents.edit(keepingExpression(setPlacement(2, { position: [0, 0, 0] }), path, "s-1"));
    documents.edit(setParameter("s", "3"));
    const [first, second] = documents.project.bodies ?? [];
    expect(first).toMatchObject({ placement: { scale: 3 }, remeshing: { size: 3 / 10 } });
    expect(second?.placement).toEqual({ position: [0, 2, 0], scale: 3 });
    documents.edit(setParameter("s", "-1"));
    expect(documents.project.bodies?.[0]).toMatchObject({
      placement: { scale: 3 },
      remeshing: { size: 3 / 10 },
    });
    documents.edit(setRemeshing(1, "size", null));
    const kept = documents.project.expressions?.filter(
      (one) => one.kind === "body" && one.id === 1 && one.field === "remeshing.size",
    );
    expect(kept).toEqual([]);
  });

  it("stays within the limits of the file", () => {
    const allowed = (field: string, value: number) => isAllowed({ kind: "body", id: 1, field }, value);
    for (const [field, low, high] of [
      ["remeshing.featureAngle", 1, 180],
      ["remeshing.layers", 0, 100],
      ["remeshing.size", 1e-9, 1e30],
      ["placement.scale", 1e-9, 1e30],
    ] as const) {
      expect([low, high, low - 1, 2 * high].map((value) => allowed(field, value))).toEqual([
        true,
        true,
        false,
        false,
      ]);
    }
    expect(allowed("placement.rotation.3", 0.5)).toBe(false);
  });
});
