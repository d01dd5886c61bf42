/** Repairs that the command line was asked for, and the list of what they changed. */
import { numberIn, refuseOptions } from "./input.js";
import { say } from "./messages.js";
import { placeText } from "./tables.js";
import type { SurfaceFile } from "../formats/surface-file.js";
import type { RepairChange, RepairOptions } from "../api/inspection.js";
import { checkRepairOptions } from "../api/options.js";
import { invalidOption } from "../diagnostics/package-diagnostic.js";
import { plural } from "../base/plural.js";
import { repairedSurface } from "../api/repaired-surface.js";
import type { InnerShells, Mesher } from "../api/types.js";

/** As commander hands them over. */
export interface RepairCommandOptions {
  readonly repair?: boolean;
  readonly weld?: string;
  readonly fillHoles?: string;
  readonly enclosed?: InnerShells;
}

export interface RepairedSurface {
  readonly surface: SurfaceFile;
  /** Undefined where no repair was asked for. */
  readonly changes?: readonly RepairChange[];
}

/** The options of a repair, undefined where none is asked for. Throws a BadInput. */
export function repairOptions(given: RepairCommandOptions): RepairOptions | undefined {
  const { repair = false, weld, fillHoles, enclosed } = given;
  if (!repair && weld === undefined && fillHoles === undefined) return undefined;
  const options: RepairOptions = {
    ...(weld === undefined ? {} : { weld: numberIn(weld) }),
    ...(fillHoles === undefined ? {} : { fillHoles: numberIn(fillHoles) }),
    innerShells: enclosed,
  };
  refuseOptions(checkRepairOptions(options));
  return options;
}

/** Throws a BadInput where repairs are asked for of what is no surface. */
export function refuseRepair(options: RepairOptions | undefined, what: string): void {
  if (options === undefined) return;
  const message = `repairs are for surfaces, and this is ${what}`;
  const remedy = "Leave --repair, --weld and --fill-holes out.";
  refuseOptions([invalidOption("--repair", message, remedy)]);
}

export async function repaired(
  mesher: Mesher,
  given: SurfaceFile,
  options: RepairOptions | undefined,
): Promise<RepairedSurface> {
  if (options === undefined) return { surface: given };
  const repair = await mesher.repairSurface(given, options);
  return { surface: repairedSurface(given, repair), changes: repair.changes };
}

/** Of one kind no more than these; `--json` and `--report` have all. */
const TOLD_PER_KIND = 20;

/** One line per change, and one for each kind of which there are more. */
export function tellChanges(input: string, changes: readonly RepairChange[]): void {
  if (changes.length === 0) return say(`repair: ${input}: nothing to change.`);
  const kinds = new Map<RepairChange["kind"], RepairChange[]>();
  for (const change of changes) {
    const known = kinds.get(change.kind);
    if (known === undefined) kinds.set(change.kind, [change]);
    else known.push(change);
  }
  for (const [kind, all] of kinds) {
    for (const change of all.slice(0, TOLD_PER_KIND)) say(`repair: ${input}: ${sentenceOf(change)}.`);
    const rest = all.length - TOLD_PER_KIND;
    if (rest > 0) say(`repair: ${input}: and ${rest} more of the kind "${kind}".`);
  }
}

/** What was changed, with ids and place. */
export function sentenceOf(change: RepairChange): string {
  return `${words()} at ${placeText(change.position)}`;

  function words(): string {
    switch (change.kind) {
      case "welded-node":
        return `node ${change.node} is now node ${change.into}`;
      case "removed-node":
        return `dropped node ${change.node}, which no triangle uses`;
      case "removed-triangle":
        return `removed triangle ${change.triangle}, which has no area`;
      case "removed-duplicate":
        return `removed triangle ${change.triangle}, which has the corners of triangle ${change.sameAs}`;
      case "split-triangle":
        return `split triangle ${change.beyond} in place of triangle ${change.triangle}, which has no area`;
      case "filled-hole":
        return `filled a hole with ${plural(change.triangles, "triangle")} from ${change.firstTriangle} on`;
      case "flipped-triangle":
        return `turned triangle ${change.triangle}`;
    }
  }
}
