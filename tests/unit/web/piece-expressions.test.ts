import { LIMITS } from "tetrafront";
import { readProject, writeProject, type Project } from "tetrafront/project";
import { describe, expect, it } from "vitest";
import { middleOfArc, quantityMiddleOfArc } from "../../../web/document/arcs";
import { documentKey } from "../../../web/document/content-keys";
import { emptyProject } from "../../../web/document/create";
import {
  changedExpressions,
  type FieldExpressions,
  type FieldValues,
  type Operation,
} from "../../../web/document/operations/operation";
import { pieceOperations } from "../../../web/document/operations/pieces";
import { setParameter } from "../../../web/document/parameters";
import type { Position } from "../../../web/document/position";
import {
  formulaTexts,
  quantityFrameAlong,
  quantityPosition,
  turnedQuantities,
  valuesOf,
} from "../../../web/document/quantity-positions";
import { turned } from "../../../web/document/circles";
import { distance, frameAlong, unit } from "../../../web/document/vectors";
import { readNumber } from "../../../web/expressions/expression";
import {
  call,
  minus,
  negative,
  over,
  plus,
  quantity,
  times,
  valueOf,
} from "../../../web/expressions/quantity";
import { parameterValues } from "../../../web/expressions/parameters";
import { DocumentStore } from "../../../web/session/document-store";

const withParameters = (r: string): Project => ({
  ...emptyProject(),
  parameters: [
    { name: "r", expression: r },
    { name: "shift", expression: "1 - r" },
  ],
});

/** Values of a piece in which every number that may follow a parameter does, and their expressions. */
function typedInto(
  operation: Operation,
  project: Project,
): { values: FieldValues; expressions: FieldExpressions } {
  const subject = { project, selection: [] };
  const named = parameterValues(project.parameters);
  const expressions: Record<string, string> = {
    "position.0": "shift",
    "position.2": "-2*r",
    "axis.1": "r/3",
  };
  let values: FieldValues = {
    ...operation.initial(subject),
    position: [readNumber("shift", named) ?? 0, 4, readNumber("-2*r", named) ?? 0],
    axis: [0, readNumber("r/3", named) ?? 0, 1],
    anchor: "centre",
  };
  for (const [index, field] of operation.fields(values, subject).entries()) {
    if (field.kind !== "number" || field.whole === true) continue;
    // The ring stays wider than its tube.
    const text =
      field.unit === "degrees" ? "10*r + 10" : field.key === "tubeRadius" ? "r/4" : `${index + 1}*r + 1`;
    expressions[field.key] = text;
    values = { ...values, [field.key]: readNumber(text, named) ?? 0 };
  }
  return { values, expressions };
}

function created(operation: Operation, r: string, isTyped: boolean): DocumentStore {
  const project = withParameters(r);
  const { values, expressions } = typedInto(operation, project);
  const documents = new DocumentStore(project, () => 0);
  const offer = operation.make({ project, selection: [] }, values, isTyped ? expressions : {});
  if (!offer.possible) throw new Error(offer.reason);
  documents.edit(offer.creation.edit);
  return documents;
}

const positionsOf = ({ points }: Project): readonly Position[] => points.map(({ position }) => position);

function expectNear(project: Project, expected: Project): void {
  expect(project.points).toHaveLength(expected.points.length);
  positionsOf(expected).forEach((position, i) =>
    expect(distance(positionsOf(project)[i] ?? [NaN, NaN, NaN], position)).toBeLessThan(1e-12),
  );
}

describe("pieces made from expressions", () => {
  it.each(pieceOperations.map((operation) => [operation.id, operation] as const))(
    "%s: after a change of the parameter, it equals one made afresh",
    (_, operation) => {
      const documents = created(operation, "1", true);
      expectNear(documents.project, created(operation, "1", false).project);
      const before = documentKey(documents.project);
      documents.edit(setParameter("r", "1.25"));
      const afresh = created(operation, "1.25", false).project;
      expectNear(documents.project, afresh);
      expect(documents.project.lines).toEqual(afresh.lines);
      expect(documents.project.patches).toEqual(afresh.patches);
      documents.undo();
      expect(documentKey(documents.project)).toBe(before);
    },
  );

  it("are saved in the file", () => {
    const [box] = pieceOperations;
    if (!box) throw new Error("no box");
    const { project } = created(box, "1", true);
    const read = readProject(writeProject(project));
    expect(read).toMatchObject({ success: true });
    expect(read.success && read.value.expressions).toEqual(project.expressions);
  });

  it("have no expressions if all numbers are plain, or if one text would be too long for the file", () => {
    for (const operation of pieceOperations) {
      expect(created(operation, "1", false).project.expressions).toBeUndefined();
      const project = withParameters("1");
      const subject = { project, selection: [] };
      const values = { ...operation.initial(subject), position: [1, 0, 0] as const };
      const expressions = { "position.0": `r${"+0".repeat(LIMITS.expression / 2)}` };
      expect(operation.note?.(values, subject, expressions)).toContain("too long");
      const offer = operation.make(subject, values, expressions);
      const documents = new DocumentStore(project, () => 0);
      if (offer.possible) documents.edit(offer.creation.edit);
      expect(documents.project.points.length).toBeGreaterThan(0);
      expect(documents.project.expressions).toBeUndefined();
    }
  });

  it("leave points that the model had as they are", () => {
    const [box] = pieceOperations;
    if (!box) throw new Error("no box");
    const documents = created(box, "1", false);
    const { project } = documents;
    const { values, expressions } = typedInto(box, project);
    const offer = box.make({ project, selection: [] }, values, expressions);
    if (!offer.possible) throw new Error(offer.reason);
    documents.edit(offer.creation.edit);
    expect(documents.project.points).toEqual(project.points);
    expect(documents.project.expressions).toBeUndefined();
  });

  it("forget the expression of a number that changes, and of no other", () => {
    const before = { radius: "r", "position.0": "r", "position.1": "2*r" };
    const changed = (
      key: string,
      old: number | Position,
      value: number | Position,
      expression?: string | null,
    ) =>
      changedExpressions(
        before,
        key,
        [old, value],
        expression === undefined ? undefined : { field: key, expression },
      );
    expect(changed("radius", 1, 2)).toEqual({ "position.0": "r", "position.1": "2*r" });
    expect(changed("radius", 1, 1)).toEqual(before);
    expect(changed("radius", 1, 2, "r + 1")).toEqual({ ...before, radius: "r + 1" });
    expect(changed("radius", 1, 1, null)).not.toHaveProperty("radius");
    expect(changed("position", [1, 2, 3], [1, 5, 3])).toEqual({ radius: "r", "position.0": "r" });
  });
});

