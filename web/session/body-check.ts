import type { Diagnostic, Mesher, PreparedBody } from "tetrafront";
import type { Project } from "tetrafront/project";
import { createStore, type StoreApi } from "zustand/vanilla";
import { meshKey, namesKey } from "../document/content-keys";
import { engineInput } from "../document/engine-input";
import { bodiesOf, recordsOf } from "../document/entities";
import { withoutBodies } from "../document/painted-sizes";
import { strings } from "../strings";
import { fillableBodies, type BodyFeed } from "./bodies";
import { derived, sameItems, type Readable } from "./derived";
import { settledProject, type DocumentStore } from "./document-store";
import { LatestTask } from "./latest-task";

export interface BodyCheckState {
  /** Key of the project that was checked last; null before the first check. */
  readonly key: string | null;
  /** The errors that a run of this project would find before its front starts, apart from bodies that touch. */
  readonly errors: readonly Diagnostic[];
  /** Ids of the bodies in each group of bodies that touch or intersect, which “Generate mesh” joins. */
  readonly touching: readonly (readonly number[])[];
}

const unchecked: BodyCheckState = { key: null, errors: [], touching: [] };

/** Largest number of triangles of all bodies that are checked unasked. */
const maxTriangles = 300_000;

/** What to check. */
interface Question {
  readonly project: Project;
  /** Key of the project, and of the names that its errors have. */
  readonly key: string;
  readonly names: string;
  readonly preparedBodies: readonly PreparedBody[];
}

/**
 * Finds what a run would refuse: bodies that intersect drawn patches or each other, or lie outside the background grid;
 * and bodies that would be joined. Checks as soon as all bodies have up-to-date previews.
 */
export class BodyCheck {
  readonly state: StoreApi<BodyCheckState> = createStore<BodyCheckState>(() => unchecked);
  readonly #mesher: Promise<Mesher>;
  readonly #bodies: BodyFeed;
  readonly #task = new LatestTask();
  /** Key of the names in the errors. */
  #names = "";

  constructor(documents: DocumentStore, mesher: Promise<Mesher>, bodies: BodyFeed) {
    this.#mesher = mesher;
    this.#bodies = bodies;
    documents.onLeave(() => {
      this.#task.cancel();
      this.state.setState(unchecked);
    });
    questionOf(documents, bodies).subscribe((question) => this.#check(question));
  }

  #check(question: Question | null): void {
    this.#task.cancel();
    if (!question || this.#isAnswered(question)) return;
    const { key, names } = question;
    this.#task
      .run(
        (signal) => this.#found(question, signal),
        (found) => {
          this.#names = names;
          this.state.setState({ key, ...found });
        },
      )
      // A run will report what has failed.
      .catch(() => undefined);
  }

  #isAnswered({ key, names }: Question): boolean {
    const { key: checked, errors } = this.state.getState();
    return key === checked && (errors.length === 0 || names === this.#names);
  }

  async #found(
    { project, preparedBodies }: Question,
    signal: AbortSignal,
  ): Promise<Omit<BodyCheckState, "key">> {
    const mesher = await this.#mesher;
    const given = fillableBodies(this.#bodies.state.getState().byId.values());
    const groups = await this.#bodies.pairs.touching(mesher, given, signal);
    const touching = groups.map((group) => group.map(({ body }) => body.id));
    const errors: Diagnostic[] = [];
    for (const others of leftOut(touching)) {
      const found = await errorsOf(mesher, project, preparedBodies, others, signal);
      errors.push(...found);
    }
    return { errors, touching };
  }
}

/** What to check of the present project; null if nothing can fail, or the triangles of some bodies are not known. */
function questionOf(documents: DocumentStore, bodies: BodyFeed): Readable<Question | null> {
  const settled = derived((read) => settledProject(read(documents.state)));
  const prepared = derived((read, before: readonly unknown[] | undefined) =>
    sameItems(
      [...read(bodies.state).byId.values()].map(({ preparation }) => preparation),
      before,
    ),
  );
  return derived((read, before: Question | null | undefined) => {
    const project = read(settled);
    read(prepared);
    if (!canFail(project)) return null;
    const preparedBodies = bodies.preparations.allOf(project);
    const triangles = preparedBodies.reduce((sum, body) => sum + body.triangles.length / 3, 0);
    if (preparedBodies.length < bodiesOf(project).length || triangles > maxTriangles) return null;
    const [key, names] = [meshKey(project), namesKey(project)];
    return before?.key === key && before.names === names ? before : { project, key, names, preparedBodies };
  });
}

/**
 * Returns ids of bodies to leave out of a project, one set for each check of it: no two bodies of a group are in it then, and
 * each body is in it once at least.
 */
function leftOut(groups: readonly (readonly number[])[]): readonly ReadonlySet<number>[] {
  const checks = Math.max(1, ...groups.map(({ length }) => length));
  return Array.from(
    { length: checks },
    (_, check) =>
      new Set(
        groups.flatMap((group) => group.filter((id) => id !== group[Math.min(check, group.length - 1)])),
      ),
  );
}

/** Returns the errors that a run of a project without some of its bodies finds before its front starts. */
async function errorsOf(
  mesher: Mesher,
  project: Project,
  preparedBodies: readonly PreparedBody[],
  others: ReadonlySet<number>,
  signal: AbortSignal,
): Promise<readonly Diagnostic[]> {
  const [input, options] = engineInput(others.size === 0 ? project : withoutBodies(project, others));
  const known = preparedBodies.filter(({ body }) => !others.has(body));
  const { diagnostics } = await mesher.checkProject(input, { ...options, preparedBodies: known }, { signal });
  return diagnostics.filter(({ severity }) => severity === "error").map(withoutTriangles);
}

/** Leaves out triangles and nodes of a surface that the page does not have. */
const withoutTriangles = (found: Diagnostic): Diagnostic => ({
  ...found,
  remedy: found.code === "self-intersection" ? strings.bodies.conflict : found.remedy,
  entities: found.entities.filter(({ kind }) => kind === "patch"),
});

/** Returns whether bodies may conflict with something else; a single body is inspected by itself. */
function canFail(project: Project): boolean {
  const bodies = bodiesOf(project).length;
  const { background, meshing } = project;
  const hasGrid = background.tetrahedra.length > 0 && meshing?.size === undefined;
  return bodies > 1 || (bodies > 0 && (hasGrid || recordsOf(project, "patch").length > 0));
}
