import { readProject, writeProject, type Project } from "tetrafront/project";
import { describe, expect, it } from "vitest";
import { keepingExpression } from "../../../web/document/expression-edits";
import { deleteEntities, moveEntity } from "../../../web/document/edits";
import {
  addParameter,
  expressionProblem,
  nameProblem,
  removeParameter,
  renameParameter,
  renameProblem,
  setParameter,
} from "../../../web/document/parameters";
import { uniformSizePath } from "../../../web/document/number-paths";
import { scaleSizes, setMeshing, setSourceField } from "../../../web/document/size-edits";
import { namesIn, readNumber, withNameReplaced } from "../../../web/expressions/expression";
import { parameterValues } from "../../../web/expressions/parameters";
import { drawLine, placeAt } from "../../../web/document/draw";
import { quantityPosition } from "../../../web/document/quantity-positions";
import { worldFrame } from "../../../web/document/vectors";
import { readCoordinates } from "../../../web/tools/drawing/coordinates";
import { DocumentStore } from "../../../web/session/document-store";
import { cubeProject } from "../../support/projects";

const cube = cubeProject();
const id = cube.points[0]?.id ?? 0;
const x = { kind: "point", id, field: "position.0" } as const;

function opened(project: Project = cube) {
  const documents = new DocumentStore(project, () => 0);
  const moveTo = (value: number, expression: string | null) =>
    documents.edit(keepingExpression(moveEntity("point", id, 0, value), x, expression));
  const xNow = () => documents.project.points[0]?.position[0];
  return { documents, moveTo, xNow };
}

describe("an expression with names", () => {
  const named = new Map([
    ["r", 0.5],
    ["sine", 3],
    ["e1", 7],
  ]);

  it.each([
    ["2*r", 1],
    ["r^2 + e1", 7.25],
    ["sin(30)*sine", 1.5],
    ["-(r)", -0.5],
    ["2e1", 20],
  ])("reads %s", (text, value) => expect(readNumber(text, named)).toBeCloseTo(value, 14));

  it.each(["R", "rr", "r r", "2r", "r(2)", "constructor", "toString(1)"])("rejects %s", (text) =>
    expect(readNumber(text, named)).toBeNull(),
  );

  it("lists names without functions, constants and exponents, and replaces whole names only", () => {
    expect([...namesIn("2*r + sin(a1)/pi - 1e3*r")]).toEqual(["r", "a1"]);
    expect(withNameReplaced("r + rr*sin(r) - 1e3", "r", "w")).toBe("w + rr*sin(w) - 1e3");
  });
});

it("an expression that is nested too deep has no value, and fails nothing", () => {
  const closed = (depth: number) => `${"(".repeat(depth)}1${")".repeat(depth)}`;
  expect(readNumber(closed(100))).toBe(1);
  for (const text of [closed(400), `${"-".repeat(900)}1`, `1${"^1".repeat(400)}`, closed(100_000)]) {
    expect(readNumber(text)).toBeNull();
  }
});

