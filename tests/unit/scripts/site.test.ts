import { spawnSync } from "node:child_process";
import { createHash } from "node:crypto";
import { mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { createServer } from "node:http";
import type { AddressInfo } from "node:net";
import { tmpdir } from "node:os";
import path from "node:path";
import { brotliCompressSync } from "node:zlib";
import { afterAll, describe, expect, it } from "vitest";
import { zipSync, strToU8 } from "fflate";
import { compressedFiles } from "../../../scripts/lib/compressed-answers.mjs";
import { packageFolder, noticesText } from "../../../scripts/lib/notices.mjs";
import { isChecksumError, pythonProgram } from "../../../scripts/lib/python.mjs";
import { withoutTextFunctions } from "../../../scripts/lib/site-embind.mjs";
import { siteFiles } from "../../../scripts/lib/site-offline.mjs";
import { withPolicy } from "../../../scripts/lib/site-policy.mjs";

const folder = mkdtempSync(path.join(tmpdir(), "tetrafront-site-"));
afterAll(() => rmSync(folder, { recursive: true }));

describe("the policy of a page", () => {
  const page = (body: string) => `<html><head><meta charset="utf-8" />${body}</head></html>`;

  it("permits the styles and scripts of the page by their hashes, and no others", () => {
    const html = withPolicy(page("<style>p { color: red }</style><script>run()</script>"));
    const hash = (text: string) => createHash("sha256").update(text).digest("base64");
    expect(html).toContain(`style-src 'self' 'sha256-${hash("p { color: red }")}'`);
    expect(html).toContain(`script-src 'self' 'wasm-unsafe-eval' 'sha256-${hash("run()")}'`);
    expect(html).not.toContain("unsafe-inline");
    expect(html.indexOf("Content-Security-Policy")).toBeLessThan(html.indexOf("<style>"));
  });

  it("is never left out", () => {
    expect(() => withPolicy("<html><head></head></html>")).toThrow("charset");
  });
});

describe("the files that are kept offline", () => {
  it("are all but maps and unused fonts; the version changes with the content", () => {
    const write = (name: string, text: string) => writeFileSync(path.join(folder, name), text);
    for (const name of [
      "index.html",
      "embed.html",
      "a.js",
      "a.js.map",
      "a.js.br",
      "f.woff",
      "f.woff2",
      "sw.js",
    ])
      write(name, name);
    const { version, files } = siteFiles(folder);
    expect(files.map(({ path: name }) => name).sort()).toEqual(["./", "./a.js", "./embed.html", "./f.woff2"]);
    const sha256 = createHash("sha256").update("a.js").digest("hex");
    expect(files.find(({ path: name }) => name === "./a.js")).toMatchObject({ sha256 });
    write("sw.js", "another");
    expect(siteFiles(folder).version).toBe(version);
    write("a.js", "another");
    expect(siteFiles(folder).version).not.toBe(version);
  });
});

describe("the preview server", () => {
  it("compresses text, and lets browsers keep files with a hash in their names", async () => {
    const text = "x = 1;\n".repeat(500);
    mkdirSync(path.join(folder, "site", "assets"), { recursive: true });
    for (const name of ["index.html", "assets/a-1.js"]) writeFileSync(path.join(folder, "site", name), text);
    writeFileSync(path.join(folder, "secret.js"), text);
    const answer = compressedFiles(path.join(folder, "site"), { "X-Own": "1" });
    const server = createServer((request, response) => {
      void answer(request, response, () => response.writeHead(404).end());
    });
    await new Promise<void>((resolve) => server.listen(0, "127.0.0.1", resolve));
    const { port } = server.address() as AddressInfo;
    const ask = (name: string, headers: Record<string, string> = {}) =>
      fetch(`http://127.0.0.1:${port}${name}`, { headers: { "Accept-Encoding": "gzip, br", ...headers } });
    try {
      const page = await ask("/");
      expect(await page.text()).toBe(text);
      expect(Object.fromEntries(page.headers)).toMatchObject({
        "content-encoding": "br",
        "content-type": "text/html; charset=utf-8",
        "cache-control": "no-cache",
        "x-own": "1",
      });
      expect(Number(page.headers.get("content-length"))).toBeLessThan(text.length / 10);
      const tag = page.headers.get("etag") ?? "";
      expect((await ask("/", { "If-None-Match": tag })).status).toBe(304);
      expect((await ask("/assets/a-1.js")).headers.get("cache-control")).toContain("immutable");
      expect((await ask("/", { "Accept-Encoding": "gzip" })).headers.get("content-encoding")).toBe("gzip");
      // The build's own copy of a file is sent as it is.
      writeFileSync(path.join(folder, "site", "assets", "b-2.js"), text);
      writeFileSync(path.join(folder, "site", "assets", "b-2.js.br"), brotliCompressSync("copy"));
      expect(await (await ask("/assets/b-2.js")).text()).toBe("copy");
      expect(await (await ask("/assets/b-2.js", { "Accept-Encoding": "gzip" })).text()).toBe(text);
      for (const elsewhere of [
        "/../secret.js",
        "/%2e%2e/secret.js",
        "/..%2fsecret.js",
        "/%E0%A4%A",
        "/none.js",
      ])
        expect((await ask(elsewhere)).status).toBe(404);
      expect((await ask("/", { "Accept-Encoding": "identity" })).status).toBe(404);
    } finally {
      server.close();
    }
  });
});

describe("the library of Boolean operations", () => {
  it("works where no text may become a function", () => {
    const library = path.resolve(import.meta.dirname, "../../../node_modules/manifold-3d");
    const script = path.join(folder, "manifold.mjs");
    writeFileSync(script, withoutTextFunctions(readFileSync(path.join(library, "manifold.js"), "utf8")));
    const wasm = JSON.stringify(path.join(library, "manifold.wasm"));
    const program = `
      import start from ${JSON.stringify(script)};
      const library = await start({ locateFile: () => ${wasm} });
      library.setup();
      const { Manifold } = library;
      const box = Manifold.cube([2, 2, 2]);
      const rest = box.subtract(Manifold.cube([1, 1, 1]));
      const { vertProperties, triVerts } = rest.getMesh();
      const again = new Manifold(new library.Mesh({ numProp: 3, vertProperties, triVerts }));
      const moved = again.warp((p) => { p[0] += 1; });
      console.log(rest.volume(), again.volume(), moved.boundingBox().min[0], Manifold.union([box, rest]).volume());
      try { again.subtract(); } catch (error) { console.log(error.name); }
    `;
    const args = ["--disallow-code-generation-from-strings", "--input-type=module", "-e", program];
    const { stdout, stderr } = spawnSync(process.execPath, args, { encoding: "utf8" });
    expect(stderr).toBe("");
    expect(stdout).toBe("7 7 1 8\nBindingError\n");
  });

  it("must be the version whose script is known", () => {
    expect(() => withoutTextFunctions("newFunc(Function,others)")).toThrow("site-embind.mjs");
  });
});

describe("the notices", () => {
  const root = path.resolve(import.meta.dirname, "../../..");
  const modules = [
    "three/build/three.core.js",
    "@mantine/core/esm/index.mjs",
    "react-remove-scroll-bar/dist/es2015/index.js",
  ].map((name) => path.join(root, "node_modules", name));

  it("name each package once, with version, licence and text", () => {
    const text = noticesText([...modules, ...modules, path.join(root, "web/main.tsx")], [], "This site");
    const { version } = JSON.parse(
      readFileSync(path.join(root, "node_modules/three/package.json"), "utf8"),
    ) as {
      readonly version: string;
    };
    expect(text.match(new RegExp(`^three ${version}$`, "gm"))).toHaveLength(1);
    expect(text).toContain(`  three ${version}: MIT`);
    expect(text).toMatch(/Copyright © 2010-\d+ three\.js authors/);
    // This package has no file with its licence.
    expect(text).toContain("Copyright (c) Anton Korzunov");
  });

  it("refuse a package without a licence", () => {
    const unknown = path.join(folder, "node_modules", "x");
    expect(packageFolder(path.join(unknown, "lib", "x.js"))).toBe(unknown);
    expect(packageFolder("\0virtual")).toBeUndefined();
    expect(() => noticesText([path.join(unknown, "x.js")], [], "This site")).toThrow();
  });
});

describe("the Python packages", () => {
  it("have checksums, and a package that differs is refused", () => {
    for (const name of ["python-fem", "python-gmsh"]) {
      const list = readFileSync(path.resolve(import.meta.dirname, `../../../scripts/${name}.txt`), "utf8");
      const pinned = list.match(/^[\w-]+==\S+/gm) ?? [];
      expect(pinned.length).toBeGreaterThan(0);
      expect(list.match(/^[\w-]+==[^\n]*\\\n {4}--hash=sha256:[0-9a-f]{64}/gm)).toHaveLength(pinned.length);
    }
    const wheel = path.join(folder, "tiny-1-py3-none-any.whl");
    const info = "tiny-1.dist-info";
    const files = {
      METADATA: "Metadata-Version: 2.1\nName: tiny\nVersion: 1\n",
      WHEEL: "Wheel-Version: 1.0\nRoot-Is-Purelib: true\nTag: py3-none-any\n",
      RECORD: "",
    };
    writeFileSync(
      wheel,
      zipSync(
        Object.fromEntries(Object.entries(files).map(([name, text]) => [`${info}/${name}`, strToU8(text)])),
      ),
    );
    const install = (hash: string) => {
      const list = path.join(folder, "list.txt");
      writeFileSync(list, `tiny @ file://${wheel} --hash=sha256:${hash}\n`);
      const args = [
        "-m",
        "pip",
        "install",
        "--no-index",
        "--no-deps",
        "--require-hashes",
        "--dry-run",
        "-r",
        list,
      ];
      const { status, stdout, stderr } = spawnSync(pythonProgram(), args, { encoding: "utf8" });
      return { status, output: stdout + stderr };
    };
    const right = createHash("sha256").update(readFileSync(wheel)).digest("hex");
    expect(install(right)).toMatchObject({ status: 0 });
    const wrong = install("0".repeat(64));
    expect(wrong.status).not.toBe(0);
    expect(isChecksumError(wrong.output)).toBe(true);
    expect(isChecksumError("Could not fetch URL: connection timed out")).toBe(false);
  });
});
