/** Repairs requested on the command line, and the list of their changes. */
import { positionText } from "../base/position-text.js";
import type { RepairOptions } from "../api/option-types.js";
import { checkRepairOptions } from "../api/surface-options.js";
import type { PreparedSurface } from "../api/surface-preparation.js";
import { repairText } from "../api/treatment-texts.js";
import { plural } from "../base/plural.js";
import { invalidOption } from "../diagnostics/package-diagnostic.js";
import type { InnerShells } from "../generated/constants.js";
import type { RepairChange } from "../mesh/inspection.js";
import { numberIn, refuseOptions } from "./input.js";
import { print } from "./messages.js";

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

/** Largest number of changes of a kind that are named; `--json` and `--report` list all. */
const EXAMPLES = 3;

/** Prints one line per kind of change, and the largest distance by which a node was moved. */
export function printChanges(
  input: string,
  { changes, repairDeviation = 0 }: Pick<PreparedSurface, "changes" | "repairDeviation">,
  onLine: (line: string) => void = print,
): void {
  if (changes === undefined) return;
  const kinds = new Map<string, RepairChange[]>();
  for (const change of changes) {
    const isRemoval = change.kind === "resolved-intersection" && change.parts === 0;
    const key = isRemoval ? `${change.kind} removal` : change.kind;
    const known = kinds.get(key);
    if (known === undefined) kinds.set(key, [change]);
    else known.push(change);
  }
  for (const alike of kinds.values()) onLine(`repair: ${input}: ${changesText(alike)}.`);
  onLine(`repair: ${input}: ${repairText(changes, repairDeviation)}`);
}

/** Describes changes of one kind: their number, and the first of them with ids and positions. */
export function changesText(alike: readonly RepairChange[]): string {
  const [change] = alike;
  if (change === undefined) return "";
  const examples = alike
    .slice(0, EXAMPLES)
    .map((one) => `${exampleOf(one)} at ${positionText(one.position)}`);
  const rest = alike.length - examples.length;
  return `${summaryOf(change, alike)}: ${examples.join(", ")}${rest > 0 ? ` and ${rest} more` : ""}`;
}

/** Triangles in a hole up to which its lid cannot differ much from a curved one. */
const FEW_FLAT = 4;

/** Describes all changes of the kind of the first one. */
function summaryOf(change: RepairChange, alike: readonly RepairChange[]): string {
  const count = alike.length;
  const triangles = plural(count, "triangle");
  const have = (one: string, several: string): string => (count === 1 ? one : several);
  switch (change.kind) {
    case "welded-node":
      return `welded ${plural(count, "node")} to ${have("another", "others")}`;
    case "removed-node":
      return `removed ${plural(count, "node")}, which no triangle uses`;
    case "removed-triangle":
      return `removed ${triangles}, which ${have("has", "have")} no area`;
    case "removed-duplicate":
      return `removed ${triangles}, ${have("a duplicate", "duplicates")} of ${have("another", "others")}`;
    case "split-triangle":
      return `split ${triangles} to replace ${have("another", "others")}, which ${have("has", "have")} no area`;
    case "filled-hole": {
      const filled = alike.reduce((sum, one) => sum + (one.kind === "filled-hole" ? one.triangles : 0), 0);
      const lid =
        filled > FEW_FLAT * count ? ", which span the rim and do not follow a curved surface around it" : "";
      return `filled ${have("a hole", `${count} holes`)} with ${plural(filled, "triangle")}${lid}`;
    }
    case "flipped-triangle":
      return `flipped ${triangles}`;
    case "resolved-intersection": {
      const parts = alike.reduce(
        (sum, one) => sum + (one.kind === "resolved-intersection" ? one.parts : 0),
        0,
      );
      return parts === 0
        ? `removed ${triangles}, which intersected others and ${have("is inside, or encloses", "are inside, or enclose")} nothing`
        : `cut ${triangles}, which intersected others; ${plural(parts, "part")} of ${have("it", "them")} remain${parts === 1 ? "s" : ""}`;
    }
    case "removed-sheet":
      return `removed ${triangles}, which enclosed nothing`;
  }
}

function exampleOf(change: RepairChange): string {
  switch (change.kind) {
    case "welded-node":
      return `node ${change.node} to node ${change.into}`;
    case "removed-node":
      return `node ${change.node}`;
    case "removed-duplicate":
      return `triangle ${change.triangle} (as triangle ${change.sameAs})`;
    case "split-triangle":
      return `triangle ${change.beyond} for triangle ${change.triangle}`;
    case "filled-hole":
      return `from triangle ${change.firstTriangle} on`;
    case "removed-triangle":
    case "flipped-triangle":
    case "resolved-intersection":
    case "removed-sheet":
      return `triangle ${change.triangle}`;
  }
}

export const EXACT_REPAIR =
  "the triangles are better after an exact repair, which welds no nodes; it replaces the changes above";
