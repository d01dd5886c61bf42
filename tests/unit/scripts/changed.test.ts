/** Tests which suites `npm test -- changed` selects. */
import { expect, test } from "vitest";

import { suitesFor } from "../../../scripts/lib/changed.mjs";

const PACKAGE_TESTS = "tests/unit/package";

test.each([
  "cpp/include/tetrafront/options.h",
  "cpp/src/geom/coordinates.h",
  "wasm/constants.cpp",
  "wasm/js_types.h",
  "wasm/CMakeLists.txt",
])("a change of %s checks the types and the tests of the package", (file) => {
  const suites = suitesFor([file]);
  expect(suites.has("types")).toBe(true);
  expect(suites.get("unit")).toEqual([PACKAGE_TESTS]);
});

test("other files of the engine cannot change the types of the package", () => {
  const suites = suitesFor(["cpp/src/volume/front_advance.cpp"]);
  expect(suites.has("types")).toBe(false);
  expect(suites.get("unit")).toEqual(["tests/unit/package/native.test.ts"]);
});

test("a changed test runs alone", () => {
  const file = "tests/unit/web/format.test.ts";
  expect(suitesFor([file]).get("unit")).toEqual([file]);
});

test("without changes, no suite runs", () => {
  expect(suitesFor([]).size).toBe(0);
});
