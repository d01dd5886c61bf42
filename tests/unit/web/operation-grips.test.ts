import { noSolids } from "../../support/no-solids";
import { describe, expect, it } from "vitest";
import type { SolidFeature } from "tetrafront/project";
import { emptyProject } from "../../../web/document/create";
import { pieceOperations } from "../../../web/document/operations/pieces";
import type { FieldValues, Operation } from "../../../web/document/operations/operation";
import type { Solid } from "../../../web/document/operations/solids";
import { ViewStore } from "../../../web/document/selection";
import { addScaled, distance, dot } from "../../../web/document/vectors";
import { onLine } from "../../../web/document/work-plane";
import { DocumentStore } from "../../../web/session/document-store";
import { Operations } from "../../../web/session/operations";
import { operationGrips } from "../../../web/tools/handles/operation-grips";

/** Small beside the pieces, so that each grip is where its length ends. */
const pixel = 1e-12;

function opened(operation: Operation, values: FieldValues = {}) {
  const documents = new DocumentStore(emptyProject());
  const operations = new Operations(documents, new ViewStore(), noSolids);
  operations.start(operation);
  for (const [key, value] of Object.entries(values)) operations.set(key, value);
  const valuesNow = () => operations.state.getState().open?.values ?? {};
  return { documents, operations, valuesNow, grips: () => operationGrips(operations, pixel) };
}

const placements: readonly FieldValues[] = [
  {},
  { position: [3, -1, 2], axis: [1, 2, -2] },
  { position: [0.5, 0, 1], axis: [0, -1, 0], anchor: "centre" },
];

describe("the handles of a solid piece", () => {
  const cases = pieceOperations.flatMap((operation) =>
    placements.map((values) => [operation, values] as const),
  );

  it.each(cases)("follow the pointer (%#)", (operation, values) => {
    const { grips, documents } = opened(operation, values);
    const count = grips()?.grips.length ?? 0;
    expect(count).toBeGreaterThan(1);
    for (let index = 0; index < count; ++index) {
      const grip = grips()?.grips[index];
      if (!grip) throw new Error("there is no grip");
      const step = typeof grip.moves === "object" ? grip.moves : ([1, 0, 0] as const);
      const to = addScaled(grip.position, step, 0.0625);
      const before = documents.project.points;
      const drag = grips()?.begin(index);
      drag?.moveTo(to, 0);
      expect(distance(grips()?.grips[index]?.position ?? [9, 9, 9], to)).toBeLessThan(1e-9);
      expect(documents.project.points).not.toEqual(before);
      drag?.cancel();
      expect(documents.project.points).toEqual(before);
    }
  });

  it("round lengths to the step, and keep the last value that the field takes", () => {
    const box = pieceOperations.find(({ id }) => id === "create-box");
    if (!box) throw new Error("there is no box");
    const { grips, valuesNow } = opened(box, { width: 2 });
    const drag = grips()?.begin(0);
    drag?.moveTo([1.43, 0, 0.5], 0.25);
    const at = (valuesNow()["position"] ?? []) as readonly number[];
    // No part has the rounding errors of turns.
    for (const part of at) expect(part).toBe(Number(part.toFixed(9)));
    expect(valuesNow()["width"]).toBe(2.75);
    drag?.moveTo([-5, 0, 0.5], 0.25);
    expect(valuesNow()["width"]).toBe(2.75);
  });
});

describe("the handles of a feature of a solid", () => {
  const box: SolidFeature = {
    id: 1,
    type: "box",
    operation: "new",
    position: [1, 0, 0],
    axis: [0, 0, 1],
    x: [0, 1, 0],
    size: [2, 3, 4],
  };
  const turn = { position: [0, 1, 0], axis: [0, 0, 1], angle: 90 } as const;
  const move: SolidFeature = { id: 2, type: "move", translation: [0, 0, 5], rotation: turn };
  const mirror: SolidFeature = { id: 3, type: "mirror", position: [0, 0, 1], normal: [0, 0, 1] };
  const placement = { position: [10, 0, 0], rotation: [Math.SQRT1_2, 0, 0, Math.SQRT1_2], scale: 2 } as const;

  function gripsOf(features: readonly SolidFeature[], placed: Pick<Solid, "placement"> = {}) {
    const solid: Solid = {
      id: 1,
      points: "",
      triangles: "",
      patches: [],
      features: [box, ...features],
      ...placed,
    };
    const edit = pieceOperations.find(({ id }) => id === "create-box")?.edit(solid, box);
    if (!edit) throw new Error("the box cannot be edited");
    return opened(edit);
  }

  it.each([
    // The x axis of the box is y, so that half of its width leads there from the position.
    ["alone", [], {}, [1, 1, 2], 1],
    ["turned about (0, 1), and moved", [move], {}, [0, 2, 7], 1],
    ["moved and mirrored", [move, mirror], {}, [0, 2, -5], 1],
    ["not moved by a feature that is off", [{ ...move, isOff: true }], {}, [1, 1, 2], 1],
    ["not moved from the original", [{ ...mirror, keepOriginal: true }], {}, [1, 1, 2], 1],
    // Twice as large, turned from y to z, and moved along x.
    ["placed", [], { placement }, [12, -4, 2], 2],
  ] as const)("are where it is, and follow the pointer: %s", (_, features, placed, width, size) => {
    const { grips, valuesNow } = gripsOf(features, placed);
    expect(distance(grips()?.grips[0]?.position ?? [9, 9, 9], width)).toBeLessThan(1e-9);
    const count = grips()?.grips.length ?? 0;
    for (let index = 0; index < count; ++index) {
      const grip = grips()?.grips[index];
      if (!grip) throw new Error("there is no grip");
      const step = typeof grip.moves === "object" ? grip.moves : ([1, 0, 0] as const);
      const to = addScaled(grip.position, step, 0.25);
      grips()?.begin(index)?.moveTo(to, 0);
      expect(distance(grips()?.grips[index]?.position ?? [9, 9, 9], to)).toBeLessThan(1e-9);
    }
    // Its handle moves by half of what the width grows.
    expect(valuesNow()["width"]).toBeCloseTo(2 + (2 * 0.25) / size, 9);
  });
});

it("the nearest place on a line to a ray: the distance is perpendicular to both", () => {
  const ray = { origin: [4, 1, -2], direction: [-1, 0.3, 2] } as const;
  const [through, along] = [
    [1, 2, 3],
    [2, 1, 0.5],
  ] as const;
  const found = onLine(ray, through, along);
  if (!found) throw new Error("there is no place");
  const back = addScaled(found, ray.origin, -1);
  const share = dot(back, ray.direction) / dot(ray.direction, ray.direction);
  const gap = addScaled(back, ray.direction, -share);
  expect(dot(gap, along)).toBeCloseTo(0, 10);
  expect(distance(addScaled(found, through, -1), [0, 0, 0])).toBeGreaterThan(0);
  expect(onLine({ origin: [0, 0, 0], direction: along }, through, along)).toBeNull();
});

it("what an operation adds is not selected because undo has removed selected entities of the same ids", () => {
  const documents = new DocumentStore(emptyProject());
  const view = new ViewStore();
  const operations = new Operations(documents, view, noSolids);
  const [box] = pieceOperations;
  if (!box) throw new Error("there is no piece");
  operations.start(box);
  operations.accept();
  const made = view.state.getState().selection;
  expect(made.length).toBeGreaterThan(0);
  documents.undo();
  operations.start(box);
  expect(documents.project.patches.length).toBeGreaterThan(0);
  expect(view.state.getState().selection).toEqual([]);
  operations.accept();
  expect(view.state.getState().selection).toEqual(made);
});
