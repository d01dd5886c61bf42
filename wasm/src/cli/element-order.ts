/** `--element-order`: linear or second-order elements. */
import { Option } from "commander";
import { invalidOption } from "../diagnostics/package-diagnostic.js";
import { FILE_FORMATS, formatOf } from "../formats/file-formats.js";
import type { ElementOrder } from "../mesh/mesh.js";
import { refuseOptions } from "./input.js";

export interface ElementOrderOption {
  readonly elementOrder?: string;
}

export const elementOrderOption = (): Option =>
  new Option(
    "--element-order <order>",
    "2 adds a node at the middle of every edge: second-order elements (default 1)",
  ).choices(["1", "2"]);

/** Returns the order of the elements to write. Throws an InvalidInput if the format of `name` does not store it. */
export function elementOrderFor({ elementOrder }: ElementOrderOption, name: string): ElementOrder {
  if (elementOrder !== "2") return 1;
  const format = formatOf(name);
  if (format?.hasSecondOrder === true) return 2;
  const known = FILE_FORMATS.filter(({ hasSecondOrder }) => hasSecondOrder).flatMap(
    ({ extensions }) => extensions,
  );
  const message = `${format?.name ?? "these"} files cannot be written with second-order elements`;
  const remedy = `Use a name that ends in one of ${known.join(", ")}, or omit --element-order.`;
  refuseOptions([invalidOption("--element-order", message, remedy)]);
  return 1;
}
