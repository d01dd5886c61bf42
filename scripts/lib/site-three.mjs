// The renderer of three.js holds the shaders of all its materials as one object, and makes managers of virtual reality and of
// environments that are mirrored, of shadows and of shapes that change: no bundler can leave out any. The app has shaders of its own,
// and of three.js only the basic material of faces and lines. Classes for animations get members after their declaration, which keeps
// them in every build.

/** Shaders that the app draws with; what they include is kept too. `colorspace_fragment` is included by shaders of the app. */
const KEPT = ["meshbasic_vert", "meshbasic_frag", "colorspace_fragment"];

const DECLARED = /^(?:var|const) ([\w$]+) = ("(?:[^"\\\n]|\\.)*");$/gm;
const TABLE = /^const ShaderChunk = \{([^}]*)\};$/m;
const ENTRY = /(\w+): ([\w$]+)/g;
const INCLUDED = /#include <(\w+)>/g;
/** What the renderer itself adds to every program. */
const ADDED = /ShaderChunk\[ '(\w+)' \]/g;

/** What the renderer makes, and what takes its place: nothing of it is shown, and a texture is what it is. */
const REPLACED = {
  "new WebXRManager( _this, _gl )":
    "{ enabled: false, isPresenting: false, getEnvironmentBlendMode() {}, setAnimationLoop() {}, addEventListener() {}, removeEventListener() {}, dispose() {} }",
  "new WebGLEnvironments( _this )": "{ get: ( texture ) => texture, dispose() {} }",
  "new WebGLOutput( _outputBufferType, canvas.width, canvas.height, antialias, depth, stencil )": "null",
  "new WebGLShadowMap( _this, objects, capabilities )":
    "{ enabled: false, autoUpdate: true, needsUpdate: false, type: PCFShadowMap, render() {} }",
  "new WebGLMorphtargets( _gl, capabilities, textures )": "{ update() {} }",
  "new WebGLUniformsGroups( _gl, info, capabilities, state )": "{ bind() {}, update() {}, dispose() {} }",
};

/**
 * Returns the renderer without its managers that the app does not need. Throws if it is another version of the renderer.
 * @param {string} code
 * @returns {string}
 */
export function withoutUnusedManagers(code) {
  let changed = code;
  for (const [made, instead] of Object.entries(REPLACED)) {
    if (changed.split(made).length !== 2)
      throw new Error(`three.js has no "${made}" where it had it before: see site-three.mjs`);
    changed = changed.replace(made, () => instead);
  }
  return changed;
}

/** Members that classes for animations get after their declaration: texts, numbers and classes, and lists of them. */
const ANIMATION_MEMBERS =
  /^(?:\w*KeyframeTrack|PropertyBinding)\.[\w.]+ = (?:[\w']*;|\{[^}]*\};|\[[\s\S]*?^\];)$/gm;

/**
 * Returns the core of three.js without the members of classes for animations, so that the bundler leaves out the classes. Throws if it
 * is another version of the core.
 * @param {string} code
 * @returns {string}
 */
export function withoutAnimation(code) {
  const changed = code.replace(ANIMATION_MEMBERS, "");
  if (changed === code || /^(?:\w*KeyframeTrack|PropertyBinding)\./m.test(changed))
    throw new Error("three.js has other members of animations than before: see site-three.mjs");
  return changed;
}

/**
 * Returns the renderer without the shaders that the app does not use; a material that needs one fails when it is compiled. Throws if it is
 * another version of the renderer.
 * @param {string} code
 * @returns {string}
 */
export function withoutUnusedShaders(code) {
  const texts = new Map([...code.matchAll(DECLARED)].map(([, name, text]) => [name, text]));
  const table = new Map(
    [...(TABLE.exec(code)?.[1] ?? "").matchAll(ENTRY)].map(([, name, text]) => [name, text]),
  );
  const kept = new Set();
  const keep = (name) => {
    const text = texts.get(table.get(name));
    if (text === undefined)
      throw new Error(`three.js has no shader ${name} where it had it before: see site-three.mjs`);
    if (kept.has(table.get(name))) return;
    kept.add(table.get(name));
    for (const [, included] of text.matchAll(INCLUDED)) keep(included);
  };
  for (const name of [...KEPT, ...[...code.matchAll(ADDED)].map(([, added]) => added)]) keep(name);
  const shaders = new Set(table.values());
  return code.replace(DECLARED, (line, name) =>
    shaders.has(name) && !kept.has(name) ? `const ${name} = undefined;` : line,
  );
}

const SMALLER = {
  "three.module.js": (code) => withoutUnusedShaders(withoutUnusedManagers(code)),
  "three.core.js": withoutAnimation,
};

export function smallerThree() {
  return {
    name: "tetrafront:smaller-three",
    transform: (code, id) => {
      const name = /\/three\/build\/(three\.\w+\.js)$/.exec(id)?.[1];
      const smaller = name && SMALLER[name];
      return smaller ? { code: smaller(code), map: null } : null;
    },
  };
}
