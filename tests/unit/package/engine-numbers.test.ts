/** Constants and enums of the package equal those in the engine's headers. */
import { ENGINE_CODES, LIMITS } from "tetrafront";
import { expect, test } from "vitest";

import {
  COVER_SHAPES,
  DEFAULT_MAX_DIAGNOSTICS,
  FRONT_ORDERS,
  OPTIMIZATIONS,
} from "../../../wasm/src/api/options.js";
import { ENTITY_KINDS, SEVERITIES } from "../../../wasm/src/diagnostics/describe.js";
import { PHASES } from "../../../wasm/src/engine/run-clock.js";
import { STATUSES } from "../../../wasm/src/engine/slices.js";
import { LINE_TYPES, PATCH_TYPES } from "../../../wasm/src/project/arrays.js";
import { SOURCE_TYPES } from "../../../wasm/src/project/grid-arrays.js";
import { engineConstant, engineEnum } from "../../support/engine-enums.js";

const listed = (names: readonly (string | undefined)[]) => names.map((name, value) => [value, name]);
const swapped = (numbers: Readonly<Record<string, number>>) =>
  Object.entries(numbers).map(([name, value]) => [value, name]);

test("limits of options", () => {
  const options = "include/tetrafront/options.h";
  expect(LIMITS.growth).toBe(engineConstant(options, "kMaxGrowth"));
  expect(LIMITS.gradation).toBe(engineConstant(options, "kMaxGradation"));
  expect(LIMITS.stretching).toBe(engineConstant(options, "kMaxStretching"));
  // The engine computes with magnitudes up to a power of 2; the documented limit is the power of 10 below it.
  const largest = engineConstant("src/geom/coordinates.h", "kLargestCoordinate");
  expect(LIMITS.length).toBe(10 ** Math.floor(Math.log10(largest)));
});

test("default number of listed diagnostics", () => {
  expect(DEFAULT_MAX_DIAGNOSTICS).toBe(
    engineConstant("include/tetrafront/status.h", "kDefaultMaxDiagnostics"),
  );
});

test("diagnostic codes", () => {
  const ours = Object.entries(ENGINE_CODES).map(([value, name]) => [Number(value), name]);
  expect(ours).toEqual(engineEnum("status.h", "DiagnosticCode"));
});

test("entity kinds, severities and phases", () => {
  expect(listed(ENTITY_KINDS)).toEqual(engineEnum("status.h", "EntityKind"));
  expect(listed(SEVERITIES)).toEqual(engineEnum("status.h", "Severity"));
  expect(listed(PHASES)).toEqual(engineEnum("status.h", "Phase"));
});

test('statuses, except "running", which is internal', () => {
  expect(listed(STATUSES).map(([value, name]) => [value, name ?? "running"])).toEqual(
    engineEnum("status.h", "MeshStatus"),
  );
});

test("types of lines, patches, sources and covering grids, orders of the front and levels of optimization", () => {
  const lines = engineEnum("model.h", "LineType").map(([value, name]) => [value, name.replace("cubic-", "")]);
  expect(swapped(LINE_TYPES)).toEqual(lines);
  expect(swapped(PATCH_TYPES)).toEqual(engineEnum("model.h", "PatchType"));
  expect(swapped(SOURCE_TYPES)).toEqual(engineEnum("background_grid.h", "SourceType"));
  const shapes = engineEnum("covering_grid.h", "CoverShape").map(([value, name]) => [
    value,
    name.replace("single-", ""),
  ]);
  expect(swapped(COVER_SHAPES)).toEqual(shapes);
  expect(swapped(FRONT_ORDERS)).toEqual(engineEnum("options.h", "FrontOrder"));
  expect(swapped(OPTIMIZATIONS)).toEqual(engineEnum("options.h", "Optimization"));
});
