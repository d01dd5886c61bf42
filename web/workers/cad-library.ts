/** Tells the package where this site has the libraries that read CAD files; they are fetched with the first such file. */
import script from "occt-import-js/dist/occt-import-js.js?url";
import wasm from "occt-import-js/dist/occt-import-js.wasm?url";
import kernelScript from "replicad-opencascadejs?url";
import kernelWasm from "replicad-opencascadejs/wasm?url";
import { setCadLibrary } from "tetrafront";

const absolute = (address: string) => new URL(address, import.meta.url).href;

/** Where this site has the kernel. */
export const kernelFiles = { script: absolute(kernelScript), wasm: absolute(kernelWasm) };

setCadLibrary({
  script: absolute(script),
  wasm: absolute(wasm),
  kernel: kernelFiles,
});
