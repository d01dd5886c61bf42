import { mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import os from "node:os";
import path from "node:path";
import { CompilerState, Extractor, ExtractorConfig } from "@microsoft/api-extractor";
import { inRoot } from "./paths.mjs";

/** Folder of the reports: what the package promises, so that a change of it shows in a diff. */
export const reportFolder = inRoot("docs", "api");
/** The entries of the package that are a promise; `tetrafront/internal` is none. */
export const promisedEntries = { tetrafront: "index", trace: "trace", project: "project", node: "node" };

const declarations = (name) => inRoot("wasm", "dist", `${promisedEntries[name]}.d.ts`);

/** The declarations of all entries, compiled once. */
let compiled;

function configOf(name, folder) {
  return ExtractorConfig.prepare({
    configObject: {
      projectFolder: inRoot("wasm"),
      mainEntryPointFilePath: declarations(name),
      compiler: { tsconfigFilePath: inRoot("wasm", "tsconfig.json") },
      apiReport: {
        enabled: true,
        reportFileName: `${name}.api.md`,
        reportFolder: folder,
        reportTempFolder: folder,
        // What the types of the first entry refer to is promised with them; the others share it.
        includeForgottenExports: name === "tetrafront",
      },
      docModel: { enabled: false },
      dtsRollup: { enabled: false },
      tsdocMetadata: { enabled: false },
      messages: {
        extractorMessageReporting: { default: { logLevel: "none" } },
        tsdocMessageReporting: { default: { logLevel: "none" } },
      },
    },
    configObjectFullPath: undefined,
    packageJsonFullPath: inRoot("wasm", "package.json"),
  });
}

/** Returns the report of an entry from the declarations of the built package. */
export function apiReport(name) {
  const folder = mkdtempSync(path.join(os.tmpdir(), "api-report-"));
  const config = configOf(name, folder);
  mkdirSync(folder, { recursive: true });
  const additionalEntryPoints = Object.keys(promisedEntries).map(declarations);
  compiled ??= CompilerState.create(config, { additionalEntryPoints });
  Extractor.invoke(config, {
    compilerState: compiled,
    localBuild: true,
    messageCallback: (message) => (message.handled = true),
  });
  const text = readFileSync(path.join(folder, `${name}.api.md`), "utf8").replaceAll("\r\n", "\n");
  rmSync(folder, { recursive: true });
  return text;
}

export function storeApiReports() {
  mkdirSync(reportFolder, { recursive: true });
  for (const name of Object.keys(promisedEntries)) {
    writeFileSync(path.join(reportFolder, `${name}.api.md`), apiReport(name));
  }
}
