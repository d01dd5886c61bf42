/** Checks with TypeDoc that every public name is documented and refers only to public names. */
import { execFile } from "node:child_process";
import path from "node:path";
import { fileURLToPath } from "node:url";
import { promisify } from "node:util";

import { expect, test } from "vitest";

const root = fileURLToPath(new URL("../../..", import.meta.url));

test("every public name is documented", async () => {
  const typedoc = path.join(root, "node_modules", "typedoc", "bin", "typedoc");
  const args = [typedoc, "--emit", "none", "--disableSources", "--logLevel", "Warn"];
  const { stdout, stderr } = await promisify(execFile)(process.execPath, args, { cwd: root });
  expect(`${stdout}${stderr}`).toBe("");
}, 600_000);
