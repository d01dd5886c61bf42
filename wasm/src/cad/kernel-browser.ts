/** Loads the kernel in a worker of a page. */
import { QUIET } from "./opencascade.js";

/** Where a site has the kernel. */
export interface KernelFiles {
  readonly script: string;
  readonly wasm: string;
}

/** Returns a new instance of the kernel. `Kernel`: the part of it that the caller uses. */
export async function importKernel<Kernel>({ script, wasm }: KernelFiles): Promise<Kernel> {
  const { default: create } = (await import(/* @vite-ignore */ /* webpackIgnore: true */ script)) as {
    readonly default: (options: object) => Promise<Kernel>;
  };
  return create({ ...QUIET, locateFile: () => wasm });
}
