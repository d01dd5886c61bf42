/** Upgrades projects of earlier versions of the file to the current one (docs/FORMAT.md). */

/** Version of the project file that this package writes. */
export const PROJECT_VERSION = 2;

/** Step i upgrades version i + 1 to version i + 2. */
const STEPS: readonly ((project: JsonObject) => JsonObject)[] = [toVersion2];

type JsonObject = Readonly<Record<string, unknown>>;

/**
 * Returns the value upgraded to the current version if it is an object of an earlier version; otherwise the
 * value itself. Checks nothing: parts of unexpected form are kept, and the schema reports them. Does not
 * change its argument.
 */
export function upgraded(value: unknown): unknown {
  if (!isObject(value)) return value;
  const { version } = value;
  if (!isEarlier(version)) return value;
  return STEPS.slice(version - 1).reduce((project, step) => step(project), value);
}

function isEarlier(version: unknown): version is number {
  return Number.isInteger(version) && Number(version) >= 1 && Number(version) < PROJECT_VERSION;
}

/** Version 2 renamed `at`, `places`, `overhang`, `enclosed`, and the optimization `strive`. */
function toVersion2(project: JsonObject): JsonObject {
  const withPosition = (record: JsonObject) => renamed(record, "at", "position");
  const background = (grid: JsonObject) =>
    changed(renamed(grid, "overhang", "coverageMargin"), {
      nodes: (nodes) => changedItems(nodes, withPosition),
      sources: (sources) => changedItems(sources, (source) => renamed(source, "places", "positions")),
    });
  const meshing = (settings: JsonObject) =>
    changed(renamed(settings, "enclosed", "innerShells"), {
      optimization: (level) => (level === "strive" ? "thorough" : level),
    });
  return changed(project, {
    version: () => 2,
    points: (points) => changedItems(points, withPosition),
    background: (grid) => (isObject(grid) ? background(grid) : grid),
    meshing: (settings) => (isObject(settings) ? meshing(settings) : settings),
  });
}

/**
 * Returns the record with the key `from` renamed, in the same order; the record itself if it lacks `from` or
 * already has `to`.
 */
function renamed(record: JsonObject, from: string, to: string): JsonObject {
  if (!Object.hasOwn(record, from) || Object.hasOwn(record, to)) return record;
  return Object.fromEntries(Object.entries(record).map(([key, value]) => [key === from ? to : key, value]));
}

/** Returns a copy in which those of the named values that exist are changed. */
function changed(
  record: JsonObject,
  changes: Readonly<Record<string, (value: unknown) => unknown>>,
): JsonObject {
  return Object.fromEntries(
    Object.entries(record).map(([key, value]) => [key, changes[key]?.(value) ?? value]),
  );
}

function changedItems(list: unknown, change: (item: JsonObject) => JsonObject): unknown {
  return Array.isArray(list) ? list.map((item: unknown) => (isObject(item) ? change(item) : item)) : list;
}

function isObject(value: unknown): value is JsonObject {
  return typeof value === "object" && value !== null && !Array.isArray(value);
}
