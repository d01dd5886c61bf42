/** `tetrafront adapt --layers`: layers of stretched elements along patches. */
import { checkLayerOptions, checkLayers } from "../api/layers.js";
import type { LayerOptions } from "../api/option-types.js";
import { InvalidInput } from "./messages.js";
import { packageDiagnostic, invalidOption } from "../diagnostics/package-diagnostic.js";
import type { LayeredMesh, PatchLayers } from "../mesh/layered-mesh.js";
import type { Mesh } from "../mesh/mesh.js";
import { numberIn, refuseOptions } from "./numbers.js";

/** Stands for all patches that are not named. */
const ALL = "*";

/** Returns the layers in texts such as "wall:0.001:1.2:10". The name of a patch may contain colons. Throws an InvalidInput. */
export function layersIn(texts: readonly string[]): PatchLayers[] {
  const layers = texts.map((text) => {
    const [count, growth, firstHeight, ...patch] = text.split(":").reverse();
    if (patch.length === 0) {
      const remedy = "Use PATCH:FIRST:GROWTH:COUNT, for example wall:0.001:1.2:10.";
      refuseOptions([invalidOption("--layers", `${text} does not describe layers`, remedy)]);
    }
    return {
      patch: patch.reverse().join(":"),
      firstHeight: numberIn(firstHeight) ?? 0,
      growth: numberIn(growth),
      count: numberIn(count),
    };
  });
  refuseOptions(layers.flatMap(checkWords));
  refuseOptions(checkLayers(layers));
  return layers;
}

/** Options as commander passes them. */
interface LimitOptions {
  readonly cycles?: string;
  readonly maxAspect?: string;
  readonly gradation?: string;
}

/** Returns the limits of sizes and work. Throws an InvalidInput. */
export function layerLimitsIn({ cycles, maxAspect, gradation }: LimitOptions): LayerOptions {
  const ratio = numberIn(gradation);
  const growth = ratio === undefined ? undefined : ratio - 1;
  if (checkLayerOptions({ growth }).length > 0) {
    const remedy = "Use a ratio from 1.01 to 11 with --layers.";
    refuseOptions([invalidOption("--gradation", `the gradation is ${gradation ?? ""}`, remedy)]);
  }
  const limits = { cycles: numberIn(cycles), maxAspect: numberIn(maxAspect) };
  refuseOptions(checkLayerOptions(limits));
  return { ...limits, growth };
}

/** A word that is not a number is still a text here. */
function checkWords({ patch, firstHeight, growth, count }: PatchLayers) {
  const numbers = { "first height": firstHeight, growth, number: count };
  return Object.entries(numbers)
    .filter(([, value]) => typeof value !== "number")
    .map(([word, value]) =>
      invalidOption(
        "--layers",
        `the ${word} of the layers of ${patch} is "${String(value)}", not a number`,
        "Use decimal numbers.",
      ),
    );
}

/** Replaces `*` by all patches of the mesh that are not named. Throws an InvalidInput if a named one is missing. */
export function layersOf(input: string, { patches }: Mesh, layers: readonly PatchLayers[]): PatchLayers[] {
  const names = [...new Set(patches.map(({ name }) => name))];
  const unknown = layers.filter(({ patch }) => patch !== ALL && !names.includes(patch));
  if (unknown.length > 0) {
    const known =
      names.length === 0
        ? "The model has no patches."
        : `Use one of: ${names.join(", ")}, or ${ALL} for all.`;
    throw new InvalidInput(
      input,
      unknown.map(({ patch }) => packageDiagnostic("invalid-argument", `there is no patch ${patch}`, known)),
    );
  }
  const named = new Set(layers.map(({ patch }) => patch));
  return layers.flatMap((own) =>
    own.patch === ALL
      ? names.filter((name) => !named.has(name)).map((name) => ({ ...own, patch: name }))
      : [own],
  );
}

/** Returns what the command prints about layers. */
export function layersText({ layers, cycles, largestAspect }: LayeredMesh): string {
  const heights = layers.map(
    ({ patch, meanFirstHeight, thickness }) =>
      `${patch}: first height ${meanFirstHeight.toPrecision(3)}, thickness ${thickness.toPrecision(3)}`,
  );
  return [...heights, `cycles ${cycles}`, `largest aspect ${largestAspect.toFixed(0)}`].join("; ");
}