describe("arithmetic of expressions", () => {
  const named = new Map([
    ["a", 0.7],
    ["b", -1.3],
  ]);
  const [a, b, sum] = [quantity(0.7, "a"), quantity(-1.3, "b"), quantity(-0.6, "a+b")];

  it.each([
    minus(a, sum),
    minus(sum, negative(b)),
    times(sum, sum),
    over(a, times(b, sum)),
    over(times(a, b), over(a, sum)),
    negative(negative(sum)),
    times(-2, minus(b, 3)),
    plus(a, times(-1, b)),
    over(1, over(-2, b)),
    call("cos", times(30, sum)),
    times(b, -3e-7),
    minus(-4, negative(times(a, b))),
  ])("%o has a text with its value", (made) => {
    const text = typeof made === "number" ? "" : made.text;
    expect(readNumber(text, named)).toBeCloseTo(valueOf(made), 13);
  });

  it("of plain numbers gives plain numbers, and omits what changes nothing", () => {
    expect([plus(1, 2), minus(1, 2), times(3, 2), over(1, 4)]).toEqual([3, -1, 6, 0.25]);
    expect([plus(a, 0), times(1, a), over(a, 1), minus(plus(a, 0), 0)]).toEqual([a, a, a, a]);
    expect([times(a, 0), minus(sum, sum)]).toEqual([0, 0]);
  });
});

describe("positions with expressions", () => {
  const named = (r: number) => new Map([["r", r]]);
  const evaluated = (texts: readonly (string | null)[], plain: Position, r: number): Position =>
    texts.map((text, k) => (text === null ? plain[k] : readNumber(text, named(r)))) as unknown as Position;

  it.each<Position>([
    [0, 0, 1],
    [1, 2, 3],
    [-2, 0.5, 0],
  ])("the frame along %o and a circle follow a parameter", (x, y, z) => {
    const direction = quantityPosition([x, y, z], [null, `${y}*r`, null]);
    const frame = quantityFrameAlong(direction);
    const expected = frameAlong([x, y * 1.1, z]);
    for (const axis of ["x", "y", "z"] as const) {
      const found = evaluated(formulaTexts(frame[axis]), valuesOf(frame[axis]), 1.1);
      expect(distance(found, expected[axis])).toBeLessThan(1e-13);
    }
    const axis = unit([x, y, z]) ?? [0, 0, 1];
    const [on, centre] = [quantityPosition([3, 1, 2], ["3*r", null, "2*r"]), quantityPosition([1, 0, 2])];
    const third = turnedQuantities(on, centre, axis, 1 / 3);
    const plain = turned([3.3, 1, 2.2], [1, 0, 2], axis, 1 / 3);
    expect(distance(evaluated(formulaTexts(third), valuesOf(third), 1.1), plain)).toBeLessThan(1e-13);
  });

  it.each<[string, Position, Position | null]>([
    ["to the left", [2, 0, 0], null],
    ["on the side of the pointer", [2, 0, 0], [1, -5, 0]],
    ["in space", [1, 1, 1], [0, 3, 0]],
    ["normal to the plane", [0, 0, 2], [5, 0, 1]],
  ])("the middle of an arc %s follows its radius", (_, end, side) => {
    const ends = [quantityPosition([0, 0, 0]), quantityPosition(end)] as const;
    const middle = quantityMiddleOfArc(ends, quantity(2, "2*r"), [0, 0, 1], side);
    if (!middle) throw new Error("no arc");
    const plain = middleOfArc([[0, 0, 0], end], 3, [0, 0, 1], side); // prettier-ignore
    const found = evaluated(formulaTexts(middle), valuesOf(middle), 1.5);
    expect(distance(found, plain ?? [NaN, 0, 0])).toBeLessThan(1e-13);
  });
});
