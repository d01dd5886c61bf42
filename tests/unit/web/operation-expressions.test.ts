import { LIMITS } from "tetrafront";
import { readProject, writeProject, type Project } from "tetrafront/project";
import { describe, expect, it } from "vitest";
import { documentKey } from "../../../web/document/content-keys";
import { emptyProject } from "../../../web/document/create";
import type { Entity } from "../../../web/document/entities";
import { keepingExpressions } from "../../../web/document/expression-edits";
import type { FieldValue, FieldValues, Operation } from "../../../web/document/operations/operation";
import { pieceOperations } from "../../../web/document/operations/pieces";
import { sweepOperations } from "../../../web/document/operations/sweeps";
import { transformOperations } from "../../../web/document/operations/transforms";
import { setParameter } from "../../../web/document/parameters";
import type { Position } from "../../../web/document/position";
import { translation } from "../../../web/document/transforms/affine";
import { offerTransform } from "../../../web/document/transforms/transform";
import { distance } from "../../../web/document/vectors";
import { readNumber } from "../../../web/expressions/expression";
import { parameterValues } from "../../../web/expressions/parameters";
import { plus, quantity, type Quantity } from "../../../web/expressions/quantity";
import { DocumentStore } from "../../../web/session/document-store";

type Texts = Readonly<Record<string, string>>;

/** A project with a node and a source beside the model, and the parameter r. */
const startWith = (r: string): Project => ({
  ...emptyProject(),
  parameters: [{ name: "r", expression: r }],
  background: {
    nodes: [{ id: 1, position: [9, 1, 2], size: 0.5, stretching: 2, direction: [0, 1, 0] }],
    tetrahedra: [],
    sources: [{ id: 1, type: "segment", positions: [[8, 0, 0], [8, 1, 3]], size: 0.25, distance: 1 }], // prettier-ignore
  },
});

/** Applies an operation with values that are typed, or with the numbers that these give. */
function apply(
  documents: DocumentStore,
  operation: Operation,
  selection: readonly Entity[],
  { texts = {}, plain = {} }: { texts?: Texts; plain?: FieldValues },
  isTyped: boolean,
): void {
  const { project } = documents;
  const named = parameterValues(project.parameters);
  const values: Record<string, FieldValue> = {
    ...operation.initial({ project, selection }),
    ...centred(operation.id),
    ...plain,
  };
  const expressions: Record<string, string> = {};
  for (const [field, text] of Object.entries(texts)) {
    const [key = "", axis] = field.split(".");
    const value = readNumber(text, named) ?? NaN;
    const before = values[key];
    values[key] =
      axis === undefined
        ? value
        : ([0, 1, 2].map((k) =>
            k === Number(axis) ? value : typeof before === "object" ? before[k] : NaN,
          ) as unknown as Position);
    expressions[field] = text;
  }
  const offer = operation.make({ project, selection }, values, isTyped ? expressions : {});
  if (!offer.possible) throw new Error(offer.reason);
  expect(offer.creation.note).toBeUndefined();
  documents.edit(offer.creation.edit);
}

/** Centres that do not depend on the selection. */
const centred = (id: string): FieldValues =>
  ["transform-rotate", "transform-scale", "hole-through"].includes(id) ? { centre: [0.5, 1, 2] } : {};

const operationOf = (id: string): Operation => {
  const found = [...pieceOperations, ...sweepOperations, ...transformOperations].find((one) => one.id === id);
  if (!found) throw new Error(`no operation ${id}`);
  return found;
};

const entities = (kind: Entity["kind"], list: readonly { readonly id: number }[]): Entity[] =>
  list.map(({ id }) => ({ kind, id }));

const all = ({ patches, background }: Project): Entity[] => [
  ...entities("patch", patches),
  ...entities("background-node", background.nodes),
  ...entities("source", background.sources ?? []),
];
const drawn = ({ patches }: Project): Entity[] => entities("patch", patches);
/** The highest patch: the top of a piece. */
const top = ({ patches }: Project): Entity[] =>
  entities(
    "patch",
    patches.filter(({ name = "" }) => name.includes("top")),
  );

interface Case {
  readonly operation: string;
  readonly piece: "create-box" | "create-cylinder";
  readonly select: (project: Project) => Entity[];
  readonly texts: Texts;
  readonly plain?: FieldValues;
}

const pieceTexts: { readonly [P in Case["piece"]]: Texts } = {
  "create-box": { width: "4*r", depth: "r + 3", height: "2*r", "position.0": "r - 1" },
  "create-cylinder": { radius: "r + 1", height: "2*r", "position.2": "r/2" },
};

