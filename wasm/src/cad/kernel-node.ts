/** Loads the kernel in Node. */
import { createRequire } from "node:module";
import type { CadKernel } from "./kernel.js";

type CreateKernel = (options: object) => Promise<CadKernel>;

/** The kernel prints statistics, which would mix with the output of the program. */
const QUIET = { print: () => undefined, printErr: () => undefined };

/** Returns a new instance of the kernel. Throws if the package is not installed. Takes 1 to 2 s. */
export async function loadKernel(): Promise<CadKernel> {
  const find = createRequire(import.meta.url).resolve;
  const wasm = find("replicad-opencascadejs/wasm");
  const name = "replicad-opencascadejs";
  const { default: create } = (await import(name)) as { readonly default: CreateKernel };
  return create({ ...QUIET, locateFile: () => wasm });
}
