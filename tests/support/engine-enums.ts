import { readFileSync } from "node:fs";

/**
 * Returns values and names of an enum in a public header of the engine: `kOpenEdge = 40` is [40,
 * "open-edge"].
 */
export function engineEnum(header: string, name: string): [number, string][] {
  const file = new URL(`../../cpp/include/tetrafront/${header}`, import.meta.url);
  const body = new RegExp(`enum class ${name} [^{]*{([^}]*)}`).exec(readFileSync(file, "utf8"))?.[1] ?? "";
  const found = [...body.matchAll(/(?:^|,)\s*k(\w+) = (\d+)/gm)].map(([, word, value]): [number, string] => [
    Number(value),
    kebab(word ?? ""),
  ]);
  if (found.length === 0) throw new Error(`no enum ${name} in ${header}`);
  return found;
}

/** Returns a constant from a header of the engine: 10 for `inline constexpr double kMaxGrowth = 10.0;`. */
export function engineConstant(header: string, name: string): number {
  const file = new URL(`../../cpp/${header}`, import.meta.url);
  const word = new RegExp(`constexpr (?:double|std::uint32_t) ${name} = ([^;]*);`).exec(
    readFileSync(file, "utf8"),
  )?.[1];
  if (word === undefined) throw new Error(`no constant ${name} in ${header}`);
  const power = /^0x1p(-?\d+)$/.exec(word)?.[1];
  return power === undefined ? Number(word) : 2 ** Number(power);
}

function kebab(name: string): string {
  return name.replace(/(?<=.)([A-Z])/g, "-$1").toLowerCase();
}
