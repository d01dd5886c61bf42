/** Adds layers of stretched elements along patches of a mesh. */
import * as v from "valibot";
import { objectWith } from "../calls/schemas.js";
import { describeAll } from "../diagnostics/describe.js";
import type { Diagnostic } from "../diagnostics/diagnostic.js";
import { nameByIndex } from "../diagnostics/entity-names.js";
import { refuse } from "../diagnostics/mesher-error.js";
import { invalidArrays, invalidOption } from "../diagnostics/package-diagnostic.js";
import type { PartialControl } from "../engine/control.js";
import type { EngineClient } from "../engine/engine-client.js";
import {
  ADAPT_DEFAULTS,
  LAYER_DEFAULTS,
  MAX_LENGTH,
  MIN_LENGTH,
  PATCH_LAYERS_DEFAULTS,
} from "../generated/constants.js";
import type { LayeredMesh, PatchLayers } from "../mesh/layered-mesh.js";
import type { VolumeInput } from "../mesh/mesh.js";
import { adaptBackgroundOf, adaptInputOf, adaptScaleOf, describedAdaptation } from "./adaptation.js";
import { beginCall } from "./call-checks.js";
import { patchesIn } from "./carried-mesh.js";
import { checkArrays, checkImproveInput, checkMesh, unreadableMesh } from "./input-checks.js";
import { adaptEntries } from "./mesh-options.js";
import { checkAgainst, type EntriesOf, option, wholeWithin, within } from "./option-schema.js";
import type { LayerOptions } from "./option-types.js";
import { MAX_ASPECT } from "./solution-options.js";

const MAX_GROWTH = 10;
const MAX_COUNT = 1000;

const layersSchema = objectWith({
  ...adaptEntries,
  background: v.optional(
    v.custom<VolumeInput>((value) => typeof value === "object" && value !== null, "a mesh"),
  ),
  maxAspect: option(
    "largest aspect",
    `a ratio from 1 to ${MAX_ASPECT}`,
    within(1, MAX_ASPECT),
    LAYER_DEFAULTS.maxAspect,
  ),
  growth: option("growth", "a number from 0.01 to 10", within(0.01, MAX_GROWTH), LAYER_DEFAULTS.growth),
  cycles: option(
    "number of cycles",
    "a whole number from 1 to 100",
    wholeWithin(1, 100),
    LAYER_DEFAULTS.cycles,
  ),
} satisfies EntriesOf<LayerOptions>);

const listSchema = v.array(
  v.object({
    patch: v.string(),
    firstHeight: v.number(),
    growth: v.optional(v.number()),
    count: v.optional(v.number()),
  }),
);

export function checkLayerOptions(options: LayerOptions): Diagnostic[] {
  return checkAgainst(options, layersSchema);
}

/** Checks the layers without a mesh. */
export function checkLayers(layers: readonly PatchLayers[]): Diagnostic[] {
  const remedy = "Pass `patch`, `firstHeight`, and optionally `growth` and `count`, for each patch.";
  const wrong = checkArrays("layers", layers, listSchema, remedy);
  if (wrong.length > 0) return wrong;
  if (layers.length === 0) return [invalidArrays("no patch gets layers", remedy)];
  return layers.flatMap(checkPatchLayers);
}

function checkPatchLayers({ patch, firstHeight, growth = 1, count = 1 }: PatchLayers): Diagnostic[] {
  const limits = [
    [
      firstHeight >= MIN_LENGTH && firstHeight <= MAX_LENGTH,
      "first height",
      firstHeight,
      `a height from ${MIN_LENGTH} to ${MAX_LENGTH}`,
    ],
    [growth >= 1 && growth <= MAX_GROWTH, "growth", growth, `a ratio from 1 to ${MAX_GROWTH}`],
    [
      Number.isInteger(count) && count >= 1 && count <= MAX_COUNT,
      "number",
      count,
      `a whole number from 1 to ${MAX_COUNT}`,
    ],
    [
      count > MAX_COUNT || firstHeight * growth ** count <= MAX_LENGTH,
      "last height",
      firstHeight * growth ** (count - 1),
      "fewer layers or a smaller growth",
    ],
  ] as const;
  return limits
    .filter(([isValid]) => !isValid)
    .map(([, word, value, expected]) =>
      invalidOption("layers", `the ${word} of the layers of ${patch} is ${value}`, `Use ${expected}.`),
    );
}

