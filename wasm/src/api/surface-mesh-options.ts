/** The options of `meshSurface`: their check, and their division into those of the calls that it makes. */
import { shown } from "../base/values.js";
import type { Diagnostic } from "../diagnostics/diagnostic.js";
import { invalidOption } from "../diagnostics/package-diagnostic.js";
import { SURFACE_TREATMENTS } from "./option-types.js";
import { checkOptions, checkOrder, excludedSize } from "./mesh-options.js";
import { checkRemeshOptions, checkRepairOptions, checkSplitOptions } from "./surface-options.js";
import type {
  MeshOptions,
  OrderOptions,
  ProjectMeshOptions,
  RemeshSettings,
  RepairOptions,
  SplitOptions,
  SurfaceMeshOptions,
} from "./option-types.js";

const SETTINGS = [
  "minSize",
  "maxSize",
  "tolerance",
  "featureAngle",
  "anglePerEdge",
  "layers",
  "dropDetails",
] as const satisfies (keyof RemeshSettings)[];

/** Options of what is done to a surface before `fillSurface`. */
const BEFORE_FILLING: ReadonlySet<string> = new Set<
  Exclude<keyof SurfaceMeshOptions, keyof MeshOptions | keyof OrderOptions>
>([...SETTINGS, "surface", "repair", "weld", "fillHoles", "splitPatches"]);

/** Options that neither `fillSurface` nor a preparation of the surface has. */
const AFTER_FILLING: ReadonlySet<string> = new Set<keyof OrderOptions>(["elementOrder"]);

/** Returns the options of the mesh itself, among them unknown ones. */
export function meshPart(options: SurfaceMeshOptions): MeshOptions {
  // Anything else is for the check.
  if (typeof options !== "object" || (options as unknown) === null) return options;
  const own = Object.entries(options).filter(
    ([name]) => !BEFORE_FILLING.has(name) && !AFTER_FILLING.has(name),
  );
  return Object.fromEntries(own);
}

/** Returns the options of a project, among them unknown ones. */
export function projectPart(options: SurfaceMeshOptions): ProjectMeshOptions {
  return { ...meshPart(options), elementOrder: options.elementOrder };
}

/** Returns the options of a remeshing that the mesh does not have. */
export function remeshSettings(options: SurfaceMeshOptions): RemeshSettings {
  return Object.fromEntries(SETTINGS.map((name) => [name, options[name]]));
}

/** Returns the options of the repair that is asked for; undefined without one. */
export function repairPart({
  repair = false,
  weld,
  fillHoles,
  innerShells,
}: SurfaceMeshOptions): RepairOptions | undefined {
  if (!repair && weld === undefined && fillHoles === undefined) return undefined;
  return { ...(weld !== undefined && { weld }), ...(fillHoles !== undefined && { fillHoles }), innerShells };
}

/** Returns the options of the split that is asked for; undefined without one. */
export function splitPart({ splitPatches = false }: SurfaceMeshOptions): SplitOptions | undefined {
  if (splitPatches === false) return undefined;
  return splitPatches === true ? {} : { angle: splitPatches };
}

/** Returns the first option of a remeshing that is given; undefined without one. */
export function givenRemeshSetting(options: SurfaceMeshOptions): keyof RemeshSettings | undefined {
  return SETTINGS.find((name) => options[name] !== undefined);
}

/** Returns a diagnostic per invalid option. */
export function checkSurfaceMeshOptions(options: SurfaceMeshOptions): Diagnostic[] {
  const wrong = checkOptions(meshPart(options), [...BEFORE_FILLING, ...AFTER_FILLING]);
  if (wrong.length > 0) return wrong;
  const repair = repairPart(options);
  const split = splitPart(options);
  const { size, growth, maxVolume, innerShells, background, surface = "auto" } = options;
  const setting = givenRemeshSetting(options);
  const limits = (["minSize", "maxSize"] as const).filter((name) => options[name] !== undefined);
  if (options.elements !== undefined && limits.length > 0) return limits.map(excludedSize);
  return [
    ...wrongSwitches(options),
    ...checkOrder(options),
    ...checkRemeshOptions({ ...remeshSettings(options), size, growth, maxVolume, innerShells, background }),
    ...(repair === undefined ? [] : checkRepairOptions(repair)),
    ...(split === undefined ? [] : checkSplitOptions(split)),
    ...(SURFACE_TREATMENTS.includes(surface) ? [] : [unknownTreatment(surface)]),
    ...(setting !== undefined && (surface === "keep" || surface === "refine")
      ? [withoutRemeshing(setting)]
      : []),
  ];
}

function wrongSwitches({ repair = false, splitPatches = false }: SurfaceMeshOptions): Diagnostic[] {
  const wrongRepair = typeof repair !== "boolean";
  const wrongSplit = typeof splitPatches !== "boolean" && typeof splitPatches !== "number";
  return [
    ...(wrongRepair ? [invalidOption("repair", `the repair is ${shown(repair)}`, "Use true or false.")] : []),
    ...(wrongSplit
      ? [
          invalidOption(
            "splitPatches",
            `the angle between patches is ${shown(splitPatches)}`,
            "Use true, false or an angle in degrees.",
          ),
        ]
      : []),
  ];
}

function unknownTreatment(surface: unknown): Diagnostic {
  const remedy = `Use one of ${SURFACE_TREATMENTS.join(", ")}.`;
  return invalidOption("surface", `the treatment of the surface is ${shown(surface)}`, remedy);
}

function withoutRemeshing(setting: string): Diagnostic {
  const message = `\`${setting}\` is for surfaces that are remeshed`;
  return invalidOption(setting, message, `Use \`surface: "remesh"\`, or omit \`${setting}\`.`);
}

/** Returns the first option given that is for surfaces only; undefined without one. */
export function surfaceOption(options: SurfaceMeshOptions): string | undefined {
  return Object.entries(options).find(
    ([name, value]) => BEFORE_FILLING.has(name) && value !== undefined,
  )?.[0];
}
