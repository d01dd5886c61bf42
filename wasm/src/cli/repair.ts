/** Repairs requested on the command line, and the list of their changes. */
import type { RepairOptions } from "../api/option-types.js";
import { checkRepairOptions } from "../api/options.js";
import type { PreparedSurface } from "../api/surface-preparation.js";
import { repairText } from "../api/treatment-texts.js";
import { plural } from "../base/plural.js";
import { invalidOption } from "../diagnostics/package-diagnostic.js";
import type { InnerShells } from "../generated/constants.js";
import type { RepairChange } from "../mesh/inspection.js";
import { numberIn, refuseOptions } from "./input.js";
import { print } from "./messages.js";
import { positionText } from "./tables.js";

/** Options as commander passes them. */
export interface RepairCommandOptions {
  readonly repair?: boolean;
  readonly weld?: string;
  readonly fillHoles?: string;
  readonly innerShells?: InnerShells;
}

/** Returns the options of a repair, undefined if none is requested. Throws an InvalidInput. */
export function repairOptions(given: RepairCommandOptions): RepairOptions | undefined {
  const { repair = false, weld, fillHoles, innerShells } = given;
  if (!repair && weld === undefined && fillHoles === undefined) return undefined;
  const options: RepairOptions = {
    ...(weld === undefined ? {} : { weld: numberIn(weld) }),
    ...(fillHoles === undefined ? {} : { fillHoles: numberIn(fillHoles) }),
    innerShells,
  };
  refuseOptions(checkRepairOptions(options));
  return options;
}

/** Throws an InvalidInput if a repair is requested for input that is not a surface. */
export function refuseRepair(options: RepairOptions | undefined, what: string): void {
  if (options === undefined) return;
  const message = `repairs are for surfaces, but the input is ${what}`;
  const remedy = "Omit --repair, --weld and --fill-holes.";
  refuseOptions([invalidOption("--repair", message, remedy)]);
}

/** Largest number of lines per kind of change; `--json` and `--report` list all. */
const MAX_PER_KIND = 5;

/** Prints one line per change, one per kind that has more, and the largest distance by which a node was moved. */
export function printChanges(
  input: string,
  { changes, repairDeviation = 0 }: Pick<PreparedSurface, "changes" | "repairDeviation">,
  onLine: (line: string) => void = print,
): void {
  if (changes === undefined) return;
  const kinds = new Map<RepairChange["kind"], RepairChange[]>();
  for (const change of changes) {
    const known = kinds.get(change.kind);
    if (known === undefined) kinds.set(change.kind, [change]);
    else known.push(change);
  }
  for (const [kind, all] of kinds) {
    for (const change of all.slice(0, MAX_PER_KIND)) onLine(`repair: ${input}: ${sentenceOf(change)}.`);
    const rest = all.length - MAX_PER_KIND;
    if (rest > 0) onLine(`repair: ${input}: and ${rest} more "${kind}".`);
  }
  onLine(`repair: ${input}: ${repairText(changes, repairDeviation)}`);
}

/** Describes a change with ids and position. */
export function sentenceOf(change: RepairChange): string {
  return `${words()} at ${positionText(change.position)}`;

  function words(): string {
    switch (change.kind) {
      case "welded-node":
        return `welded node ${change.node} to node ${change.into}`;
      case "removed-node":
        return `removed node ${change.node}, which no triangle uses`;
      case "removed-triangle":
        return `removed triangle ${change.triangle}, which has no area`;
      case "removed-duplicate":
        return `removed triangle ${change.triangle}, a duplicate of triangle ${change.sameAs}`;
      case "split-triangle":
        return `split triangle ${change.beyond} to replace triangle ${change.triangle}, which has no area`;
      case "filled-hole":
        return `filled a hole with ${plural(change.triangles, "triangle")}, from triangle ${change.firstTriangle} on`;
      case "flipped-triangle":
        return `flipped triangle ${change.triangle}`;
      case "resolved-intersection":
        return change.parts === 0
          ? `removed triangle ${change.triangle}, which intersected others and is inside, or encloses nothing`
          : `cut triangle ${change.triangle}, which intersected others; ${plural(change.parts, "part")} of it remain${change.parts === 1 ? "s" : ""}`;
      case "removed-sheet":
        return `removed triangle ${change.triangle}, which enclosed nothing`;
    }
  }
}

export const EXACT_REPAIR =
  "the triangles are better after an exact repair, which welds no nodes; it replaces the changes above";