/** A patch that gets layers. */
interface Wall {
  readonly index: number;
  readonly layers: PatchLayers;
}

/** Throws a `MesherError` if a mesh has not all patches of the layers, or a name comes twice. */
export function requirePatches(mesh: VolumeInput, layers: readonly PatchLayers[]): void {
  wallsOf(mesh, layers);
}

/** Returns all patches with the names of the layers. Throws a `MesherError` if there is none with a name, or a name comes twice. */
function wallsOf(mesh: VolumeInput, layers: readonly PatchLayers[]): Wall[] {
  const { triangles = new Uint32Array(), trianglePatch } = mesh;
  const { patches } = patchesIn({ triangles, trianglePatch, patches: mesh.patches ?? [] });
  const names = patches.map(({ name }) => name);
  const wrong = layers.flatMap(({ patch }, i) => {
    if (!names.includes(patch)) {
      const known = [...new Set(names)].join(", ");
      const remedy = known === "" ? "Pass triangles with patches." : `Use one of: ${known}.`;
      return [invalidOption("layers", `there is no patch ${patch}`, remedy)];
    }
    if (layers.findIndex((other) => other.patch === patch) === i) return [];
    return [invalidOption("layers", `the patch ${patch} gets layers twice`, "Name each patch once.")];
  });
  refuse(wrong);
  return layers.flatMap((own) =>
    names.flatMap((name, index) => (name === own.patch ? [{ index, layers: own }] : [])),
  );
}

export async function addLayers(
  client: EngineClient,
  { mesh, layers }: { readonly mesh: VolumeInput; readonly layers: readonly PatchLayers[] },
  options: LayerOptions,
  control: PartialControl,
): Promise<LayeredMesh> {
  beginCall(client, control);
  refuse([...checkImproveInput(mesh), ...checkLayers(layers), ...checkLayerOptions(options)]);
  const { background } = options;
  if (background !== undefined) refuse(checkMesh(background, "background"));
  const walls = wallsOf(mesh, layers);
  const { leastQuality = ADAPT_DEFAULTS.leastQuality, sweeps = ADAPT_DEFAULTS.sweeps } = options;
  const { maxAspect = LAYER_DEFAULTS.maxAspect, growth = LAYER_DEFAULTS.growth } = options;
  const scale = adaptScaleOf(mesh);
  const given = [
    adaptInputOf(mesh),
    adaptBackgroundOf(background, mesh),
    { leastQuality, sweeps },
    {
      patch: Uint32Array.from(walls, ({ index }) => index),
      firstHeight: Float64Array.from(walls, (wall) => wall.layers.firstHeight / scale),
      growth: Float64Array.from(walls, (wall) => wall.layers.growth ?? PATCH_LAYERS_DEFAULTS.growth),
      count: Uint32Array.from(walls, (wall) => wall.layers.count ?? PATCH_LAYERS_DEFAULTS.count),
    },
    { maxAspect, growth, cycles: options.cycles ?? LAYER_DEFAULTS.cycles },
  ] as const;
  const found = await client.ask("addLayers", given, control);
  if (!found.adaptation.isReadable) refuse([unreadableMesh()]);
  refuse(describeAll(found.adaptation.diagnostics, nameByIndex));
  const made = found.walls.map(({ triangles, meanFirstHeight, thickness }, i) => ({
    patch: walls[i]?.layers.patch ?? "",
    triangles,
    meanFirstHeight: meanFirstHeight * scale,
    thickness: thickness * scale,
  }));
  return {
    ...describedAdaptation(found.adaptation, mesh),
    layers: made,
    diagnostics: made.filter(({ triangles }) => triangles === 0).map(({ patch }) => noLayers(patch)),
    cycles: found.cycles,
    largestAspect: found.largestAspect,
  };
}

function noLayers(patch: string): Diagnostic {
  const message = `the patch ${patch} has no triangle on the boundary, so it gets no layers`;
  return { ...invalidOption("layers", message, "Name patches of the boundary."), severity: "warning" };
}
