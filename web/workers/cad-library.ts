/** Tells the package where this site has the library that reads CAD files; it is fetched with the first such file. */
import script from "occt-import-js/dist/occt-import-js.js?url";
import wasm from "occt-import-js/dist/occt-import-js.wasm?url";
import { setCadLibrary } from "tetrafront";

const absolute = (address: string) => new URL(address, import.meta.url).href;

setCadLibrary({ script: absolute(script), wasm: absolute(wasm) });
