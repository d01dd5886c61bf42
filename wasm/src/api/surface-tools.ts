/** Calls about a given surface: inspection, repair, refinement, remeshing and patches by angle. */
import { inSteps, pauseAfterCopy } from "../calls/yielder.js";
import type { Diagnostic } from "../diagnostics/diagnostic.js";
import type { EntityNamer } from "../diagnostics/entity-names.js";
import { refuse } from "../diagnostics/mesher-error.js";
import type { PartialControl, RunControl } from "../engine/control.js";
import type { EngineClient } from "../engine/engine-client.js";
import type {
  SurfaceInspection,
  SurfaceRefinement,
  SurfaceRemesh,
  SurfaceRepair,
} from "../mesh/inspection.js";
import type { SurfaceInput } from "../mesh/mesh.js";
import { resolutionWarnings } from "../mesh/resolution-warnings.js";
import { thinBodyNotes } from "./thin-bodies.js";
import { volumeWarnings } from "./volume-warnings.js";
import { emptyGrid, withNodes } from "../project/grid-arrays.js";
import { afterPause, beginCall } from "./call-checks.js";
import { checkLocatedSurface, checkSurface, checkWeld, withInnerShells } from "./input-checks.js";
import {
  changeDiagnostics,
  deviationWarnings,
  describedInspection,
  describedRefinement,
  describedRemesh,
  describedRepair,
} from "./inspection.js";
import type { PatchSplit } from "./mesher-interface.js";
import type {
  InspectionOptions,
  RefineOptions,
  RemeshOptions,
  RepairOptions,
  SplitOptions,
} from "./option-types.js";
import { checkRefineOptions, engineOptions } from "./mesh-options.js";
import {
  angleOfSplit,
  checkInspectionOptions,
  checkRemeshOptions,
  checkRepairOptions,
  checkSplitOptions,
  engineInspectionOptions,
  engineRemeshOptions,
  engineRepairOptions,
} from "./surface-options.js";
import type { BackgroundArrays } from "../project/background-arrays.js";
import { modelNumbers, onTrueFaces } from "./true-faces.js";
import { completeSurface } from "./carried-mesh.js";
import { splitSurface } from "./patch-names.js";
import { meshedRegionsOf, surfaceNamer, triangleRegionsOf } from "./surface-numbers.js";

/** The remedies for a surface that cannot be filled; the second one alone helps a remeshing. */
const REMESH_OR_REPAIR = /`surface: "remesh"`, or a repair \(`repair: true` or `repairSurface\(\)`\),? /;

/** Returns a diagnostic whose remedy does not advise the call that refuses the surface. */
function withRepairOnly(found: Diagnostic): Diagnostic {
  return { ...found, remedy: found.remedy.replace(REMESH_OR_REPAIR, "`repairSurface()` ") };
}

/** Returns the errors, with the warning that may explain them; nothing without errors. */
function withCause(found: readonly Diagnostic[], coarse: readonly Diagnostic[]): Diagnostic[] {
  const errors = found.filter(({ severity }) => severity === "error");
  return errors.length === 0 ? [] : [...errors, ...coarse];
}

/**
 * Calls of a mesher about surfaces. Diagnostics name triangles by their indices in the surface's origin, unless another
 * namer is given.
 */
/** Returns copies of the arrays of a surface; its caller may change them while the worker has them. */
function copied({ points, triangles, trianglePatch = new Uint32Array() }: SurfaceInput) {
  return { points: points.slice(), triangles: triangles.slice(), groups: trianglePatch.slice() };
}

const gridOf = (background: BackgroundArrays | undefined) =>
  background === undefined ? emptyGrid() : withNodes(emptyGrid(), background);

export class SurfaceTools {
  readonly #client: EngineClient;

  constructor(client: EngineClient) {
    this.#client = client;
  }

