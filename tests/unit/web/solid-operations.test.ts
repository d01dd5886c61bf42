/** Pieces and changes as features of solids: what panels make of values, and read from features again. */
import { expect, test } from "vitest";
import {
  createBody,
  readProject,
  type Project,
  type ProjectBody,
  type SolidFeature,
} from "tetrafront/project";
import { emptyProject } from "../../../web/document/create";
import { isAllowed } from "../../../web/document/number-paths";
import { expressionsOfFeature } from "../../../web/document/operations/feature-numbers";
import type {
  FieldExpressions,
  FieldValues,
  Operation,
  SolidMaker,
} from "../../../web/document/operations/operation";
import { pieceOperations } from "../../../web/document/operations/pieces";
import { sew } from "../../../web/document/operations/solid-sewing";
import { featureSweeps } from "../../../web/document/operations/sweeps";
import { changeOperations } from "../../../web/document/operations/solid-changes";
import { setParameter } from "../../../web/document/parameters";
import { replaceBody } from "../../../web/document/body-edits";
import { DocumentStore } from "../../../web/session/document-store";
import { editBoolean, solidBoolean } from "../../../web/document/operations/solid-booleans";
import { isSolid, solidIn, type Solid } from "../../../web/document/operations/solids";

/** Notes the features that it is asked for. */
class NotedSolids implements SolidMaker {
  features: readonly SolidFeature[] = [];
  failures: { readonly feature: number; readonly message: string; readonly remedy: string }[] = [];
  readonly #edges = [
    { name: "1/top|1/front", faces: ["1/top", "1/front"] },
    { name: "1/top|1/left", faces: ["1/top", "1/left"] },
    { name: "1/front|1/left", faces: ["1/front", "1/left"] },
    { name: "1/top|1/top", faces: ["1/top", "1/top"] },
  ] as const;

  bodyOf(_: Project, before: ProjectBody | { readonly name: string }, features: readonly SolidFeature[]) {
    this.features = features;
    const body = bodyWith(features, "id" in before ? before : undefined);
    return Promise.resolve({ ...body, ...(this.failures.length > 0 && { failures: this.failures }) });
  }

  edgesOf() {
    return Promise.resolve(this.#edges);
  }

  drawn(): Promise<never> {
    return Promise.reject(new Error("not drawn"));
  }

  samplesOf(): Promise<never> {
    return Promise.reject(new Error("not sampled"));
  }
}

const { points, triangles } = createBody(
  { points: Float64Array.of(0, 0, 0, 1, 0, 0, 0, 1, 1), triangles: Uint32Array.of(0, 1, 2) },
  { id: 1, firstPatchId: 1 },
);

const bodyWith = (features: readonly SolidFeature[], before?: ProjectBody): Solid => ({
  id: 1,
  points,
  triangles,
  patches: ["top", "front", "left"].map((face, p) => ({ id: p + 1, origin: `1/${face}` })),
  ...before,
  features,
});

const box: SolidFeature = {
  id: 1,
  type: "box",
  operation: "new",
  position: [0, 0, 0],
  axis: [0, 0, 1],
  size: [1, 1, 1],
};

const withSolid = (solid: Solid): Project => ({ ...emptyProject("solid"), bodies: [solid] });

/** Returns the features that an operation gives, with some of its values changed. */
async function featuresOf(
  operation: Operation,
  subject: Parameters<Operation["make"]>[0],
  change: FieldValues,
): Promise<readonly SolidFeature[]> {
  const solids = new NotedSolids();
  const values = { ...operation.initial(subject), ...change };
  const offer = await operation.makeLater?.(subject, values, solids);
  expect(offer?.possible).toBe(true);
  return solids.features;
}

const solidPieces = pieceOperations.filter(({ id }) => id !== "create-wing");

test.each(solidPieces)("$id becomes a feature that its panel reads again", async (operation) => {
  const subject = { project: emptyProject(), selection: [] };
  const place = { position: [1, 2, 3], axis: [0, 1, 0] } as const;
  const [feature] = await featuresOf(operation, subject, { ...place, makes: "new", anchor: "base" });
  if (!feature) throw new Error("no feature");
  expect(feature).toMatchObject({ id: 1, operation: "new" });
  const solid = bodyWith([feature]);
  const edit = operation.edit(solid, feature);
  if (!edit) throw new Error("no panel");
  const project = withSolid(solid);
  const [same] = await featuresOf(edit, { project, selection: [] }, {});
  for (const [key, value] of Object.entries(feature)) {
    const again: unknown = (same as unknown as Record<string, unknown>)[key];
    const isVector = Array.isArray(value);
    if (isVector) value.forEach((x, k) => expect((again as number[])[k]).toBeCloseTo(Number(x), 12));
    else expect(again).toEqual(value);
  }
  expect(pieceOperations.filter((other) => other.edit(solid, feature) !== null)).toEqual([operation]);
});

