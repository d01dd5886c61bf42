// Parts of the package that the site does not use, but that no bundler can leave out.

/** Calls of a mesher that neither the app nor another call makes, with what they import. A test looks for such calls in the app. */
export const UNUSED_CALLS = {
  adapt: /import \{ (adaptationCycles) \} from "\.\/adaptation-cycles\.js";/,
  addLayers: /import \{ (addLayers) \} from "\.\/layers\.js";/,
  meshSurface: /import \{ (meshedSurface), (unmeshed) \} from "\.\/surface-meshing\.js";/,
};

/**
 * Returns the mesher without the calls that the app does not make. Throws if it imports them in another way.
 * @param {string} code
 * @returns {string}
 */
export function withoutUnusedCalls(code) {
  let changed = code;
  for (const [call, pattern] of Object.entries(UNUSED_CALLS)) {
    if (!pattern.test(changed))
      throw new Error(`mesher.js imports ${call} in another way: see site-package.mjs`);
    changed = changed.replace(pattern, (line) =>
      line
        .slice(line.indexOf("{") + 1, line.indexOf("}"))
        .split(",")
        .map((name) => `const ${name.trim()} = undefined;`)
        .join(" "),
    );
  }
  return changed;
}

export function smallerPackage() {
  return {
    name: "tetrafront:smaller-package",
    enforce: "pre",
    /** The descriptions of a project's fields are only for the JSON Schema, which the package has. */
    load: (id) => (/\/project\/words\.js$/.test(id) ? "export const WORDS = {};" : null),
    transform: (code, id) =>
      /\/wasm\/dist\/api\/mesher\.js$/.test(id) ? { code: withoutUnusedCalls(code), map: null } : null,
  };
}
