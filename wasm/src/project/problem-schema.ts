/** The problem that a solver solves on the mesh of a project: what it asks for, materials, and conditions on patches. */
import * as v from "valibot";
import { objectWith } from "../calls/schemas.js";
import { CONDITION_KINDS, PROBLEM_KINDS, type ProjectProblem } from "./project-types.js";
import {
  described,
  listOf,
  number,
  type Path,
  reference,
  type Report,
  threeNumbers,
} from "./schema-parts.js";
import { WORDS } from "./words.js";

const aboveZero = v.pipe(number, v.gtValue(0));

const conditionSchema = v.pipe(
  objectWith({
    patch: described(WORDS.conditionPatch, reference),
    kind: v.picklist(CONDITION_KINDS),
    value: v.optional(described(WORDS.conditionValue, number)),
    traction: v.optional(described(WORDS.traction, threeNumbers)),
  }),
  v.readonly(),
);

export const problemSchema = v.pipe(
  objectWith({
    kind: v.picklist(PROBLEM_KINDS),
    conductivity: v.optional(described(WORDS.conductivity, aboveZero)),
    diffusivity: v.optional(described(WORDS.diffusivity, aboveZero)),
    velocity: v.optional(described(WORDS.velocity, threeNumbers)),
    source: v.optional(described(WORDS.volumeSource, number)),
    youngsModulus: v.optional(described(WORDS.youngsModulus, aboveZero)),
    poissonRatio: v.optional(described(WORDS.poissonRatio, v.pipe(number, v.gtValue(-1), v.ltValue(0.5)))),
    conditions: described(WORDS.conditions, listOf(conditionSchema)),
  }),
  v.readonly(),
);

/** Conditions of elasticity; a patch may have one of these, and one of the others. */
const ELASTIC = ["fixed", "traction"];

/** Reports conditions on patches that do not exist, and the second one of a patch. */
export function checkProblem(
  { problem, hasPatch }: { readonly problem: ProjectProblem; readonly hasPatch: (patch: number) => boolean },
  report: Report,
): void {
  const seen = new Set<string>();
  problem.conditions.forEach(({ patch, kind }, c) => {
    const path: Path = ["problem", "conditions", c];
    if (!hasPatch(patch)) report([...path, "patch"], `there is no patch with the id ${patch}`);
    const key = `${patch} ${ELASTIC.includes(kind)}`;
    if (seen.has(key)) report(path, `another condition is on patch ${patch}`);
    seen.add(key);
  });
}