test("a wing is patches only", () => {
  const wing = pieceOperations.find(({ id }) => id === "create-wing");
  const subject = { project: withSolid(bodyWith([box])), selection: [] };
  const values = wing?.initial(subject) ?? {};
  expect(wing?.fields(values, subject).map(({ key }) => key)).not.toContain("makes");
});

test("beside a solid, a piece joins it, and can cut it; the ids of features differ", async () => {
  const solid = bodyWith([box, { ...box, id: 7, operation: "join" }]);
  const subject = { project: withSolid(solid), selection: [] };
  const cylinder = solidPieces.find(({ id }) => id === "create-cylinder");
  if (!cylinder) throw new Error("no cylinder");
  expect(cylinder.initial(subject)["makes"]).toBe("join");
  const features = await featuresOf(cylinder, subject, { makes: "cut" });
  expect(features.map(({ id }) => id)).toEqual([1, 7, 8]);
  expect(features[2]).toMatchObject({ type: "cylinder", operation: "cut" });
});

test.each([
  ["all", [], ["1/top|1/front", "1/top|1/left", "1/front|1/left"]],
  ["those around one patch", [1], ["1/top|1/front", "1/top|1/left"]],
  ["those between several", [1, 3], ["1/top|1/left"]],
])("the edges of a fillet are %s, without seams", async (_, patches, edges) => {
  const fillet = changeOperations.find(({ id }) => id === "solid-fillet");
  if (!fillet) throw new Error("no fillet");
  const selection = patches.map((id) => ({ kind: "body-patch", id }) as const);
  const project = withSolid(bodyWith([box]));
  const features = await featuresOf(fillet, { project, selection }, {});
  expect(features[1]).toMatchObject({ type: "fillet", edges });
});

test.each(changeOperations)("$id is read again by its panel, and needs a solid", async (operation) => {
  const subject = { project: withSolid(bodyWith([box])), selection: [] };
  const features = await featuresOf(operation, subject, {});
  const feature = features[1];
  if (!feature) throw new Error("no feature");
  const solid = bodyWith(features);
  const edit = operation.edit(solid, feature);
  if (!edit) throw new Error("no panel");
  expect(await featuresOf(edit, { ...subject, project: withSolid(solid) }, {})).toEqual(features);
  const nothing = { project: emptyProject(), selection: [] };
  expect(operation.makeLater?.(nothing, operation.initial(nothing), new NotedSolids())).toBeNull();
  expect(operation.make(nothing, operation.initial(nothing)).possible).toBe(false);
});

test("of several solids, the selected one is meant", () => {
  const [one, other] = [bodyWith([box]), { ...bodyWith([box]), id: 2, patches: [{ id: 9 }] }];
  const project: Project = { ...emptyProject(), bodies: [one, other] };
  expect(isSolid(one)).toBe(true);
  expect(solidIn({ project, selection: [] })).toBeUndefined();
  expect(solidIn({ project, selection: [{ kind: "body", id: 2 }] })).toBe(other);
  expect(solidIn({ project, selection: [{ kind: "body-patch", id: 2 }] })).toBe(one);
});

test("what the panel of a feature does not show stays: its name, whether it is used, the kind of hole", async () => {
  const hole: SolidFeature = {
    id: 2,
    type: "hole",
    name: "drain",
    isOff: true,
    position: [0, 0, 1],
    axis: [0, 0, -1],
    diameter: 0.2,
    depth: 0.5,
    counterbore: { diameter: 0.4, depth: 0.1 },
  };
  const solid = bodyWith([box, hole]);
  const subject = { project: withSolid(solid), selection: [] };
  const edit = changeOperations.map((one) => one.edit(solid, hole)).find((one) => one !== null);
  if (!edit) throw new Error("no panel");
  const [, wider] = await featuresOf(edit, subject, { diameter: 0.3 });
  expect(wider).toEqual({ ...hole, diameter: 0.3 });
  const [, through] = await featuresOf(edit, subject, { through: true });
  const { depth: _, ...rest } = hole;
  expect(through).toEqual(rest);
});

