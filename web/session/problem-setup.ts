import { patchNames } from "tetrafront/internal";
import type { Project, ProjectCondition, ProjectProblem } from "tetrafront/project";
import { recordsOf } from "../document/entities";
import type { Problem, ProblemKind, ScalarCondition, ElasticCondition, Vector } from "../solve/problem";

/** What happens on a patch. Only the entries that its kind uses count. */
export interface PatchCondition {
  readonly patch: string;
  readonly kind: ScalarCondition["kind"] | ElasticCondition["kind"];
  /** A temperature, a concentration, or an inward flux per unit of area. */
  readonly value: number;
  /** Force per unit of area. */
  readonly traction: Vector;
}

/** Returns all patches of a project in the order in which a mesh has them. */
export const patchesOf = (project: Project): readonly { readonly id: number }[] => [
  ...project.patches,
  ...recordsOf(project, "body-patch"),
];

/** A problem as the user states it: conditions by the names of patches. */
export interface ProblemSetup {
  readonly kind: ProblemKind;
  readonly conductivity: number;
  readonly diffusivity: number;
  readonly velocity: Vector;
  readonly source: number;
  readonly youngsModulus: number;
  readonly poissonRatio: number;
  readonly conditions: readonly PatchCondition[];
}

export const defaultSetup: ProblemSetup = {
  kind: "heat",
  conductivity: 1,
  diffusivity: 0.01,
  velocity: [1, 0, 0],
  source: 0,
  youngsModulus: 210_000,
  poissonRatio: 0.3,
  conditions: [],
};

/**
 * Returns the problem of a project, at first the usual one. `names`: names of its patches in their order, as conditions have them;
 * several patches may have one name.
 */
export function setupIn(
  project: Project,
  names: readonly (string | undefined)[] = patchNames(project),
): ProblemSetup {
  const { problem } = project;
  if (!problem) return defaultSetup;
  const nameOf = new Map(patchesOf(project).map(({ id }, p) => [id, names[p]]));
  const conditions: PatchCondition[] = [];
  for (const { patch: id, kind, value = 0, traction = atRest } of problem.conditions) {
    const patch = nameOf.get(id);
    const isKnown = conditions.some((one) => one.patch === patch && isElastic(one) === isElastic({ kind }));
    if (patch !== undefined && !isKnown) conditions.push({ patch, kind, value, traction });
  }
  const given = Object.entries(problem).filter(([, value]) => value !== undefined);
  return { ...defaultSetup, ...Object.fromEntries(given), conditions };
}

const atRest: Vector = [0, 0, 0];

/** Returns a problem in the form in which a project keeps it: conditions by the ids of patches. */
export function problemWith(setup: ProblemSetup, project: Project): ProjectProblem {
  const names = patchNames(project);
  const patches = patchesOf(project);
  const conditions = setup.conditions.flatMap(({ patch, kind, value, traction }) =>
    patches
      .filter((_, p) => names[p] === patch)
      .map(({ id }): ProjectCondition => ({
        patch: id,
        kind,
        ...((kind === "value" || kind === "flux") && { value }),
        ...(kind === "traction" && { traction }),
      })),
  );
  return { ...setup, conditions };
}

const isElastic = ({ kind }: Pick<PatchCondition, "kind">): boolean =>
  kind === "fixed" || kind === "traction";

/** Returns a condition with which a patch begins. */
export const defaultCondition = (kind: ProblemKind, patch: string): PatchCondition => ({
  patch,
  kind: kind === "elasticity" ? "fixed" : "value",
  value: 0,
  traction: [0, 0, 0],
});

/** Returns the kinds of conditions that a problem has. */
export const conditionKinds = (kind: ProblemKind): readonly PatchCondition["kind"][] =>
  kind === "elasticity" ? ["fixed", "traction"] : ["value", "flux"];

/** Returns the problem on a mesh whose patches have these names. Conditions of other kinds and of missing patches do not count. */
export function problemOf(setup: ProblemSetup, patchNames: readonly string[]): Problem {
  const { kind, source } = setup;
  switch (kind) {
    case "heat":
      return {
        kind,
        source,
        conductivity: setup.conductivity,
        conditions: scalarConditions(setup, patchNames),
      };
    case "advection": {
      const { diffusivity, velocity } = setup;
      return { kind, source, diffusivity, velocity, conditions: scalarConditions(setup, patchNames) };
    }
    case "elasticity": {
      const { youngsModulus, poissonRatio } = setup;
      const conditions = conditionsBy(setup, patchNames, elasticCondition);
      return { kind, youngsModulus, poissonRatio, bodyForce: [0, 0, 0], conditions };
    }
  }
}

const scalarConditions = (setup: ProblemSetup, patchNames: readonly string[]) =>
  conditionsBy(setup, patchNames, ({ kind, value }): ScalarCondition | null =>
    kind === "value" || kind === "flux" ? { kind, value } : null,
  );

function elasticCondition({ kind, traction }: PatchCondition): ElasticCondition | null {
  if (kind === "fixed") return { kind };
  return kind === "traction" ? { kind, traction } : null;
}

function conditionsBy<Condition>(
  { conditions }: ProblemSetup,
  patchNames: readonly string[],
  conditionOf: (given: PatchCondition) => Condition | null,
): ReadonlyMap<number, Condition> {
  const byPatch = new Map<number, Condition>();
  for (const given of conditions) {
    const condition = conditionOf(given);
    if (condition === null) continue;
    patchNames.forEach((name, patch) => {
      if (name === given.patch) byPatch.set(patch, condition);
    });
  }
  return byPatch;
}

/** Returns a vector with another component. */
export const withAxis = ([x, y, z]: Vector, axis: 0 | 1 | 2, value: number): Vector =>
  axis === 0 ? [value, y, z] : axis === 1 ? [x, value, z] : [x, y, value];
