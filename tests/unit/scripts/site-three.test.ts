import { mkdtempSync, readdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import path from "node:path";
import { pathToFileURL } from "node:url";
import { afterAll, describe, expect, it } from "vitest";
import {
  withoutAnimation,
  withoutUnusedManagers,
  withoutUnusedShaders,
} from "../../../scripts/lib/site-three.mjs";

const root = path.resolve(import.meta.dirname, "../../..");
const build = path.join(root, "node_modules/three/build");
const folder = mkdtempSync(path.join(tmpdir(), "tetrafront-three-"));
afterAll(() => rmSync(folder, { recursive: true }));

type Shaders = Readonly<Record<string, { readonly vertexShader?: string; readonly fragmentShader?: string }>>;
interface Renderer {
  readonly ShaderChunk: Readonly<Record<string, string | undefined>>;
  readonly ShaderLib: Shaders;
}

async function smallerRenderer(): Promise<Renderer> {
  const core = pathToFileURL(path.join(build, "three.core.js")).href;
  const code = readFileSync(path.join(build, "three.module.js"), "utf8");
  const file = path.join(folder, "three.module.mjs");
  const smaller = withoutUnusedShaders(withoutUnusedManagers(code));
  writeFileSync(file, smaller.replaceAll("'./three.core.js'", JSON.stringify(core)));
  return (await import(pathToFileURL(file).href)) as Renderer;
}

/** Returns the sources of the app. */
function sources(): readonly string[] {
  const web = path.join(root, "web");
  return readdirSync(web, { recursive: true })
    .map(String)
    .filter((name) => /\.tsx?$/.test(name) && !/^(dist|node_modules)\b/.test(name))
    .map((name) => readFileSync(path.join(web, name), "utf8"));
}

describe("the renderer of the site", () => {
  it("keeps the basic material, with all that it includes, and no other one", async () => {
    const { ShaderChunk, ShaderLib } = await smallerRenderer();
    const whole = (await import(pathToFileURL(path.join(build, "three.module.js")).href)) as Renderer;
    const check = (text: string): void => {
      for (const [, name = ""] of text.matchAll(/#include <(\w+)>/g)) {
        expect(ShaderChunk[name], name).toBe(whole.ShaderChunk[name]);
        check(ShaderChunk[name] ?? "");
      }
    };
    const basic = ShaderLib["basic"];
    expect(basic?.vertexShader).toContain("void main()");
    check(`${basic?.vertexShader}${basic?.fragmentShader}`);
    for (const name of ["lambert", "phong", "standard", "physical", "points", "sprite"])
      expect(ShaderLib[name]?.vertexShader, name).toBeUndefined();
  });

  it("has what the app draws with: its own shaders, and the basic material", async () => {
    const { ShaderChunk } = await smallerRenderer();
    const materials = new Set<string>();
    let includes = 0;
    for (const text of sources()) {
      for (const [, name = ""] of text.matchAll(/\b(?:new|extends) (\w+Material)\b/g)) materials.add(name);
      for (const [, name = ""] of text.matchAll(/#include <(\w+)>/g)) {
        expect(ShaderChunk[name], name).toBeDefined();
        includes++;
      }
    }
    expect(includes).toBeGreaterThan(0);
    expect([...materials].toSorted()).toEqual(["LineBasicMaterial", "MeshBasicMaterial", "ShaderMaterial"]);
  });

  it("has a core without animations, and uses none", async () => {
    const file = path.join(folder, "three.core.mjs");
    const code = withoutAnimation(readFileSync(path.join(build, "three.core.js"), "utf8"));
    writeFileSync(file, code);
    const core = (await import(pathToFileURL(file).href)) as Readonly<Record<string, object>>;
    expect(core["PropertyBinding"]).not.toHaveProperty("Composite");
    expect(Object.getOwnPropertyNames(core["Matrix4"])).toContain("prototype");
    for (const text of sources())
      expect(text).not.toMatch(/\b(Animation\w+|\w*KeyframeTrack|PropertyBinding)\b.*"three"/);
  });

  it("must be the version whose script is known", () => {
    expect(() => withoutUnusedManagers("new WebXRManager()")).toThrow("site-three.mjs");
    expect(() => withoutAnimation("class PropertyBinding {}")).toThrow("site-three.mjs");
    expect(() => withoutUnusedShaders("const ShaderChunk = {};")).toThrow("site-three.mjs");
  });
});