const offset = { "offset.0": "-20*r", "offset.2": "r/3" };
const cases: readonly Case[] = [
  { operation: "transform-move", piece: "create-box", select: all, texts: offset },
  { operation: "transform-move", piece: "create-cylinder", select: all, texts: offset, plain: { copies: 3 } },
  {
    operation: "transform-rotate",
    piece: "create-cylinder",
    select: all,
    texts: { angle: "25*r", "centre.0": "-r", "centre.1": "2" },
  },
  {
    operation: "transform-rotate",
    piece: "create-box",
    select: drawn,
    texts: { angle: "25*r", "centre.0": "9*r" },
    plain: { copies: 2 },
  },
  {
    operation: "transform-rotate",
    piece: "create-box",
    select: drawn,
    texts: { "axis.0": "r", "axis.2": "2*r" },
    plain: { axis: [1, 0, 2] },
  },
  {
    operation: "transform-scale",
    piece: "create-cylinder",
    select: all,
    texts: { "factors.0": "2*r", "factors.1": "2*r", "factors.2": "2*r", "centre.0": "r" },
  },
  {
    operation: "transform-scale",
    piece: "create-box",
    select: all,
    texts: { "factors.0": "2*r", "factors.1": "r + 0.5", "centre.2": "r" },
  },
  { operation: "transform-mirror", piece: "create-cylinder", select: all, texts: { "point.0": "-7*r" } },
  {
    operation: "transform-mirror",
    piece: "create-box",
    select: all,
    texts: { "normal.1": "r", "point.0": "-7*r" },
    plain: { keep: false, point: [0, 0, 0] },
  },
  { operation: "array-linear", piece: "create-box", select: all, texts: { spacing: "15*r", "axis.1": "r" } },
  {
    operation: "array-circular",
    piece: "create-cylinder",
    select: drawn,
    texts: { "centre.0": "9*r", total: "200*r" },
    plain: { count: 4 },
  },
  {
    operation: "array-circular",
    piece: "create-box",
    select: drawn,
    texts: { "centre.0": "9*r" },
    plain: { count: 5 },
  },
  { operation: "extrude", piece: "create-box", select: top, texts: { distance: "3*r" } },
  {
    operation: "extrude",
    piece: "create-cylinder",
    select: top,
    texts: { distance: "3*r", "direction.0": "r" },
  },
  { operation: "offset-copy", piece: "create-cylinder", select: top, texts: { distance: "1/r" } },
  {
    operation: "revolve",
    piece: "create-box",
    select: top,
    texts: { angle: "40*r", "point.0": "-9*r", "axis.2": "0" },
    plain: { axis: [0, 1, 0] },
  },
  {
    operation: "revolve",
    piece: "create-box",
    select: top,
    texts: { "point.0": "-9*r" },
    plain: { axis: [0, 1, 0] },
  },
  {
    operation: "hole-through",
    piece: "create-box",
    select: top,
    texts: { diameter: "r", "centre.0": "r/4", "centre.1": "-r/4" },
  },
];

/** Creates a piece, and applies the operation of a case to it. */
function made({ operation, piece, select, texts, plain = {} }: Case, r: string, isTyped: boolean) {
  let now = 0;
  const documents = new DocumentStore(startWith(r), () => (now += 1e6));
  apply(documents, operationOf(piece), [], { texts: pieceTexts[piece] }, isTyped);
  const before = documents.project;
  apply(documents, operationOf(operation), select(before), { texts, plain }, isTyped);
  expect(documentKey(documents.project)).not.toBe(documentKey(before));
  return documents;
}

const positionsOf = ({ points, background: { nodes, sources = [] } }: Project): readonly Position[] => [
  ...points.map(({ position }) => position),
  ...nodes.flatMap(({ position, size, direction }) => [
    position,
    direction ?? position,
    [size, 0, 0] as const,
  ]),
  ...sources.flatMap(({ positions, size, distance: reach = 0 }) => [...positions, [size, reach, 0] as const]),
];

function expectNear(project: Project, expected: Project): void {
  const [found, wanted] = [positionsOf(project), positionsOf(expected)];
  expect(found).toHaveLength(wanted.length);
  wanted.forEach((position, i) =>
    expect(distance(found[i] ?? [NaN, NaN, NaN], position)).toBeLessThan(1e-11),
  );
  expect(project.lines).toEqual(expected.lines);
  expect(project.patches).toEqual(expected.patches);
}