test("a feature that fails is refused with its remedy; others that fail are a note", async () => {
  const solid = bodyWith([box]);
  const subject = { project: withSolid(solid), selection: [] };
  const fillet = changeOperations.find(({ id }) => id === "solid-fillet");
  const values = fillet?.initial(subject) ?? {};
  const solids = new NotedSolids();
  solids.failures = [{ feature: 2, message: "It is too large.", remedy: "Choose a smaller radius." }];
  const refused = await fillet?.makeLater?.(subject, values, solids);
  expect(refused).toEqual({ possible: false, reason: "It is too large. Choose a smaller radius." });
  solids.failures = [{ feature: 7, message: "It is too large.", remedy: "Choose a smaller radius." }];
  const offer = await fillet?.makeLater?.(subject, values, solids);
  expect(offer?.possible === true && offer.creation.note).toContain("feature 7");
});

test("of a solid that was moved as a whole, the motion is a feature before the next one", async () => {
  const s = Math.SQRT1_2;
  const placement = { position: [1, 0, 0], rotation: [0, 0, s, s] } as const;
  const subject = { project: withSolid({ ...bodyWith([box]), placement }), selection: [] };
  for (const operation of [...changeOperations, ...solidPieces]) {
    const features = await featuresOf(operation, subject, {});
    expect(features.map(({ id }) => id)).toEqual([1, 2, 3]);
    expect(features[1]).toMatchObject({
      type: "move",
      translation: [1, 0, 0],
      rotation: { axis: [0, 0, s] },
    });
    const [, move] = features;
    expect(move?.type === "move" && move.rotation?.angle).toBeCloseTo(90, 12);
  }
  const scaled = { ...subject, project: withSolid({ ...bodyWith([box]), placement: { scale: 2 } }) };
  const [hole] = changeOperations;
  const later = async () => hole?.makeLater?.(scaled, hole.initial(scaled), new NotedSolids());
  await expect(later).rejects.toThrow("scaled");
});

const parameters = [
  { name: "w", expression: "2" },
  { name: "r", expression: "w/8" },
];

/** Adds what an operation gives to the project of a store, with its expressions. */
async function addTo(
  documents: DocumentStore,
  operation: Operation,
  change: FieldValues,
  expressions: FieldExpressions,
): Promise<void> {
  const subject = { project: documents.project, selection: [] };
  const values = { ...operation.initial(subject), ...change };
  const offer = await operation.makeLater?.(subject, values, new NotedSolids(), expressions);
  if (offer?.possible !== true) throw new Error("refused");
  documents.edit(offer.creation.edit);
}

const featuresIn = ({ project }: DocumentStore) => project.bodies?.[0]?.features ?? [];

/** Returns a store with a box of the width w, centred at z = 0, with a hole of the diameter r. */
async function parametricBox(): Promise<DocumentStore> {
  const documents = new DocumentStore({ ...emptyProject(), parameters });
  const [createBox] = solidPieces;
  const [hole] = changeOperations;
  if (!createBox || !hole) throw new Error("no operations");
  const size = { width: 2, depth: 3, height: 4, anchor: "centre", makes: "new" } as const;
  await addTo(documents, createBox, { ...size, axis: [0, 0, 1] }, { width: "w", height: "2*w" });
  await addTo(
    documents,
    hole,
    { diameter: 0.25, position: [1, 0, 0] },
    { diameter: "r", "position.0": "w/2" },
  );
  return documents;
}

test("numbers of features follow parameters, and the solid is outdated until it is made again", async () => {
  const documents = await parametricBox();
  expect(documents.project.bodies?.[0]?.isOutdated).toBeUndefined();
  expect(documents.project.expressions).toContainEqual({
    kind: "body",
    id: 1,
    field: "features.1.position.2",
    expression: "-2*w/2",
  });
  const before = documents.project;
  documents.edit(setParameter("w", "4"));
  expect(featuresIn(documents)[0]).toMatchObject({ size: [4, 3, 8], position: [0, 0, -4] });
  expect(featuresIn(documents)[1]).toMatchObject({ diameter: 0.5, position: [2, 0, 0] });
  expect(documents.project.bodies?.[0]?.isOutdated).toBe(true);
  documents.amend({ change: ({ project }) => void delete project.bodies?.[0]?.isOutdated });
  const after = documents.project;
  documents.undo();
  expect(documents.project).toEqual(before);
  documents.redo();
  expect(documents.project).toEqual(after);
  const bodies = (after.bodies ?? []).map((body) => ({ ...body, patches: body.patches.slice(0, 1) }));
  const read = readProject(JSON.stringify({ ...after, bodies }));
  expect(read).toMatchObject({ value: { expressions: after.expressions } });
});

