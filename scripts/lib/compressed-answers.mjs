// The build compresses what a first visit loads as well as it can, in files that many hosts send: `NAME.br`. `npm run preview` sends
// them too, compresses its other answers as hosts do, and lets browsers keep files with a hash in their names.
import { existsSync } from "node:fs";
import { readdir, readFile, stat, writeFile } from "node:fs/promises";
import path from "node:path";
import { promisify } from "node:util";
import { brotliCompress, constants, gzip } from "node:zlib";
import { whenWritten } from "./site-written.mjs";

const types = {
  ".css": "text/css",
  ".html": "text/html",
  ".js": "text/javascript",
  ".json": "application/json",
  ".md": "text/markdown",
  ".svg": "image/svg+xml",
  ".txt": "text/plain",
  ".wasm": "application/wasm",
  ".webmanifest": "application/manifest+json",
};

/** Browsers compile WebAssembly while it arrives only if its type has no charset. */
const contentType = (extension) =>
  extension === ".wasm" ? types[extension] : `${types[extension]}; charset=utf-8`;

const brotli = (bytes, level) =>
  promisify(brotliCompress)(bytes, { params: { [constants.BROTLI_PARAM_QUALITY]: level } });
const encoders = {
  // A good part of what the best level saves, in a fraction of its time.
  br: (bytes) => brotli(bytes, 5),
  gzip: promisify(gzip),
};

/** Smaller files are not worth it. */
const minBytes = 512;

const encodingFor = (header = "") =>
  Object.keys(encoders).find((name) => header.split(",").some((part) => part.trim().split(";")[0] === name));

/** Returns the file in the folder that an address names, or undefined. */
function fileFor(folder, address) {
  const url = URL.canParse(address, "http://localhost") ? new URL(address, "http://localhost") : null;
  // Names of the site's files have no letters that addresses escape.
  if (!url || url.pathname.includes("%")) return undefined;
  const name = url.pathname.endsWith("/") ? `${url.pathname}index.html` : url.pathname;
  const file = path.join(folder, name);
  return file.startsWith(folder + path.sep) && path.extname(file) in types ? file : undefined;
}

/** Answers with compressed files of the folder; everything else goes to the next handler. */
export function compressedFiles(folder, headers = {}) {
  const made = new Map();
  const compressed = async (file, encoding) => {
    const { mtimeMs, size } = await stat(file);
    if (size < minBytes) return null;
    const key = `${encoding} ${mtimeMs} ${size} ${file}`;
    if (!made.has(key)) {
      const best = `${file}.${encoding}`;
      made.set(key, existsSync(best) ? readFile(best) : readFile(file).then(encoders[encoding]));
    }
    return { bytes: await made.get(key), tag: `W/"${size}-${mtimeMs}-${encoding}"` };
  };
  return async (request, response, next) => {
    const encoding = encodingFor(request.headers["accept-encoding"]);
    const file =
      request.method === "GET" && !request.headers.range ? fileFor(folder, request.url) : undefined;
    const found = file && encoding ? await compressed(file, encoding).catch(() => null) : null;
    if (!found) return next();
    const isHashed = path.basename(path.dirname(file)) === "assets";
    for (const [name, value] of Object.entries(headers)) response.setHeader(name, value);
    response.setHeader("Content-Type", contentType(path.extname(file)));
    response.setHeader("Vary", "Accept-Encoding");
    response.setHeader("Cache-Control", isHashed ? "public, max-age=31536000, immutable" : "no-cache");
    response.setHeader("ETag", found.tag);
    if (request.headers["if-none-match"] === found.tag) {
      response.statusCode = 304;
      return response.end();
    }
    response.setHeader("Content-Encoding", encoding);
    response.setHeader("Content-Length", found.bytes.length);
    return response.end(found.bytes);
  };
}

/** Large files that a first visit loads and that its page does not name. */
const firstWorkers = /^(engine|worker|mesh-query-worker|surface-worker|project-worker)-.*\.(js|wasm)$/;

/** Compresses what the page of the built site loads. */
async function compressFirstVisit(folder) {
  const page = await readFile(path.join(folder, "index.html"), "utf8");
  const named = [...page.matchAll(/(?:href|src)="\.\/(assets\/[^"]+\.(?:js|css))"/g)].map(([, name]) => name);
  const others = (await readdir(path.join(folder, "assets"))).filter((name) => firstWorkers.test(name));
  for (const name of new Set([...named, ...others.map((other) => `assets/${other}`)])) {
    const file = path.join(folder, name);
    const bytes = await readFile(file);
    if (bytes.length >= minBytes)
      await writeFile(`${file}.br`, await brotli(bytes, constants.BROTLI_MAX_QUALITY));
  }
}

export function compressedAnswers() {
  return {
    name: "tetrafront:compressed-answers",
    ...whenWritten(compressFirstVisit),
    configurePreviewServer({ middlewares, config: { root, build, preview } }) {
      middlewares.use(compressedFiles(path.resolve(root, build.outDir), preview.headers));
    },
  };
}
