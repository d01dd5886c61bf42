/** The longest times for CAD files and their library. */
import { readFileSync } from "node:fs";

import { expect, test } from "vitest";

import { askForCad, secondsFor } from "../../../wasm/dist/cad/cad-client.js";
import { failureOf } from "../../../wasm/dist/formats/cad.js";

test("a file is not called damaged if the library takes long to be loaded", async () => {
  const deflection = { distance: 0.1, isRelative: false, angle: 0.1 };
  const bytes = readFileSync(new URL("../../fixtures/plate.brep", import.meta.url));
  const reply = await askForCad({ format: "brep", bytes, deflection }, undefined, { loading: 0.001 });
  expect(reply).toEqual({ kind: "loading-timed-out", seconds: 0.001 });
  expect(failureOf({ kind: "loading-timed-out", seconds: 300 }, "step", bytes.length).error).toEqual({
    code: "missing-library",
    message: "STEP files need the library for CAD files, which could not be loaded within 300 s",
    remedy: "Check the connection, and read the file again.",
  });
});

test("larger files have more time, and small ones cannot keep their user waiting for minutes", () => {
  expect(secondsFor(1e8)).toBeGreaterThan(secondsFor(1e3));
  expect(secondsFor(4000)).toBeLessThan(60);
});