test("the panel of a feature shows its expressions, and forgets those that are replaced by numbers", async () => {
  const documents = await parametricBox();
  const { project } = documents;
  const [solid] = project.bodies ?? [];
  const [, feature] = featuresIn(documents);
  if (!solid || !isSolid(solid) || !feature) throw new Error("no solid");
  const expressions = expressionsOfFeature(project, solid.id, feature.id);
  const edit = changeOperations
    .map((one) => one.edit(solid, feature, expressions))
    .find((one) => one !== null);
  expect(edit?.expressions?.()).toEqual({ diameter: "r", "position.0": "w/2" });
  if (edit) await addTo(documents, edit, { diameter: 0.75 }, { "position.0": "w/2" });
  expect(expressionsOfFeature(documents.project, solid.id, feature.id)).toEqual({ "position.0": "w/2" });
  documents.edit(setParameter("w", "3"));
  expect(featuresIn(documents)[1]).toMatchObject({ diameter: 0.75, position: [1.5, 0, 0] });
});

test("an expression goes with its feature, and gives no half holes in an array", async () => {
  const documents = await parametricBox();
  const { project } = documents;
  const [body] = project.bodies ?? [];
  if (!body) throw new Error("no solid");
  documents.edit(replaceBody(project, "", { ...body, features: featuresIn(documents).slice(0, 1) }));
  expect(documents.project.expressions?.every(({ field }) => field.startsWith("features.1."))).toBe(true);
  const count = { kind: "body", id: 1, field: "features.2.count" } as const;
  expect([2.5, 0, 3].map((value) => isAllowed(count, value))).toEqual([false, false, true]);
});

test("patches of other bodies choose no edges", async () => {
  const solid = bodyWith([box]);
  const subject = { project: withSolid(solid), selection: [{ kind: "body-patch", id: 99 } as const] };
  const fillet = changeOperations.find(({ id }) => id === "solid-fillet");
  const later = fillet?.makeLater?.(subject, fillet.initial(subject), new NotedSolids());
  await expect(later).rejects.toThrow("no edge");
});

test("a solid becomes a feature of another one, with its expressions and its motion", async () => {
  const documents = await parametricBox();
  const tool: Solid = { ...bodyWith([box]), id: 2, placement: { position: [0, 0, 1] } };
  const path = { kind: "body", id: 2, field: "features.1.size.1" } as const;
  const { project } = documents;
  documents.edit({
    label: "",
    replace: {
      bodies: [...(project.bodies ?? []), tool],
      expressions: [...(project.expressions ?? []), { ...path, expression: "w/2" }],
    },
  });
  const [first, second] = documents.project.bodies?.filter(isSolid) ?? [];
  if (!first || !second) throw new Error("no solids");
  await addTo(documents, solidBoolean([first, second], "difference"), {}, {});
  expect(documents.project.bodies?.map(({ id }) => id)).toEqual([1]);
  expect(featuresIn(documents)[2]).toMatchObject({
    type: "boolean",
    operation: "cut",
    tool: [{ type: "box" }, { type: "move", translation: [0, 0, 1] }],
  });
  documents.edit(setParameter("w", "6"));
  expect(featuresIn(documents)[2]).toMatchObject({ tool: [{ size: [1, 3, 1] }, { id: 2 }] });
  const [solid] = documents.project.bodies?.filter(isSolid) ?? [];
  const feature = featuresIn(documents)[2];
  if (!solid || !feature) throw new Error("no solid");
  const edit = editBoolean.edit(solid, feature, expressionsOfFeature(documents.project, 1, feature.id));
  if (edit) await addTo(documents, edit, { kind: "union" }, edit.expressions?.() ?? {});
  expect(featuresIn(documents)[2]).toMatchObject({ operation: "join" });
  documents.edit(setParameter("w", "8"));
  expect(featuresIn(documents)[2]).toMatchObject({ tool: [{ size: [1, 4, 1] }, { id: 2 }] });
});

/** Returns a project with a rectangle of the width w beside z, drawn as a patch with a round hole. */
function drawnRectangle(): Project {
  const positions = [
    [1, 0, 0],
    [3, 0, 0],
    [3, 0, 1],
    [1, 0, 1],
    [2.25, 0, 0.5],
    [2, 0, 0.75],
    [1.75, 0, 0.5],
  ] as const;
  const straight = [1, 2, 3, 4].map((id) => ({ id, type: "straight", points: [id, (id % 4) + 1] }) as const);
  return {
    ...emptyProject(),
    parameters,
    points: positions.map((position, p) => ({ id: p + 1, position })),
    lines: [...straight, { id: 5, type: "circle", points: [5, 6, 7, 5] }],
    patches: [{ id: 1, type: "planar", loops: [[1, 2, 3, 4], [5]] }],
    expressions: [2, 3].map((id) => ({ kind: "point", id, field: "position.0", expression: "1+w" })),
  };
}