  async inspect(
    surface: SurfaceInput,
    options: InspectionOptions,
    control: RunControl,
    name?: EntityNamer,
  ): Promise<SurfaceInspection> {
    beginCall(this.#client, control);
    refuse([...checkSurface(surface), ...checkInspectionOptions(options)]);
    const { points, triangles } = copied(surface);
    const pause = pauseAfterCopy(points, triangles);
    if (pause) await afterPause(this.#client, pause, control);
    const given = [points, triangles, engineInspectionOptions(options), triangleRegionsOf(surface)] as const;
    const found = await this.#client.ask("inspectSurface", given, control);
    return inSteps(describedInspection(found, surface, name ?? surfaceNamer(surface)), control.signal);
  }

  async repair(surface: SurfaceInput, options: RepairOptions, control: RunControl): Promise<SurfaceRepair> {
    beginCall(this.#client, control);
    refuse([...checkSurface(surface), ...checkRepairOptions(options)]);
    refuse(checkWeld(surface, options.weld));
    const { points, triangles } = copied(surface);
    const given = [points, triangles, engineRepairOptions(options), triangleRegionsOf(surface)] as const;
    const repair = await this.#client.ask("repairSurface", given, control);
    const found = changeDiagnostics(repair, surfaceNamer(surface));
    const coarse = await inSteps(resolutionWarnings(surface), control.signal);
    refuse(withCause(found, coarse));
    return describedRepair(repair, surface, [...found, ...coarse]);
  }

  async refine(
    surface: SurfaceInput,
    options: RefineOptions,
    control: RunControl,
    name?: EntityNamer,
  ): Promise<SurfaceRefinement> {
    beginCall(this.#client, control);
    refuse([...checkSurface(surface), ...checkRefineOptions(options)]);
    const { volume = 0, ...withoutVolume } = options;
    const { points, triangles } = copied(surface);
    const grid = gridOf(withoutVolume.background);
    const regions = meshedRegionsOf(surface);
    const given = [points, triangles, grid, engineOptions(withoutVolume), volume, regions] as const;
    const refinement = await this.#client.ask("refineSurface", given, control);
    refuse(changeDiagnostics(refinement, name));
    return describedRefinement(refinement, surface);
  }

  async remesh(
    surface: SurfaceInput,
    options: RemeshOptions,
    control: PartialControl,
    name?: EntityNamer,
  ): Promise<SurfaceRemesh> {
    beginCall(this.#client, control);
    refuse([...checkSurface(surface), ...checkRemeshOptions(options)]);
    refuse(checkLocatedSurface(surface));
    const { points, triangles, groups } = copied(surface);
    const pause = pauseAfterCopy(points, triangles, groups);
    // A partial call that is stopped early still returns a surface.
    if (pause) await afterPause(this.#client, pause, control.partial === true ? {} : control);
    const settings = engineRemeshOptions(withInnerShells(surface, options));
    const regions = meshedRegionsOf(surface);
    const grid = gridOf(options.background);
    const given = [points, triangles, groups, grid, settings, regions, modelNumbers(surface)] as const;
    const remesh = await this.#client.ask("remeshSurface", given, control);
    const found = changeDiagnostics(remesh, name ?? surfaceNamer(surface)).map(withRepairOnly);
    const coarse = await inSteps(resolutionWarnings(surface), control.signal);
    refuse(withCause(found, coarse));
    const described = describedRemesh(remesh, surface, [...found, ...coarse]);
    const placed = await onTrueFaces(this.#client, described.mesh, described.deviation, control);
    const changed = placed && {
      mesh: placed.mesh,
      placement: placed.placement,
      volume: described.volume + placed.volumeChange,
      // Dropped details are farther away.
      ...(described.onFaces && described.mergedDetails.length === 0 && { deviation: placed.bend }),
    };
    const whole = { ...described, ...changed };
    const made = {
      ...whole,
      diagnostics: [
        ...whole.diagnostics,
        ...deviationWarnings(whole, options.tolerance !== undefined),
        ...volumeWarnings(whole),
      ],
    };
    const thin = await inSteps(thinBodyNotes(made, options));
    return thin.length === 0 ? made : { ...made, diagnostics: [...made.diagnostics, ...thin] };
  }

  /**
   * Refuses a surface with single triangles that face inward, as `fillSurface` does. Returns notes about components that
   * were given inside out.
   */
  async checkOrientation(
    surface: SurfaceInput,
    options: InspectionOptions,
    { signal }: RunControl,
    name?: EntityNamer,
  ): Promise<Diagnostic[]> {
    const { diagnostics } = await this.inspect(surface, options, { signal }, name);
    refuse(diagnostics.filter(({ code }) => code === "flipped-triangle"));
    return diagnostics.filter(({ code }) => code === "reoriented-patch");
  }

  async split(surface: SurfaceInput, options: SplitOptions, control: RunControl): Promise<PatchSplit> {
    beginCall(this.#client, control);
    refuse([...checkSurface(surface), ...checkSplitOptions(options)]);
    const { points, triangles, groups } = copied(surface);
    const given = [points, triangles, groups, angleOfSplit(options)] as const;
    const { patches } = options;
    const pieces = await this.#client.ask("splitPatches", given, control);
    refuse(changeDiagnostics(pieces, surfaceNamer(surface)));
    const split = splitSurface(pieces, surface.patches ?? [], patches);
    return { mesh: { ...completeSurface(surface), ...split } };
  }
}
