// THIRD-PARTY-NOTICES.txt: name, version, licence and licence text of everything that a site or a package contains.
import { existsSync, readdirSync, readFileSync } from "node:fs";
import path from "node:path";
import { inRoot } from "./paths.mjs";

const licenceFile = /^(licen[cs]e|copying|copyright|notice)/i;
const text = (name) => readFileSync(inRoot("scripts", "notices", `${name}.txt`), "utf8");

/** What Emscripten compiles into each WebAssembly file. */
const RUNTIME = [
  { name: "Emscripten (runtime)", licence: "MIT", of: "emscripten" },
  { name: "musl (C library)", licence: "MIT", of: "musl" },
  {
    name: "LLVM: libc++, libc++abi, libunwind, compiler-rt",
    licence: "Apache-2.0 WITH LLVM-exception",
    of: "llvm",
  },
];
/** What is compiled into the engine. */
export const ENGINE_PARTS = [...RUNTIME, { name: "GLM", licence: "MIT", of: "glm" }];
/** What is compiled into files of packages, beside the package. */
const INSIDE = {
  "manifold-3d": [...RUNTIME, { name: "Clipper2 (in manifold-3d)", licence: "BSL-1.0", of: "clipper2" }],
  "occt-import-js": RUNTIME,
  "replicad-opencascadejs": RUNTIME,
};
/** What the licences ask to be said, beside their texts. */
const REMARKS = {
  "occt-import-js":
    "Contains OpenCascade Technology (LGPL-2.1 with the Open CASCADE exception), compiled to WebAssembly. The library is " +
    "used unchanged, in files of its own that can be replaced by other builds of it. Its source code: " +
    "https://github.com/kovacsv/occt-import-js and https://dev.opencascade.org",
  "replicad-opencascadejs":
    "OpenCascade Technology (LGPL-2.1 with the Open CASCADE exception), compiled to WebAssembly. The library is used " +
    "unchanged, in files of its own that can be replaced by other builds of it. Its source code: " +
    "https://github.com/sgenoud/replicad and https://dev.opencascade.org",
};

/** Returns the folder of the npm package that contains a module; undefined for our own files. */
export function packageFolder(id) {
  const file = id.replace(/^\0+/, "").replace(/\?.*$/, "").split(path.sep).join("/");
  return /^(.*\/node_modules\/(?:@[^/]+\/)?[^/]+)\//.exec(file)?.[1];
}

/** Returns the names of the files with licence texts; `dist` holds those of what a package includes. */
function licenceFiles(folder) {
  return [folder, path.join(folder, "dist")]
    .filter((place) => existsSync(place))
    .flatMap((place) => readdirSync(place).map((name) => path.join(place, name)))
    .filter((file) => licenceFile.test(path.basename(file)) && !/\.(js|ts|mjs)$/.test(file))
    .sort();
}

/** Some packages name the MIT License and their author, and have no file with its text. */
function standardText(license, author) {
  const holder = typeof author === "object" ? author.name : author?.replace(/\s*[<(].*$/, "");
  return license === "MIT" && holder ? [`Copyright (c) ${holder}\n\n${text("mit")}`] : [];
}

/** Returns the notice of an npm package. Throws if it has no licence: then it must not be shipped. */
function packageNotice(folder) {
  const { name, version, license, author } = JSON.parse(
    readFileSync(path.join(folder, "package.json"), "utf8"),
  );
  const files = licenceFiles(folder);
  const texts =
    files.length > 0 ? files.map((file) => readFileSync(file, "utf8")) : standardText(license, author);
  if (texts.length === 0 || typeof license !== "string")
    throw new Error(`${name} ${version} has no licence, which THIRD-PARTY-NOTICES.txt must contain`);
  return { name, title: `${name} ${version}`, licence: license, remark: REMARKS[name], texts };
}

const partNotice = ({ name, licence, of }) => ({ name, title: name, licence, texts: [text(of)] });

/**
 * Returns the text of the notices.
 * @param modules files that were bundled; those outside of node_modules are ours.
 * @param parts what is compiled into our own files.
 * @param whole what the notices are about.
 */
export function noticesText(modules, parts, whole) {
  const folders = new Set([...modules].map(packageFolder).filter((folder) => folder !== undefined));
  const packages = [...folders].map(packageNotice);
  const inside = packages.flatMap(({ name }) => INSIDE[name] ?? []);
  const unique = new Map();
  for (const notice of [...packages, ...[...parts, ...inside].map(partNotice)])
    unique.set(notice.title, notice);
  const notices = [...unique.values()].sort((a, b) =>
    a.title.toLowerCase() < b.title.toLowerCase() ? -1 : 1,
  );
  const line = "=".repeat(80);
  return [
    `${whole} contains the following works of others, under their own licences. Tetrafront itself is`,
    "under the MIT License.",
    "",
    ...notices.map(({ title, licence }) => `  ${title}: ${licence}`),
    "",
    ...notices.flatMap(({ title, licence, remark, texts }) => [
      line,
      `${title}`,
      `Licence: ${licence}`,
      ...(remark === undefined ? [] : [remark]),
      line,
      "",
      ...texts.map((each) => `${each.replaceAll("\r\n", "\n").trim()}\n`),
    ]),
  ].join("\n");
}
