/** Where browsers find the library that reads CAD files. */
import * as v from "valibot";
import { checkArgument } from "../calls/argument-checks.js";
import type { CadLibrary } from "./protocol.js";

let library: CadLibrary | undefined;

const files = v.object({ script: v.string(), wasm: v.string() });

/**
 * Sets the addresses of the libraries that read CAD files for this page or worker, before it reads one; bundlers return them for
 * `import script from "occt-import-js/dist/occt-import-js.js?url"` or an equivalent. Without a call, a browser looks for the
 * libraries beside the package, as in a folder `node_modules` that is served. Has no effect in Node, which finds the libraries by
 * their names. Throws a `MesherError` for other arguments.
 */
export function setCadLibrary(addresses: CadLibrary): void {
  checkArgument("addresses", addresses, v.object({ ...files.entries, kernel: v.optional(files) }));
  const { script, wasm, kernel } = addresses;
  library = {
    script: absolute(script),
    wasm: absolute(wasm),
    kernel: kernel && { script: absolute(kernel.script), wasm: absolute(kernel.wasm) },
  };
}

/** A worker would resolve a relative address by its own. */
function absolute(address: string): string {
  const base = (globalThis as { readonly location?: { readonly href: string } }).location?.href;
  return base === undefined ? address : new URL(address, base).href;
}

/** Returns the addresses that were set, or those beside this package. */
export function cadLibrary(): CadLibrary {
  if (library !== undefined) return library;
  // Bundlers would look for the files if the address of this module were written in place of the variable.
  const here = import.meta.url;
  const beside = (path: string) => new URL(`../../../${path}`, here).href;
  const both = (path: string) => ({ script: beside(`${path}.js`), wasm: beside(`${path}.wasm`) });
  return {
    ...both("occt-import-js/dist/occt-import-js"),
    kernel: both("replicad-opencascadejs/dist/replicad_single"),
  };
}
