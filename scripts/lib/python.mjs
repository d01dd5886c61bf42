// Python with the packages that check our files: meshio, Gmsh, scikit-fem; and Ray, for the example of a cluster. The
// tests run without missing packages and report it.
import { createHash } from "node:crypto";
import { existsSync, mkdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import path from "node:path";
import { withLock } from "./lock.mjs";
import { inRoot, toolchain } from "./paths.mjs";
import { output, run, say, UserError } from "./run.mjs";
import { which } from "./tools.mjs";

const folder = path.join(toolchain, "python");
const own = path.join(
  folder,
  ...(process.platform === "win32" ? ["Scripts", "python.exe"] : ["bin", "python"]),
);
/**
 * Files of pinned packages with their checksums, installed separately because Gmsh and Ray are not built for every machine. `debian`
 * lists the system packages that they may need.
 */
const PARTS = [
  { name: "python-fem", module: "skfem" },
  { name: "python-gmsh", module: "gmsh", debian: ["libglu1-mesa", "libxcursor1", "libxft2", "libxinerama1"] },
  { name: "python-cluster", module: "ray" },
];
const PIP = [
  "-m",
  "pip",
  "install",
  "-q",
  // Python compiles the modules that a test imports when it imports them.
  "--no-compile",
  "--disable-pip-version-check",
  "--only-binary=:all:",
  "--require-hashes",
  "--retries=1",
];
/** Time limit per step; on a fast network all steps take about 30 s. */
const LIMIT_MS = 120_000;

/** Returns the Python that TETRAFRONT_PYTHON names, otherwise our own if it exists, otherwise the system's. */
export function pythonProgram() {
  return process.env.TETRAFRONT_PYTHON ?? (existsSync(stampOf(PARTS[0].name)) ? own : "python3");
}

/**
 * Creates a Python environment with the packages under .toolchain, unless it exists or TETRAFRONT_PYTHON names
 * one. If several setups run at once, one creates it and the others wait. A package that cannot be installed is
 * reported here and at the end of the tests, but nothing fails.
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
  say("setup: creating a Python environment with meshio, scikit-fem, Gmsh and Ray");
  if (!works) rmSync(folder, { recursive: true, force: true });
  if (!(await makeEnvironment())) {
    rmSync(folder, { recursive: true, force: true });
    say("setup: Python cannot create an environment (is python3-venv installed?): see .toolchain/python.log");
    return;
  }
  for (const { name, module, debian = [] } of missing) {
    const isThere = await quietly(own, [...PIP, "-r", listOf(name)], name);
    if (isThere) writeFileSync(stampOf(name), digestOf(name));
    else if (wasRefused(name)) {
      throw new UserError(
        `A Python package differs from its checksum in scripts/${name}.txt, and was not installed: see .toolchain/${name}.log`,
      );
    } else say(`setup: scripts/${name}.txt could not be installed: see .toolchain/${name}.log`);
    if (isThere && output(own, ["-c", `import ${module}`]) === undefined) await addDebian(debian);
  }
}

/** Returns whether pip has refused a package because of its checksum: that is no failure of the network. */
function wasRefused(name) {
  const log = path.join(toolchain, `${name}.log`);
  return existsSync(log) && isChecksumError(readFileSync(log, "utf8"));
}

/** Returns whether the output of pip says that a file differs from its checksum, or has none. */
export const isChecksumError = (output) =>
  /DO NOT MATCH THE HASHES|Hashes are required|Expected sha256/.test(output);

async function makeEnvironment() {
  const make = () => quietly(which("python3", "python") ?? "python3", ["-m", "venv", folder], "python");
  return (await make()) || ((await addDebian(["python3-venv"])) && (await make()));
}

/** Installs system packages if this process may; returns whether it did. */
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
