/** Random work with the features of a solid, and whether undo and redo give the same documents. */
import { readProject, type Project } from "tetrafront/project";
import { documentKey } from "../../web/document/content-keys";
import { replaceBody } from "../../web/document/body-edits";
import { emptyProject } from "../../web/document/create";
import { expressionsOfFeature } from "../../web/document/operations/feature-numbers";
import type {
  FieldExpressions,
  FieldValues,
  Operation,
  SolidMaker,
} from "../../web/document/operations/operation";
import { pieceOperations } from "../../web/document/operations/pieces";
import type { Entity } from "../../web/document/entities";
import { explode } from "../../web/document/operations/solid-explosion";
import { loftOperations } from "../../web/document/operations/solid-lofts";
import { changeOperations } from "../../web/document/operations/solid-changes";
import { isSolid } from "../../web/document/operations/solids";
import { setParameter } from "../../web/document/parameters";
import { DocumentStore } from "../../web/session/document-store";
import { OutdatedSolids } from "../../web/session/outdated-solids";
import { NoSolid } from "../../web/session/solids";
import { randomSource } from "./random";

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

/** Returns what a task gives; undefined if the features give no solid. */
async function unlessNoSolid<Result>(
  task: () => Promise<Result> | null | undefined,
): Promise<Result | null | undefined> {
  try {
    return await task();
  } catch (failure) {
    if (failure instanceof NoSolid) return undefined;
    throw failure;
  }
}

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
  readonly #solids: SolidMaker;
  readonly #outdated: OutdatedSolids;

  constructor(seed: number, solids: SolidMaker) {
    this.#random = randomSource(seed);
    this.#solids = solids;
    this.#outdated = new OutdatedSolids(this.documents, solids);
  }

  /** Waits until all solids are those of their features. */
  async settle(): Promise<void> {
    await new Promise((resolve) => setTimeout(resolve));
    await this.#outdated.settled(new AbortController().signal);
  }

  #of<Item>(items: readonly Item[]): Item {
    return items[this.#random() % items.length] as Item;
  }

  /** Does something. */
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
      const { project } = documents;
      const made = await unlessNoSolid(() =>
        features.length > 0 ? this.#solids.bodyOf(project, solid, features) : undefined,
      );
      if (made) documents.edit(replaceBody(project, "", made));
    }
    await this.settle();
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
    const offer = await unlessNoSolid(() =>
      operation.makeLater?.(subject, values, this.#solids, expressions),
    );
    if (offer?.possible === true) this.documents.edit(offer.creation.edit);
  }
}

/** Returns what is wrong after random work, undo of all of it and redo; empty if nothing is. */
export async function findingsOf(seed: number, steps: number, solids: SolidMaker): Promise<string[]> {
  const work = new Work(seed * 7919, solids);
  const { documents } = work;
  const findings: string[] = [];
  const keys = [documentKey(documents.project)];
  for (let k = 0; k < steps; ++k) {
    await work.step();
    // Quick changes of one parameter are one step.
    const { length } = documents.state.getState().history.past;
    keys[length] = documentKey(documents.project);
    keys.length = length + 1;
    if (documents.project.bodies?.some(({ isOutdated }) => isOutdated) ?? false)
      findings.push(`step ${k}: a solid is not that of its features`);
  }
  const read = readProject(JSON.stringify(documents.project));
  if (!read.success) findings.push(...read.errors.map(({ message }) => message));
  const compare = async (what: string, k: number) => {
    await work.settle();
    if (documentKey(documents.project) !== keys[k]) findings.push(`${what} ${k} gives another document`);
  };
  for (let k = keys.length - 2; k >= 0; --k) {
    documents.undo();
    await compare("undo to", k);
  }
  for (let k = 1; k < keys.length; ++k) {
    documents.redo();
    await compare("redo to", k);
  }
  return findings;
}