const patchSelection = [{ kind: "patch", id: 1 }] as const;

test.each([
  ["extrude", { distance: 2, direction: [0, -1, 0] as const }, { distance: "w" }, { vector: [0, -3, 0] }],
  ["revolve", { angle: 90 }, { angle: "45*w" }, { angle: 135 }],
])(
  "a drawn patch becomes a feature by %s, with the expressions of its points",
  async (id, values, typed, after) => {
    const operation = featureSweeps.find((one) => one.id === id);
    if (!operation) throw new Error("no operation");
    const documents = new DocumentStore(drawnRectangle());
    const subject = { project: documents.project, selection: patchSelection };
    const given = { ...operation.initial(subject), ...values, makes: "new" };
    const offer = await operation.makeLater?.(subject, given, new NotedSolids(), typed);
    if (offer?.possible !== true) throw new Error("refused");
    documents.edit(offer.creation.edit);
    const { points, lines, patches } = documents.project;
    expect([points.length, lines.length, patches.length]).toEqual([0, 0, 0]);
    documents.edit(setParameter("w", "3"));
    const [feature] = featuresIn(documents);
    expect(feature).toMatchObject({ type: id, operation: "new", ...after });
    expect(feature).toMatchObject({
      profile: {
        outer: [
          {
            kind: "line",
            points: [
              [1, 0, 0],
              [4, 0, 0],
            ],
          },
          {
            points: [
              [4, 0, 0],
              [4, 0, 1],
            ],
          },
          {
            points: [
              [4, 0, 1],
              [1, 0, 1],
            ],
          },
          {
            points: [
              [1, 0, 1],
              [1, 0, 0],
            ],
          },
        ],
        holes: [[{ kind: "circle", center: [2, 0, 0.5], radius: 0.25 }]],
      },
    });
    const [solid] = documents.project.bodies?.filter(isSolid) ?? [];
    if (!solid || !feature) throw new Error("no solid");
    const edit = operation.edit(solid, feature, expressionsOfFeature(documents.project, 1, 1));
    expect(edit?.expressions?.()).toEqual(typed);
    if (edit) await addTo(documents, edit, {}, typed);
    expect(featuresIn(documents)[0]).toEqual(feature);
  },
);

test("what is drawn and not plane is refused, and what others use stays", async () => {
  const [extrude] = featureSweeps;
  if (!extrude) throw new Error("no operation");
  const project = drawnRectangle();
  const values = { ...extrude.initial({ project, selection: patchSelection }), makes: "new" };
  const nothing = { project, selection: [] };
  expect(extrude.makeLater?.(nothing, values, new NotedSolids())).toBeNull();
  expect(extrude.make(nothing, values)).toMatchObject({ possible: false });
  const other = { id: 2, type: "planar", loops: [[1, 2, 3, 4]] } as const;
  const shared = { project: { ...project, patches: [...project.patches, other] }, selection: patchSelection };
  const offer = await extrude.makeLater?.(shared, values, new NotedSolids());
  expect(offer).toMatchObject({
    creation: { edit: { replace: { patches: [other], lines: project.lines.slice(0, 4) } } },
  });
});

test("drawn patches that are connected to the selected one are sewn, and an empty drawing is refused", async () => {
  const [createBox] = solidPieces;
  if (!createBox) throw new Error("no box");
  const documents = new DocumentStore(emptyProject());
  const empty = { project: documents.project, selection: [] };
  const offer = createBox.make(empty, { ...createBox.initial(empty), makes: "patches" });
  if (!offer.possible) throw new Error("refused");
  documents.edit(offer.creation.edit);
  const subject = { project: documents.project, selection: [{ kind: "patch", id: 1 } as const] };
  const sewn = await sew.makeLater?.(subject, sew.initial(subject), new NotedSolids());
  if (sewn?.possible !== true) throw new Error("refused");
  documents.edit(sewn.creation.edit);
  const [feature] = featuresIn(documents);
  const loops = feature?.type === "sew" ? feature.faces : [];
  expect(loops.map((face) => "outer" in face && face.outer.length)).toEqual([4, 4, 4, 4, 4, 4]);
  expect(documents.project.patches).toEqual([]);
  expect(sew.make(empty, sew.initial(empty))).toMatchObject({ possible: false });
});
