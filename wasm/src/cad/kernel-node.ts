/** Loads the kernel in Node. */
import { createRequire } from "node:module";
import type { CadKernel, CreateKernel } from "./kernel-classes.js";
import { QUIET } from "./opencascade.js";

/** Returns a new instance of the kernel. Throws if the package is not installed. Takes 1 to 2 s. */
export async function loadKernel(): Promise<CadKernel> {
  const find = createRequire(import.meta.url).resolve;
  const wasm = find("replicad-opencascadejs/wasm");
  const name = "replicad-opencascadejs";
  const { default: create } = (await import(name)) as { readonly default: CreateKernel };
  return create({ ...QUIET, locateFile: () => wasm });
}
