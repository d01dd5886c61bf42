// Python with the packages that judge what is written: meshio, Gmsh, scikit-fem. Tests do without what is missing, and say so.
import { createHash } from "node:crypto";
import { existsSync, mkdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import path from "node:path";
import { withLock } from "./lock.mjs";
import { inRoot, toolchain } from "./paths.mjs";
import { output, run, say } from "./run.mjs";
import { which } from "./tools.mjs";

const folder = path.join(toolchain, "python");
const own = path.join(
  folder,
  ...(process.platform === "win32" ? ["Scripts", "python.exe"] : ["bin", "python"]),
);
/** Files of pinned packages, each for itself: Gmsh is not built for every machine. `debian` is what it may lack. */
const PARTS = [
  { name: "python-fem", module: "skfem" },
  { name: "python-gmsh", module: "gmsh", debian: ["libglu1-mesa", "libxcursor1", "libxft2", "libxinerama1"] },
];
const PIP = [
  "-m",
  "pip",
  "install",
  "-q",
  "--disable-pip-version-check",
  "--only-binary=:all:",
  "--retries=1",
];
/** Where the network is quick all of it takes a quarter of a minute. */
const LIMIT_MS = 120_000;

/** The Python that TETRAFRONT_PYTHON names, else our own where there is one, else the system's. */
export function pythonProgram() {
  return process.env.TETRAFRONT_PYTHON ?? (existsSync(stampOf(PARTS[0].name)) ? own : "python3");
}

/**
 * Makes a Python environment with the packages below .toolchain, unless it is there or TETRAFRONT_PYTHON names one. Of
 * several setups at once one makes it, and the others wait. What cannot be had is said here, and again where the tests
 * end; nothing fails for it.
 */
export async function ensurePython() {
  if (process.env.TETRAFRONT_PYTHON !== undefined || whatIsMissing().missing.length === 0) return;
  mkdirSync(toolchain, { recursive: true });
  await withLock(path.join(toolchain, "python.lock"), async () => {
    const { works, missing } = whatIsMissing();
    if (missing.length > 0) await addParts(works, missing);
  });
}

function whatIsMissing() {
  const works = output(own, ["--version"]) !== undefined;
  return { works, missing: PARTS.filter(({ name }) => !works || !isInstalled(name)) };
}

async function addParts(works, missing) {
  say("setup: making a Python environment with meshio, scikit-fem and Gmsh");
  if (!works) rmSync(folder, { recursive: true, force: true });
  if (!(await makeEnvironment())) {
    rmSync(folder, { recursive: true, force: true });
    say("setup: Python makes no environment (is python3-venv there?): see .toolchain/python.log");
    return;
  }
  for (const { name, module, debian = [] } of missing) {
    const isThere = await quietly(own, [...PIP, "-r", listOf(name)], name);
    if (isThere) writeFileSync(stampOf(name), digestOf(name));
    else say(`setup: scripts/${name}.txt could not be installed: see .toolchain/${name}.log`);
    if (isThere && output(own, ["-c", `import ${module}`]) === undefined) await addDebian(debian);
  }
}

async function makeEnvironment() {
  const make = () => quietly(which("python3", "python") ?? "python3", ["-m", "venv", folder], "python");
  return (await make()) || ((await addDebian(["python3-venv"])) && (await make()));
}

/** Whether the system's packages could be installed: only where this process may. */
async function addDebian(packages) {
  if (process.getuid?.() !== 0 || !which("apt-get") || packages.length === 0) return false;
  const install = ["install", "-y", "-q", "--no-install-recommends", ...packages];
  return (
    (await quietly("apt-get", ["update", "-q"], "python-apt")) &&
    (await quietly("apt-get", install, "python-apt"))
  );
}

async function quietly(program, args, name) {
  const options = {
    env: { DEBIAN_FRONTEND: "noninteractive" },
    log: path.join(toolchain, `${name}.log`),
    timeout: LIMIT_MS,
  };
  return (await run(program, args, options).catch(() => 1)) === 0;
}

const listOf = (name) => inRoot("scripts", `${name}.txt`);
const stampOf = (name) => path.join(folder, `.${name}`);
const digestOf = (name) =>
  createHash("sha256")
    .update(readFileSync(listOf(name)))
    .digest("hex");
const isInstalled = (name) =>
  existsSync(stampOf(name)) && readFileSync(stampOf(name), "utf8") === digestOf(name);
