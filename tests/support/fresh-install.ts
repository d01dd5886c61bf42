/** The package as users get it: packed by npm and installed into an empty folder. */
import { execFileSync } from "node:child_process";
import { cpSync, mkdirSync, mkdtempSync, readFileSync, rmSync, symlinkSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import path from "node:path";
import { fileURLToPath } from "node:url";

const root = fileURLToPath(new URL("../..", import.meta.url));

export interface FreshInstall {
  /** Folder with package.json and node_modules, and nothing else. */
  readonly folder: string;
  readonly tarball: string;
  /** Copies a folder of `examples` next to node_modules, where it finds the package. */
  readonly example: (name: string) => string;
  readonly dispose: () => void;
}

/**
 * Packs and installs the package. Also links `otherPackages` of this repository, which some examples need.
 */
export function freshInstall(otherPackages: readonly string[] = []): FreshInstall {
  const temporary = mkdtempSync(path.join(tmpdir(), "tetrafront-fresh-"));
  const [packed] = JSON.parse(
    npm(["pack", "--json", "--pack-destination", temporary], path.join(root, "wasm")),
  ) as readonly [{ readonly filename: string }];
  const tarball = path.join(temporary, packed.filename);
  const folder = path.join(temporary, "project");
  mkdirSync(folder);
  writeFileSync(path.join(folder, "package.json"), `{ "private": true, "type": "module" }\n`);
  try {
    npm(["install", "--prefer-offline", "--no-audit", "--no-fund", tarball], folder);
  } catch {
    unpack(tarball, folder);
  }
  for (const name of otherPackages) link(name, folder);
  return {
    folder,
    tarball,
    example: (name) => {
      const target = path.join(folder, name);
      cpSync(path.join(root, "examples", name), target, { recursive: true });
      // A page is served from its own folder, so that folder needs the packages too.
      symlinkSync(path.join(folder, "node_modules"), path.join(target, "node_modules"));
      return target;
    },
    dispose: () => rmSync(temporary, { recursive: true, force: true }),
  };
}

/** Installs without a network: unpacks the package and links its dependencies from this repository. */
function unpack(tarball: string, folder: string): void {
  const target = path.join(folder, "node_modules", "tetrafront");
  rmSync(path.join(folder, "node_modules"), { recursive: true, force: true });
  mkdirSync(target, { recursive: true });
  execFileSync("tar", ["xzf", tarball, "--strip-components=1", "-C", target]);
  const { dependencies, optionalDependencies } = JSON.parse(
    readFileSync(path.join(target, "package.json"), "utf8"),
  ) as Record<"dependencies" | "optionalDependencies", Record<string, string>>;
  for (const name of Object.keys({ ...dependencies, ...optionalDependencies })) link(name, folder);
}

function link(name: string, folder: string): void {
  const target = path.join(folder, "node_modules", name);
  mkdirSync(path.dirname(target), { recursive: true });
  symlinkSync(path.join(root, "node_modules", name), target);
}

export function npm(args: readonly string[], cwd: string): string {
  return execFileSync("npm", ["--loglevel=error", ...args], {
    cwd,
    encoding: "utf8",
    stdio: ["ignore", "pipe", "pipe"],
  });
}