describe("operations with values that are typed as expressions", () => {
  it.each(cases.map((one) => [one.operation, one.piece, Object.values(one.texts).join(", "), one] as const))(
    "%s of a %s by %s: after a change of the parameter, the model equals one made afresh",
    (_operation, _piece, _texts, one) => {
      const documents = made(one, "1", true);
      expectNear(documents.project, made(one, "1", false).project);
      const key = documentKey(documents.project);
      for (const r of ["1.15", "0.9"]) {
        documents.edit(setParameter("r", r));
        expectNear(documents.project, made(one, r, false).project);
      }
      documents.undo();
      documents.undo();
      expect(documentKey(documents.project)).toBe(key);
      const read = readProject(writeProject(documents.project));
      expect(read.success && read.value.expressions).toEqual(documents.project.expressions);
    },
  );

  it("keep the numbers and say so if a text would be too long, for all or for none", () => {
    for (const { operation, piece, select, texts, plain = {} } of cases) {
      const documents = new DocumentStore(startWith("1"), () => 0);
      apply(documents, operationOf(piece), [], { texts: pieceTexts[piece] }, false);
      const { project } = documents;
      const subject = { project, selection: select(project) };
      const named = parameterValues(project.parameters);
      const [[field = "", text = ""] = []] = Object.entries(texts);
      const [key = "", axis] = field.split(".");
      const values = { ...operationOf(operation).initial(subject), ...centred(operation), ...plain };
      const number = readNumber(text, named) ?? 0;
      const before = values[key];
      const value: FieldValue =
        axis === undefined || typeof before !== "object"
          ? number
          : (before.map((x, k) => (k === Number(axis) ? number : x)) as unknown as Position);
      const long = { [field]: `${text}${"*1".repeat((LIMITS.expression - text.length) / 2)}` };
      const offer = operationOf(operation).make(subject, { ...values, [key]: value }, long);
      if (!offer.possible) throw new Error(offer.reason);
      expect(offer.creation.note, operation).toContain("too long");
      documents.edit(offer.creation.edit);
      expect(documents.project.expressions, operation).toBeUndefined();
    }
  });

  it.each([
    ["array-circular", "total", "centre.0"],
    ["revolve", "angle", "point.0"],
  ] as const)("%s: a full turn stays one whatever the parameters are, with a note", (id, key, centre) => {
    const operation = operationOf(id);
    const turned = (r: string, angle: string): DocumentStore => {
      const documents = new DocumentStore(startWith(r), () => 0);
      apply(documents, operationOf("create-box"), [], { plain: { position: [9, 0, 0] } }, false);
      const texts = { [key]: angle, [centre]: "r" };
      apply(documents, operation, top(documents.project), { texts, plain: { axis: [0, 1, 0] } }, true);
      return documents;
    };
    const documents = turned("1", "360*r");
    documents.edit(setParameter("r", "0.5"));
    expectNear(documents.project, turned("0.5", "360").project);

    const subject = { project: documents.project, selection: [] };
    const noteFor = (angle: number): string | undefined =>
      operation.note?.({ ...operation.initial(subject), [key]: angle }, subject, { [key]: "360*r" });
    expect(noteFor(360)).toContain("full turn");
    expect(noteFor(270)).toBe("");
    expect(noteFor(0)).toBe("");
  });

  it("leave a hole through a plane that turns with a parameter as it is, and say so", () => {
    const documents = new DocumentStore(startWith("1"), () => 0);
    apply(
      documents,
      operationOf("create-box"),
      [],
      { texts: { "axis.0": "r" }, plain: { axis: [1, 0, 3] } },
      true,
    );
    const { project } = documents;
    const subject = { project, selection: top(project) };
    const operation = operationOf("hole-through");
    const values = { ...operation.initial(subject), diameter: 0.2 };
    const offer = operation.make(subject, values);
    expect(offer.possible && offer.creation.note).toContain("will not follow");
  });
});

describe("a motion of points with expressions", () => {
  const moved = (documents: DocumentStore, offsetBy: Position): void => {
    const { project } = documents;
    const options = { label: "Move", join: false };
    const offer = offerTransform(project, [{ kind: "point", id: 1 }], translation(offsetBy), options);
    if (!offer.possible) throw new Error(offer.reason);
    documents.edit(offer.creation.edit);
  };
  const pointAt = (text: string): DocumentStore => {
    const documents = new DocumentStore(
      { ...startWith("2"), points: [{ id: 1, position: [0, 5, 0] }] },
      () => 0,
    );
    documents.edit(
      keepingExpressions({ label: "Type", change: () => undefined }, [
        { path: { kind: "point", id: 1, field: "position.0" }, expression: text },
      ]),
    );
    return documents;
  };
  const xOf = ({ project }: DocumentStore): string | undefined => project.expressions?.[0]?.expression;

  it("keeps them, and many small moves do not make them longer", () => {
    const documents = pointAt("3*r");
    moved(documents, [0.25, 1, 0]);
    expect(xOf(documents)).toBe("3*r+0.25");
    moved(documents, [0.5, 0, 0]);
    expect(xOf(documents)).toBe("3*r+0.75");
    moved(documents, [-1, 0, 0]);
    expect(xOf(documents)).toBe("3*r-0.25");
    documents.edit(setParameter("r", "3"));
    expect(documents.project.points[0]?.position).toEqual([8.75, 6, 0]);
    moved(documents, [0.25, 0, 0]);
    expect(xOf(documents)).toBe("3*r");
  });

  it.each(["2*(r+1)", "r-2e-1", "(r - 1)", "r^-1", "1 - r", "2e-1", "1e-1*r-3", "r+1e3"])(
    "adds a number to %s",
    (text) => {
      const named = new Map([["r", 0.7]]);
      const value = readNumber(text, named) ?? NaN;
      const sum = [0.5, -4.25, 1e-3].reduce<Quantity>(plus, quantity(value, text));
      const found = typeof sum === "number" ? NaN : readNumber(sum.text, named);
      expect(found).toBeCloseTo(value - 3.749, 12);
      expect(typeof sum === "number" ? NaN : sum.value).toBeCloseTo(value - 3.749, 12);
    },
  );
});
