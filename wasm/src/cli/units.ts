/** `--scale`, `--units` and `--file-units`: lengths of the input. */
import { type Command, Option } from "commander";
import { limitText } from "../base/limits.js";
import { invalidOption } from "../diagnostics/package-diagnostic.js";
import { MAX_LENGTH, MIN_LENGTH } from "../generated/constants.js";
import type { LengthOptions } from "../formats/units.js";
import { type LengthUnit, LENGTH_UNITS } from "../mesh/units.js";
import { numberIn, refuseOptions } from "./numbers.js";

/** Options as commander passes them: numbers are still text. */
export interface UnitOptions {
  readonly scale?: string;
  readonly units?: LengthUnit;
  readonly fileUnits?: LengthUnit;
}

export const withUnits = (command: Command): Command =>
  command
    .option("--scale <factor>", "multiply all coordinates of the input (default 1)")
    .addOption(
      new Option("--units <unit>", "convert the input to this unit; other lengths are in it too").choices(
        LENGTH_UNITS,
      ),
    )
    .addOption(
      new Option("--file-units <unit>", "unit of an input whose format does not define one").choices(
        LENGTH_UNITS,
      ),
    );

/** Returns the options of reading. Throws an InvalidInput if the scale is invalid. */
export function lengthOptions({ scale: text, units, fileUnits }: UnitOptions): LengthOptions {
  const scale = numberIn(text);
  if (scale !== undefined && !(scale >= MIN_LENGTH && scale <= MAX_LENGTH)) {
    const remedy = `Use a number from ${limitText(MIN_LENGTH)} to ${limitText(MAX_LENGTH)}.`;
    refuseOptions([invalidOption("--scale", `the scale is "${text}"`, remedy)]);
  }
  return { scale, units, fileUnits };
}

/** Throws an InvalidInput if such an option is given for a project. */
export function refuseUnits(options: UnitOptions): void {
  const given = (["scale", "units", "fileUnits"] as const).find((name) => options[name] !== undefined);
  if (given === undefined) return;
  const option = given === "fileUnits" ? "--file-units" : `--${given}`;
  const message = `${option} is for surfaces and meshes, but the input is a project`;
  refuseOptions([invalidOption(option, message, "Omit it; the placement of a body has a scale.")]);
}
