/**
 * Messages of the package name its options and calls in backquotes: `weld: 0.1` or `repairSurface()`. On the command line, they
 * are named as they are typed there: --weld 0.1 and --repair.
 */
import type { Diagnostic } from "../diagnostics/diagnostic.js";

/** Options that messages name; a name in backquotes that a user has given stays as it is. */
const OPTIONS: ReadonlySet<string> = new Set([
  ...([
    "size",
    "elements",
    "growth",
    "background",
    "maxVolume",
    "innerShells",
    "order",
    "optimization",
    "interior",
    "threads",
  ] as const),
  ...(["minSize", "maxSize", "tolerance", "featureAngle", "anglePerEdge", "layers", "dropDetails"] as const),
  ...(["surface", "repair", "weld", "fillHoles", "splitPatches", "elementOrder"] as const),
  ...(["scale", "units", "fileUnits"] as const),
]);

/** Options whose name on the command line is not that of the call in other letters. */
const OTHERS: ReadonlyMap<string, string> = new Map([["optimization", "optimize"]]);

/** What does the same as a call of the package. */
const CALLS: ReadonlyMap<string, string> = new Map([
  ["repairSurface", "--repair"],
  ["refineSurface", "--surface refine"],
  ["remeshSurface", "--surface remesh"],
  ["inspectSurface", "tetrafront check"],
  ["improveMesh", "tetrafront improve"],
  ["adaptMesh", "tetrafront adapt"],
  ["addLayers", "tetrafront adapt --layers"],
]);

const OPTION_OR_CALL = /`([a-zA-Z]+(?:: (?:"[^"`]*"|[^"`]+))?)`,? or `[a-zA-Z]+\(\)`/g;
const CODE = /`([a-zA-Z]+)(?:(\(\))|: (?:"([^"`]*)"|([^"`]+)))?`/g;

/** Returns a text of the package with the names of the command line. */
export function inCommandLineWords(text: string): string {
  return text.replace(OPTION_OR_CALL, "`$1`").replace(CODE, asTyped);
}

function asTyped(code: string, name: string, call?: string, word?: string, value?: string): string {
  if (call !== undefined) return CALLS.get(name) ?? code;
  if (!OPTIONS.has(name)) return code;
  const option = `--${OTHERS.get(name) ?? name.replace(/[A-Z]/g, (letter) => `-${letter.toLowerCase()}`)}`;
  const given = word ?? value;
  return given === undefined || given === "true" ? option : `${option} ${given}`;
}

/** Returns a diagnostic with the names of the command line. */
export function asTypedDiagnostic(found: Diagnostic): Diagnostic {
  const [message, remedy] = [inCommandLineWords(found.message), inCommandLineWords(found.remedy)];
  return message === found.message && remedy === found.remedy ? found : { ...found, message, remedy };
}
