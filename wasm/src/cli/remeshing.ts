/** Options of a remeshing on the command line, and what is printed about its result. */
import type { MeshOptions, RemeshOptions, RemeshSettings } from "../api/option-types.js";
import { checkRemeshOptions } from "../api/surface-options.js";
import { givenRemeshSetting } from "../api/surface-mesh-options.js";
import { invalidOption } from "../diagnostics/package-diagnostic.js";
import { numberIn, refuseOptions } from "./input.js";

/** Options of a remeshing as commander passes them, without those of the sizes. */
export interface RemeshCommandOptions {
  readonly minSize?: string;
  readonly maxSize?: string;
  readonly tolerance?: string;
  readonly featureAngle?: string;
  readonly anglePerEdge?: string;
  readonly layers?: string;
  readonly dropDetails?: string;
}

/** Returns the options of a remeshing beside its sizes, unchecked. */
export function remeshSettingsIn(given: RemeshCommandOptions): RemeshSettings {
  return {
    minSize: numberIn(given.minSize),
    maxSize: numberIn(given.maxSize),
    tolerance: numberIn(given.tolerance),
    featureAngle: numberIn(given.featureAngle),
    anglePerEdge: numberIn(given.anglePerEdge),
    layers: numberIn(given.layers),
    dropDetails: numberIn(given.dropDetails),
  };
}

/** Returns the options of a remeshing with these sizes. Throws an InvalidInput if one is invalid. */
export function remeshOptions(
  given: RemeshCommandOptions,
  { size, growth, maxVolume, innerShells, background }: MeshOptions,
): RemeshOptions {
  const sizes = { size, growth, maxVolume, innerShells, background };
  const options: RemeshOptions = { ...sizes, ...remeshSettingsIn(given) };
  refuseOptions(checkRemeshOptions(options));
  return options;
}

/** Throws an InvalidInput if an option of a remeshing is given for a project. */
export function refuseRemeshing(given: RemeshSettings): void {
  const setting = givenRemeshSetting(given);
  if (setting === undefined) return;
  const message = `\`${setting}\` is for surfaces, but the input is a project`;
  refuseOptions([invalidOption(setting, message, "Omit it: each body has a remeshing of its own.")]);
}
