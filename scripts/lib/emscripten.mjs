import { existsSync, mkdirSync } from "node:fs";
import path from "node:path";
import { inRoot, toolchain } from "./paths.mjs";
import { output, run, say, UserError } from "./run.mjs";
import { atLeast, versionIn, which } from "./tools.mjs";

const kMinVersion = [3, 1, 69];
const kEmsdkVersion = "3.1.69";
const kEmsdkUrl = "https://github.com/emscripten-core/emsdk.git";
const kEmsdkStore = "https://storage.googleapis.com/webassembly/";

const emsdkFolder = path.join(toolchain, "emsdk");
const emsdkEmcc = path.join(emsdkFolder, "upstream", "emscripten", "emcc");

/**
 * Returns Emscripten as `{ folder, env }`: the folder of emcc, and the environment that its programs need. Tries,
 * in this order: a recent emcc on PATH; what an earlier run installed; emsdk, if it can be downloaded; Debian's
 * packages, unpacked privately.
 */
export async function ensureEmscripten() {
  const onPath = which("emcc");
  if (onPath && isNewEnough(onPath, {})) return { folder: path.dirname(onPath), env: {} };
  if (existsSync(emsdkEmcc)) return emsdk();
  if (!privateIsInstalled() && (await installEmsdk())) return emsdk();
  return debian();
}

function isNewEnough(emcc, env) {
  const version = versionIn(output(emcc, ["--version"], { env }));
  return version !== undefined && atLeast(version, kMinVersion);
}

/** An EM_CONFIG left over from an emsdk on this machine would override the private one. */
const privateEnv = { EM_CONFIG: undefined, EMSDK: undefined };

function emsdk() {
  return { folder: path.dirname(emsdkEmcc), env: privateEnv };
}

async function installEmsdk() {
  if (!which("git") || !which("python3") || !(await canDownload())) return false;
  say(`setup: installing emsdk ${kEmsdkVersion} under .toolchain/`);
  mkdirSync(toolchain, { recursive: true });
  if (!existsSync(path.join(emsdkFolder, "emsdk.py"))) {
    const clone = ["clone", "--quiet", "--depth", "1", "--branch", kEmsdkVersion, kEmsdkUrl, emsdkFolder];
    if ((await run("git", clone, { quietOut: true })) !== 0) return false;
  }
  for (const step of ["install", "activate"]) {
    const status = await run("python3", ["emsdk.py", step, kEmsdkVersion], {
      cwd: emsdkFolder,
      quietOut: true,
    });
    if (status !== 0) return false;
  }
  return isNewEnough(emsdkEmcc, privateEnv);
}

async function canDownload() {
  try {
    await fetch(kEmsdkStore, { method: "HEAD", signal: AbortSignal.timeout(5000) });
    return output("git", ["ls-remote", "--exit-code", kEmsdkUrl, "HEAD"], { timeout: 10_000 }) !== undefined;
  } catch {
    return false;
  }
}

function privateIsInstalled() {
  return existsSync(path.join(toolchain, "emscripten", "stamp"));
}

async function debian() {
  const script = inRoot("scripts", "install-emscripten.sh");
  const env = { EMSCRIPTEN_PRIVATE: "1" };
  let folder = privateIsInstalled() ? output("bash", [script], { env }) : undefined;
  if (folder === undefined) {
    const canUnpack = ["apt-get", "dpkg-deb", "python3", "tar", "flock"].every((tool) => which(tool));
    if (!canUnpack || (await run("bash", [script], { env, quietOut: true })) !== 0) {
      throw new UserError(
        "Emscripten 3.1.69 or later is needed and could not be installed here. Install it and put emcc on PATH:\n" +
          `  git clone ${kEmsdkUrl} ~/emsdk && ~/emsdk/emsdk install ${kEmsdkVersion} && ` +
          `~/emsdk/emsdk activate ${kEmsdkVersion} && . ~/emsdk/emsdk_env.sh`,
      );
    }
    folder = output("bash", [script], { env });
  }
  if (!folder?.trim()) throw new UserError("scripts/install-emscripten.sh printed no folder: run it by hand");
  return { folder: folder.trim(), env: privateEnv };
}

/** Returns the folder of the GLM headers that come with the private Emscripten, or undefined. */
export function glmBesideEmscripten(folder) {
  const include = path.resolve(folder, "..", "..", "include");
  return existsSync(path.join(include, "glm", "glm.hpp")) ? include : undefined;
}
