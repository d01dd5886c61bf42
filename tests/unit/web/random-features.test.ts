/** Random work with the features of a solid: undo and redo give the same documents, and the file stays valid. */
import { expect, test } from "vitest";
import {
  createBody,
  readProject,
  type Project,
  type ProjectBody,
  type SolidFeature,
} from "tetrafront/project";
import { documentKey } from "../../../web/document/content-keys";
import { replaceBody } from "../../../web/document/body-edits";
import { emptyProject } from "../../../web/document/create";
import { expressionsOfFeature } from "../../../web/document/operations/feature-numbers";
import type { FieldExpressions, FieldValues, Operation } from "../../../web/document/operations/operation";
import { pieceOperations } from "../../../web/document/operations/pieces";
import type { Entity } from "../../../web/document/entities";
import { explode } from "../../../web/document/operations/solid-explosion";
import { loftOperations } from "../../../web/document/operations/solid-lofts";
import { changeOperations } from "../../../web/document/operations/solid-changes";
import { isSolid } from "../../../web/document/operations/solids";
import { setParameter } from "../../../web/document/parameters";
import { DocumentStore } from "../../../web/session/document-store";
import { OutdatedSolids } from "../../../web/session/outdated-solids";
import { randomSource } from "../../support/random";

const { points, triangles } = createBody(
  { points: Float64Array.of(0, 0, 0, 1, 0, 0, 0, 1, 1), triangles: Uint32Array.of(0, 1, 2) },
  { id: 1, firstPatchId: 1 },
);

/** Makes bodies whose points encode their features; some features fail. */
const solids = {
  bodyOf: (
    _: Project,
    before: ProjectBody | { readonly name: string },
    features: readonly SolidFeature[],
  ): Promise<ProjectBody> => {
    const { isOutdated: _outdated, failures: _failures, ...kept }: Partial<ProjectBody> = before;
    const failures = features
      .filter((one) => one.type === "fillet" && one.radius > 1)
      .map(({ id }) => ({ feature: id, message: "It is too large.", remedy: "Choose a smaller radius." }));
    const repairDeviation = [...JSON.stringify(features)].reduce(
      (sum, c) => (31 * sum + c.charCodeAt(0)) % 9973,
      7,
    );
    const patches = [{ id: 1, origin: "1/top" }];
    const made = { points, triangles, patches, features, repairDeviation };
    return Promise.resolve({ ...kept, id: 1, ...made, ...(failures.length > 0 && { failures }) });
  },
  edgesOf: () => Promise.resolve([{ name: "1/top|1/left", faces: ["1/top", "1/left"] as const }]),
  drawn: () => drawn(),
};

/** A tetrahedron, whatever the features are. */
const drawn = () =>
  Promise.resolve({
    drawing: {
      points: [
        [0, 0, 0],
        [1, 0, 0],
        [0, 1, 0],
        [0, 0, 1],
      ] as const,
      lines: [
        [0, 1],
        [1, 2],
        [2, 0],
        [0, 3],
        [1, 3],
        [2, 3],
      ].map((points) => ({ type: "straight", points }) as const),
      patches: [
        [3, 2, 1],
        [1, 5, -4],
        [2, 6, -5],
        [3, 4, -6],
      ].map((loop, face) => ({ type: "planar", loops: [loop], face, isExact: true }) as const),
      left: [],
    },
    faces: ["1/top", "1/left", "1/front", "1/bottom"],
    failures: [],
    isKernelSpent: false,
  });

/** Two squares, whose lines are 1 to 4 and 5 to 8, and a path of the line 9. */
const loops: Pick<Project, "points" | "lines" | "expressions"> = {
  points: [0, 1].flatMap((z) =>
    [
      [0, 0],
      [1, 0],
      [1, 1],
      [0, 1],
      [2, 2],
    ].map(([x = 0, y = 0], k) => ({ id: 5 * z + k + 1, position: [x, y, z] as const })),
  ),
  lines: [
    ...[0, 5].flatMap((first, z) =>
      [0, 1, 2, 3].map((k) => ({
        id: 4 * z + k + 1,
        type: "straight" as const,
        points: [first + k + 1, first + ((k + 1) % 4) + 1],
      })),
    ),
    { id: 9, type: "straight", points: [5, 10] },
  ],
  expressions: [6, 7, 8, 9].map((id) => ({ kind: "point", id, field: "position.2", expression: "a/2" })),
};

