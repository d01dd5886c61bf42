import path from "node:path";
import { toolchain } from "./paths.mjs";
import { must, say, UserError } from "./run.mjs";
import { which } from "./tools.mjs";

/**
 * Installs Debian packages if this process may; otherwise stops with the line that the user must run.
 * @param missing what was not found: `{ what, debian }`, the description and the name of the package.
 */
export async function installMissing(missing) {
  if (missing.length === 0) return;
  const packages = [...new Set(missing.map((item) => item.debian))];
  const words = missing.map((item) => item.what).join(", ");
  const isRoot = process.getuid?.() === 0;
  if (!which("apt-get")) {
    throw new UserError(
      `Not found: ${words}. Install them with your system's package manager and run this again.`,
    );
  }
  if (!isRoot) {
    throw new UserError(
      `Not found: ${words}. Run this, then try again:\n` +
        `  sudo apt-get update && sudo apt-get install -y --no-install-recommends ${packages.join(" ")}`,
    );
  }
  say(`setup: installing Debian's packages ${packages.join(" ")}`);
  const options = { env: { DEBIAN_FRONTEND: "noninteractive" }, log: path.join(toolchain, "apt.log") };
  await must("apt-get", ["update", "-q"], options);
  await must("apt-get", ["install", "-y", "-q", "--no-install-recommends", ...packages], options);
}
