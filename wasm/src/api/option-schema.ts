/** How options are described: a schema for each, with limits, default and words, and the check of an object of them. */
import * as v from "valibot";
import { numbersOf } from "../base/enums.js";
import { LIMITS, limitText } from "../base/limits.js";
import { asObject, shown } from "../base/values.js";
import type { Diagnostic } from "../diagnostics/diagnostic.js";
import { invalidOption } from "../diagnostics/package-diagnostic.js";
import {
  INNER_SHELLS,
  MAX_LENGTH,
  MAX_REMESH_ANGLE,
  MESH_DEFAULTS,
  MIN_LENGTH,
  MIN_REMESH_ANGLE,
} from "../generated/constants.js";
import { type BackgroundArrays, checkBackground, hasSourcesOnly } from "../project/background-arrays.js";
import type { MeshOptions } from "./option-types.js";

/** Words for an option in messages: its name, and the values that it accepts. */
export interface OptionWords {
  readonly label: string;
  readonly expected: string;
}

/** An option that may be omitted; `otherwise` is its default. */
export function option<
  const Schema extends v.GenericSchema,
  const Default extends v.InferInput<Schema> | undefined,
>(label: string, expected: string, schema: Schema, otherwise: Default) {
  const words: OptionWords = { label, expected };
  return v.optional(v.pipe(schema, v.metadata({ words })), otherwise);
}

/** One schema per option of an interface, and no others. */
export type EntriesOf<Options> = {
  readonly [Name in keyof Options]-?: v.GenericSchema<Options[Name], unknown>;
};

export const within = (min: number, max: number) => v.pipe(v.number(), v.minValue(min), v.maxValue(max));
export const wholeWithin = (min: number, max: number) => v.pipe(within(min, max), v.integer());

export const sizeOption = (label: string) =>
  option(
    label,
    `a size from ${limitText(MIN_LENGTH)} to ${limitText(MAX_LENGTH)}, in model units`,
    within(MIN_LENGTH, MAX_LENGTH),
    undefined,
  );

export const growthOption = (otherwise: number) =>
  option(
    "growth",
    `a growth from 0 to ${LIMITS.growth}, for example ${MESH_DEFAULTS.growth}, or Infinity for no limit`,
    v.union([within(0, LIMITS.growth), v.literal(Infinity)]),
    otherwise,
  );

export function choiceOption<const Choice extends string>(
  label: string,
  choices: readonly Choice[],
  otherwise: NoInfer<Choice>,
) {
  return option(label, `one of ${choices.join(", ")}`, v.picklist(choices), otherwise);
}

export const switchOption = (label: string, otherwise: boolean) =>
  option(label, "true or false", v.boolean(), otherwise);

export const distanceOption = (label: string) =>
  option(
    label,
    `a distance from ${limitText(MIN_LENGTH)} to ${limitText(MAX_LENGTH)}, in model units`,
    within(MIN_LENGTH, MAX_LENGTH),
    undefined,
  );

export const angleOption = (label: string, otherwise: number | undefined) =>
  option(
    label,
    `an angle from ${MIN_REMESH_ANGLE} to ${MAX_REMESH_ANGLE} degrees`,
    within(MIN_REMESH_ANGLE, MAX_REMESH_ANGLE),
    otherwise,
  );

/** Options that several calls have. */
export const shared = {
  size: sizeOption("element size"),
  minSize: sizeOption("smallest size"),
  maxSize: sizeOption("largest size"),
  maxVolume: option(
    "largest volume of a tetrahedron",
    "a volume above 0, in cubed model units",
    v.pipe(v.number(), v.gtValue(0), v.finite()),
    undefined,
  ),
  innerShells: choiceOption("meaning of inner shells", INNER_SHELLS, MESH_DEFAULTS.innerShells),
  /** Checked together with the size by `checkWithBackground`. */
  background: v.optional(v.custom<BackgroundArrays>(() => true)),
};

export const INNER_SHELL_NUMBERS = numbersOf(INNER_SHELLS);
export const finiteGrowth = (growth: number): number => Math.min(LIMITS.growth, growth);
type SizeOptions = Pick<MeshOptions, "size" | "background">;

export function checkWithBackground(
  options: SizeOptions,
  schema: OptionsSchema,
  others: readonly string[] = [],
): Diagnostic[] {
  const wrong = checkAgainst(options, schema, others);
  const { size, background } = asObject(options) as typeof options;
  if (background === undefined) return wrong;
  if (size !== undefined && !hasSourcesOnly(background)) {
    const message = "both an element size and a background grid are given";
    wrong.push(invalidOption("background", message, "Pass one of them: a size, or a background grid."));
  }
  return [...wrong, ...checkBackground(background)];
}

type OptionsSchema = v.StrictObjectSchema<v.ObjectEntries, undefined>;

/** Returns one diagnostic per invalid option; for unknown options, one for the first. */
export function checkAgainst(
  options: unknown,
  schema: OptionsSchema,
  others: readonly string[] = [],
): Diagnostic[] {
  const parsed = v.safeParse(schema, options, { abortPipeEarly: true });
  if (parsed.success) return [];
  return parsed.issues.map(({ path, input, expected }) => {
    const name = path?.[0].key;
    if (typeof name !== "string") {
      return invalidOption("options", `the options are ${shown(input)}`, "Pass an object, or omit them.");
    }
    const known = Object.keys(schema.entries);
    if (expected === "never" && !known.includes(name)) {
      const remedy = `Correct its name: the options are ${[...known, ...others].join(", ")}.`;
      return invalidOption(name, `there is no option "${name}"`, remedy);
    }
    const { label, expected: permitted } = wordsOf(schema.entries[name], name);
    return invalidOption(name, `the ${label} is ${shown(input)}`, `Use ${permitted}.`);
  });
}

function wordsOf(schema: v.GenericSchema | undefined, name: string): OptionWords {
  const own = schema !== undefined && "wrapped" in schema ? (schema.wrapped as v.GenericSchema) : undefined;
  const { words } = (own === undefined ? {} : v.getMetadata(own)) as { readonly words?: OptionWords };
  return words ?? { label: name, expected: "another value" };
}