describe("parameters", () => {
  it("have values at the end of a chain of any length", () => {
    const count = 20_000;
    const chain = Array.from({ length: count }, (_, k) => ({ name: `p${k}`, expression: `p${k + 1}+1` }));
    const values = parameterValues([...chain, { name: `p${count}`, expression: "0" }]);
    expect(values.get("p0")).toBe(count);
  });

  it("use each other in any order; those in a cycle have no value", () => {
    const values = parameterValues([
      { name: "area", expression: "pi*r^2" },
      { name: "r", expression: "d/2" },
      { name: "d", expression: "2" },
      { name: "a", expression: "b+1" },
      { name: "b", expression: "a-1" },
      { name: "c", expression: "a" },
    ]);
    expect([...values].sort()).toEqual([
      ["area", Math.PI],
      ["d", 2],
      ["r", 1],
    ]);
  });

  it("refuse names and expressions that cannot be used", () => {
    const project = {
      ...cube,
      parameters: [
        { name: "r", expression: "1" },
        { name: "s", expression: "r" },
      ],
    };
    for (const name of ["", "2r", "a b", "pi", "Sin", "r"]) expect(nameProblem(project, name)).not.toBeNull();
    expect(nameProblem(project, "r", "r")).toBeNull();
    for (const text of ["", "r", "2*s", "t", "1/0"])
      expect(expressionProblem(project, "r", text)).not.toBeNull();
    expect(expressionProblem(project, "s", "3*r")).toBeNull();
    expect(expressionProblem(project, "s", "r + 2*q")).toBe("There is no parameter q");
    for (const text of ["a tenth", "2*q+", "1/0"])
      expect(expressionProblem(project, "s", text)).toMatch(/^Enter a number/);
  });

  it("move the points that use them, as one step of undo", () => {
    const { documents, moveTo, xNow } = opened();
    documents.edit(addParameter("r", "0.3"));
    moveTo(0.6, "2*r");
    documents.edit(setParameter("r", "0.5"));
    expect(xNow()).toBe(1);
    expect(documents.state.getState().history.past).toHaveLength(3);
    documents.undo();
    expect(xNow()).toBe(0.6);
    documents.redo();
    expect(xNow()).toBe(1);
  });

  it("are a step of undo for each text that was entered, however fast", () => {
    const { documents, moveTo, xNow } = opened();
    documents.edit(addParameter("r", "0.3"));
    moveTo(0.6, "2*r");
    documents.edit(setParameter("r", "0.5"));
    documents.edit(setParameter("r", "0.7"));
    documents.undo();
    expect(xNow()).toBe(1);
  });

  it("change through other parameters, and keep their values and expressions when renamed or removed", () => {
    const { documents, moveTo, xNow } = opened();
    documents.edit(addParameter("d", "-4"));
    documents.edit(addParameter("r", "d/2"));
    moveTo(-2, "r");
    documents.edit(renameParameter("d", "width"));
    expect(documents.project.parameters?.[1]).toEqual({ name: "r", expression: "width/2" });
    documents.edit(setParameter("width", "-6"));
    expect(xNow()).toBe(-3);
    documents.edit(removeParameter(documents.project, "width"));
    expect(documents.project.parameters).toEqual([{ name: "r", expression: "(-6)/2" }]);
    expect(xNow()).toBe(-3);
    documents.edit(removeParameter(documents.project, "r"));
    expect(documents.project.parameters).toBeUndefined();
    expect(documents.project.expressions).toEqual([{ ...x, expression: "(-3)" }]);
  });

  it("are not renamed if an expression would become too long for the file", () => {
    const { documents, moveTo, xNow } = opened();
    const sum = Array.from({ length: 100 }, () => "d").join("+");
    documents.edit(addParameter("d", "0.5"));
    documents.edit(addParameter("r", sum));
    moveTo(50, sum);
    // 99 operators and 100 names.
    expect(renameProblem(documents.project, "d", "d".repeat(9))).toBeNull();
    expect(renameProblem(documents.project, "d", "d".repeat(10))).toMatch(/1000 characters/);
    documents.edit(renameParameter("d", "d".repeat(10)));
    expect(documents.project.parameters?.[1]).toEqual({ name: "r", expression: "50" });
    expect(documents.project.expressions).toBeUndefined();
    expect(xNow()).toBe(50);
    expect(readProject(writeProject(documents.project)).success).toBe(true);
  });

  it("leave a project that can be read when one is removed whose value is longer than its name", () => {
    const { documents, moveTo, xNow } = opened();
    const sum = Array.from({ length: 100 }, () => "d").join("+");
    documents.edit(addParameter("d", "1/3"));
    documents.edit(addParameter("r", sum));
    documents.edit(addParameter("none", `${sum}+unknown`));
    moveTo(100 / 3, sum);
    const before = xNow();
    documents.edit(removeParameter(documents.project, "d"));
    const [r, none] = documents.project.parameters ?? [];
    expect(Number(r?.expression)).toBeCloseTo(100 / 3, 12);
    expect(none?.expression).toBe(`${sum}+unknown`);
    expect(documents.project.expressions).toBeUndefined();
    expect(xNow()).toBe(before);
    expect(readProject(writeProject(documents.project)).success).toBe(true);
  });
});

it("an expression is read up to the length that a project file may hold", () => {
  const isInFile = (expression: string) =>
    readProject(writeProject({ ...cube, parameters: [{ name: "r", expression }] })).success;
  for (const [length, isRead] of [
    [1000, true],
    [1001, false],
  ] as const) {
    const text = "1".padStart(length);
    expect([readNumber(text) !== null, isInFile(text)]).toEqual([isRead, isRead]);
  }
});