const lines = (...ids: readonly number[]): Entity[] => ids.map((id) => ({ kind: "line", id }));
const selections = new Map<Operation, readonly Entity[]>(
  loftOperations.map((operation, k) => [
    operation,
    k === 0 ? lines(1, 2, 3, 4, 5, 6, 7, 8) : lines(1, 2, 3, 4, 9),
  ]),
);

const solidIn = ({ project }: DocumentStore) => project.bodies?.find(isSolid);
const settle = (): Promise<void> => new Promise((resolve) => setTimeout(resolve));

/** Random work on one document. */
class Work {
  readonly documents = new DocumentStore({
    ...emptyProject(),
    ...loops,
    parameters: [
      { name: "a", expression: "2" },
      { name: "b", expression: "a/8" },
    ],
  });
  readonly #random: () => number;

  constructor(seed: number) {
    this.#random = randomSource(seed);
    new OutdatedSolids(this.documents, solids);
  }

  #of<Item>(items: readonly Item[]): Item {
    return items[this.#random() % items.length] as Item;
  }

  async step(): Promise<void> {
    const { documents } = this;
    const solid = solidIn(documents);
    const kind = this.#random() % 6;
    if (!solid || kind < 2)
      await this.#run(
        this.#of([...pieceOperations.slice(0, 7), ...changeOperations, ...loftOperations, ...loftOperations]),
      );
    else if (this.#random() % 12 === 0) await this.#run(explode);
    else if (kind === 2)
      documents.edit(setParameter(this.#of(["a", "b"]), this.#of(["1", "3", "0", "a+1", "20"])));
    else if (kind === 3) await this.#edit();
    else {
      const features = [...solid.features];
      const [moved] = features.splice(this.#random() % features.length, 1);
      if (kind === 4 && moved)
        features.splice(this.#random() % (features.length + 1), 0, { ...moved, isOff: true });
      if (features.length > 0)
        documents.edit(
          replaceBody(documents.project, "", await solids.bodyOf(documents.project, solid, features)),
        );
    }
    for (let k = 0; k < 4; ++k) await settle();
  }

  async #edit(): Promise<void> {
    const solid = solidIn(this.documents);
    if (!solid) return;
    const feature = this.#of(solid.features);
    const texts = expressionsOfFeature(this.documents.project, solid.id, feature.id);
    const panels = [...pieceOperations, ...loftOperations, ...changeOperations].map((one) =>
      one.edit(solid, feature, texts),
    );
    const panel = panels.find((one) => one !== null);
    if (panel) await this.#run(panel);
  }

  async #run(operation: Operation): Promise<void> {
    const subject = { project: this.documents.project, selection: selections.get(operation) ?? [] };
    const initial = operation.initial(subject);
    const makes = solidIn(this.documents) ? "cut" : "new";
    const values: FieldValues = {
      ...initial,
      ...("makes" in initial && { makes }),
      ...("keepProfile" in initial && { keepProfile: this.#random() % 4 > 0 }),
    };
    const numbers = Object.keys(values).filter(
      (key) => typeof values[key] === "number" && !/count|sides/.test(key),
    );
    const key = this.#of([...numbers, "position.0"]);
    const expressions: FieldExpressions = {
      ...operation.expressions?.(),
      [key]: this.#of(["a", "b", "a+b", "2*a"]),
    };
    const offer = await operation.makeLater?.(subject, values, solids, expressions);
    if (offer?.possible === true) this.documents.edit(offer.creation.edit);
  }
}

test.each(Array.from({ length: 25 }, (_, k) => k + 1))("20 steps of seed %i", async (seed) => {
  const work = new Work(seed * 7919);
  const { documents } = work;
  const keys = [documentKey(documents.project)];
  for (let k = 0; k < 20; ++k) {
    await work.step();
    // Quick changes of one parameter are one step.
    const { length } = documents.state.getState().history.past;
    keys[length] = documentKey(documents.project);
    keys.length = length + 1;
    expect(documents.project.bodies?.some(({ isOutdated }) => isOutdated) ?? false).toBe(false);
  }
  const read = readProject(JSON.stringify(documents.project));
  expect(read.success ? [] : read.errors).toEqual([]);
  for (let k = keys.length - 2; k >= 0; --k) {
    documents.undo();
    await settle();
    expect(documentKey(documents.project)).toBe(keys[k]);
  }
  for (let k = 1; k < keys.length; ++k) {
    documents.redo();
    await settle();
    expect(documentKey(documents.project)).toBe(keys[k]);
  }
});
