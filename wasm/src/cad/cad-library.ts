/** Where browsers find the library that reads CAD files. */
import * as v from "valibot";
import { checkArgument } from "../calls/argument-checks.js";
import type { CadLibrary } from "./protocol.js";

let library: CadLibrary | undefined;

/**
 * Sets the addresses of the library `occt-import-js` for this page or worker, before it reads a CAD file; bundlers
 * return them for `import script from "occt-import-js/dist/occt-import-js.js?url"` or an equivalent. Without a call, a
 * browser looks for the library beside the package, as in a folder `node_modules` that is served. Has no effect in Node,
 * which finds the library by its name. Throws a `MesherError` for other arguments.
 */
export function setCadLibrary(addresses: CadLibrary): void {
  checkArgument("addresses", addresses, v.object({ script: v.string(), wasm: v.string() }));
  library = { script: absolute(addresses.script), wasm: absolute(addresses.wasm) };
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
  const beside = (name: string) => new URL(`../../../occt-import-js/dist/${name}`, here).href;
  return { script: beside("occt-import-js.js"), wasm: beside("occt-import-js.wasm") };
}