describe("typed coordinates", () => {
  it("keep their expressions in the points of a line, and follow the parameters", () => {
    const { documents } = opened({ ...cube, points: [], lines: [], patches: [] });
    documents.edit(addParameter("r", "2"));
    const places = ["0, r, 1", "2*r, 0, 0"].map((text) => {
      const named = parameterValues(documents.project.parameters);
      const typed = readCoordinates(text, { last: null, frame: worldFrame, named });
      if (!typed.success) throw new Error(typed.reason);
      return placeAt(documents.project, typed.position, typed.expressions);
    });
    const { creation } = drawLine(documents.project, "straight", places);
    if (!creation) throw new Error("the line exists");
    documents.edit(creation.edit);
    documents.edit(setParameter("r", "3"));
    expect(documents.project.points.map(({ position }) => position)).toEqual([
      [0, 3, 1],
      [6, 0, 0],
    ]);
    expect(documents.project.expressions).toHaveLength(2);
  });

  it("keep what they are relative to, in the work plane too", () => {
    const named = new Map([["r", 2]]);
    const last = quantityPosition([5, 1, 3], ["r + 3", null, null]);
    const frame = { ...worldFrame, origin: [0, 0, 7] } as const;
    const expressionsOf = (text: string): readonly (string | null)[] => {
      const typed = readCoordinates(text, { last, frame, named });
      if (!typed.success) throw new Error(typed.reason);
      typed.expressions.forEach((expression, axis) => {
        if (expression !== null)
          expect(readNumber(expression, named)).toBeCloseTo(typed.position[axis] ?? 0, 12);
      });
      return typed.expressions;
    };
    expect(expressionsOf("@r, 0, 0")).toEqual(["r + 3+r", null, null]);
    expect(expressionsOf("@0, -r, 0")).toEqual(["r + 3", "1-r", null]);
    expect(expressionsOf("r, 1/3")).toEqual(["r", "1/3", null]);
    expect(expressionsOf("2*r < 30")).toHaveLength(3);
    // Plain numbers stay plain numbers.
    expect(expressionsOf("@1, 0, 0")).toEqual([]);
    expect(expressionsOf("5 < 30")).toEqual([]);
  });
});

describe("the expression of a number", () => {
  it("is forgotten when the number changes in another way, also by a drag, and undo restores it", () => {
    const { documents, moveTo } = opened();
    documents.edit(addParameter("r", "1"));
    moveTo(1, "r");
    const gesture = documents.begin("Drag");
    gesture.update(moveEntity("point", id, 0, 5));
    gesture.commit();
    expect(documents.project.expressions).toBeUndefined();
    documents.undo();
    expect(documents.project.expressions).toEqual([{ ...x, expression: "r" }]);
    moveTo(1, null);
    expect(documents.project.expressions).toBeUndefined();
  });

  it("goes with its entity", () => {
    const { documents, moveTo } = opened();
    moveTo(1, "2/2");
    documents.edit(deleteEntities(documents.project, [{ kind: "point", id }]));
    expect(documents.project.expressions).toBeUndefined();
  });

  it("never gives a number a value that the file would not allow", () => {
    const { documents } = opened({
      ...cube,
      background: {
        ...cube.background,
        sources: [{ id: 1, type: "point", positions: [[0, 0, 0]], size: 1 }],
      },
    });
    documents.edit(addParameter("s", "1"));
    const path = { kind: "source", id: 1, field: "size" } as const;
    documents.edit(keepingExpression(setSourceField(1, "size", 1), path, "s"));
    documents.edit(setParameter("s", "-1"));
    expect(documents.project.background.sources?.[0]?.size).toBe(1);
  });

  it("is left alone if the file holds another value, until its parameter changes", () => {
    const { documents, xNow } = opened({
      ...cube,
      parameters: [{ name: "r", expression: "1" }],
      expressions: [{ ...x, expression: "9*r" }],
    });
    const before = xNow();
    documents.edit(moveEntity("point", id, 1, 0.25));
    expect(xNow()).toBe(before);
    documents.edit(setParameter("r", "2"));
    expect(xNow()).toBe(18);
  });
});

it("the uniform size follows its expression until it is changed in another way", () => {
  const { documents } = opened();
  const sizeNow = () => documents.project.meshing?.size;
  const setSize = (value: number, expression: string | null) =>
    documents.edit(keepingExpression(setMeshing("size", value), uniformSizePath, expression));
  documents.edit(addParameter("h", "0.2"));
  setSize(0.1, "h/2");
  documents.edit(setParameter("h", "0.3"));
  expect(sizeNow()).toBe(0.15);
  const kept = [{ ...uniformSizePath, expression: "h/2" }];
  expect(documents.project.expressions).toEqual(kept);
  const read = readProject(writeProject(documents.project));
  expect(read.success && read.value.expressions).toEqual(kept);
  documents.edit(renameParameter("h", "edge"));
  expect(documents.project.expressions).toEqual([{ ...uniformSizePath, expression: "edge/2" }]);
  // Sizes above 0 only: a parameter without a valid size leaves the size as it is.
  documents.edit(setParameter("edge", "-1"));
  expect(sizeNow()).toBe(0.15);
  documents.undo();
  documents.edit(scaleSizes(documents.project, 0.5));
  expect(sizeNow()).toBe(0.075);
  expect(documents.project.expressions).toBeUndefined();
  documents.undo();
  documents.edit(setMeshing("size", null));
  expect(documents.project.expressions).toBeUndefined();
});
