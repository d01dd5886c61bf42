/**
 * The project file (docs/FORMAT.md): one zod schema, and the types inferred from it. It settles the
 * structure: which keys, finite numbers no larger than the engine takes, unique ids, references that exist. Whether the
 * geometry makes sense (a size above zero, a loop that closes, a planar patch that is plane) is the engine's to say,
 * for a drawing that is still unfinished must be loadable.
 */
import * as z from "zod/mini";

import { shown } from "./argument-checks.js";
import { LIMITS } from "./limits.js";
import { WORDS } from "./project-words.js";

/** In the field `format` of every project file. */
export const PROJECT_FORMAT = "tetrafront-project";
/** Of the project file; readers take older ones too. */
export const PROJECT_VERSION = 1;

/** What is wrong with a value, of all that these schemas can find. For each check by itself: zod's settings are the page's. */
export function wordsFor(issue: z.core.$ZodRawIssue): string {
  switch (issue.code) {
    case "invalid_type":
      return `expected ${String(issue.expected)}, received ${shown(issue.input)}`;
    case "invalid_value":
      return `expected ${issue.values.length > 1 ? "one of " : ""}${issue.values.map(shown).join(", ")}`;
    case "too_small":
      return `expected ${issue.inclusive === true ? "at least" : "more than"} ${issue.minimum}${ITEMS[issue.origin] ?? ""}`;
    case "too_big":
      return `expected at most ${issue.maximum}${ITEMS[issue.origin] ?? ""}`;
    case "unrecognized_keys":
      return `there is no key ${issue.keys.map(shown).join(", ")}`;
    default:
      return "expected something else";
  }
}

const ITEMS: Readonly<Record<string, string>> = { array: " items" };

/** Says in the JSON Schema what a field means. */
function described<Schema extends z.ZodMiniType>(description: string, schema: Schema): Schema {
  z.globalRegistry.add(schema, { description });
  return schema;
}

const listOf = <Item extends z.ZodMiniType>(item: Item) => z.readonly(z.array(item));

/** What the engine would refuse without a word of the field. */
const upTo = (most: number) => z.number().check(z.maximum(most));

const id = described(WORDS.id, z.int().check(z.positive()));
const reference = z.int().check(z.positive());
const name = described(WORDS.name, z.optional(z.string()));
const triple = described(WORDS.place, z.readonly(z.tuple([z.number(), z.number(), z.number()])));

const pointSchema = z.readonly(z.strictObject({ id, name, at: triple }));

const lineSchema = z.readonly(
  z.strictObject({
    id,
    name,
    type: z.enum(["straight", "parabolic", "spline"]),
    points: described(WORDS.linePoints, z.readonly(z.array(reference).check(z.minLength(2)))),
  }),
);

const loopSchema = described(WORDS.loop, z.readonly(z.array(z.int()).check(z.minLength(1))));

const patchSchema = z.readonly(
  z.strictObject({
    id,
    name,
    type: described(
      WORDS.patchType,
      z.enum(["planar", "isoparametric-triangle", "serendipity", "barnhill-gregory-nielson", "coons"]),
    ),
    loops: described(WORDS.loops, z.readonly(z.array(loopSchema).check(z.minLength(1)))),
  }),
);

const backgroundNodeSchema = z.readonly(
  z.strictObject({
    id,
    at: triple,
    size: described(WORDS.nodeSize, upTo(LIMITS.length)),
    stretching: described(WORDS.stretching, z.optional(upTo(LIMITS.stretching))),
    direction: described(
      WORDS.direction,
      z.optional(z.readonly(z.tuple([z.number(), z.number(), z.number()]))),
    ),
  }),
);

const sourceSchema = z.readonly(
  z.strictObject({
    id,
    name,
    type: z.enum(["point", "segment", "triangle"]),
    places: described(WORDS.places, z.readonly(z.array(triple).check(z.minLength(1), z.maxLength(3)))),
    size: described(WORDS.sourceSize, upTo(LIMITS.length)),
    distance: described(WORDS.distance, z.optional(upTo(LIMITS.length))),
    growth: described(WORDS.growth, z.optional(upTo(LIMITS.growth))),
  }),
);

const backgroundSchema = z.readonly(
  z.strictObject({
    nodes: listOf(backgroundNodeSchema),
    tetrahedra: described(
      WORDS.tetrahedra,
      listOf(z.readonly(z.tuple([z.int(), z.int(), z.int(), z.int()]))),
    ),
    sources: described(WORDS.sources, z.optional(listOf(sourceSchema))),
    overhang: described(WORDS.overhang, z.optional(z.number().check(z.minimum(0)))),
  }),
);

const meshingSchema = z.readonly(
  z.strictObject({
    size: described(WORDS.size, z.optional(upTo(LIMITS.length))),
    gradation: described(WORDS.gradation, z.optional(upTo(LIMITS.gradation))),
    enclosed: described(WORDS.enclosed, z.optional(z.enum(["cavities", "regions"]))),
    order: described(WORDS.order, z.optional(z.enum(["layered", "smallest-first"]))),
    optimization: described(WORDS.optimization, z.optional(z.enum(["none", "fast", "default", "strive"]))),
  }),
);

const documentSchema = z.readonly(
  z.strictObject({
    $schema: described(WORDS.schema, z.optional(z.string())),
    format: z.literal(PROJECT_FORMAT),
    version: z.literal(PROJECT_VERSION),
    name: z.string(),
    description: z.optional(z.string()),
    units: described(WORDS.units, z.optional(z.string())),
    meshing: described(WORDS.meshing, z.optional(meshingSchema)),
    points: listOf(pointSchema),
    lines: listOf(lineSchema),
    patches: listOf(patchSchema),
    background: described(WORDS.background, z._default(backgroundSchema, { nodes: [], tetrahedra: [] })),
  }),
);

type Document = z.infer<typeof documentSchema>;
type Path = (string | number)[];
type Report = (path: Path, message: string) => void;

/** Corners of a source of each type. */
const PLACES: Readonly<Record<z.infer<typeof sourceSchema>["type"], number>> = {
  point: 1,
  segment: 2,
  triangle: 3,
};

/** Tells `report` about ids used twice, references that lead nowhere, and sources short of places. */
export function checkReferences(project: Document, report: Report): void {
  const points = uniqueIds(project.points, ["points"], "point", report);
  const lines = uniqueIds(project.lines, ["lines"], "line", report);
  uniqueIds(project.patches, ["patches"], "patch", report);
  const nodes = uniqueIds(project.background.nodes, ["background", "nodes"], "background node", report);
  const expect = (known: ReadonlySet<number>, kind: string, wanted: number, path: Path) => {
    if (!known.has(wanted)) report(path, `there is no ${kind} with the id ${wanted}`);
  };
  project.lines.forEach((line, l) =>
    line.points.forEach((point, i) => expect(points, "point", point, ["lines", l, "points", i])),
  );
  project.patches.forEach((patch, p) =>
    patch.loops.forEach((loop, k) =>
      loop.forEach((line, i) => expect(lines, "line", Math.abs(line), ["patches", p, "loops", k, i])),
    ),
  );
  project.background.tetrahedra.forEach((tetrahedron, t) =>
    tetrahedron.forEach((node, i) =>
      expect(nodes, "background node", node, ["background", "tetrahedra", t, i]),
    ),
  );
  checkSources(project.background.sources ?? [], report);
}

/** The library freezes even what it refuses, and typed arrays cannot be frozen: undefined, then. */
export function parsedSafely<T>(parse: () => T): T | undefined {
  try {
    return parse();
  } catch (failure) {
    if (failure instanceof TypeError) return undefined;
    throw failure;
  }
}
export const HOLDS_ARRAYS = "it holds typed arrays, as no project does";

/** What is wrong with a value that should be a list of sources, in a sentence; undefined if nothing. */
export function sourceProblem(sources: unknown): string | undefined {
  const parsed = parsedSafely(() => z.array(sourceSchema).safeParse(sources, { error: wordsFor }));
  if (parsed === undefined) return HOLDS_ARRAYS;
  const problems =
    parsed.error?.issues.map(({ path, message }) => `sources[${path.join("].")}: ${message}`) ?? [];
  if (parsed.success) checkSources(parsed.data, (_, message) => problems.push(message));
  return problems[0];
}

function checkSources(sources: readonly z.infer<typeof sourceSchema>[], report: Report): void {
  uniqueIds(sources, ["background", "sources"], "source", report);
  sources.forEach(({ type, places }, s) => {
    const wanted = PLACES[type];
    if (places.length === wanted) return;
    const noun = wanted === 1 ? "place" : "places";
    report(
      ["background", "sources", s, "places"],
      `a source of type "${type}" has ${wanted} ${noun}, here are ${places.length}`,
    );
  });
}

function uniqueIds(
  entities: readonly { readonly id: number }[],
  path: Path,
  kind: string,
  report: Report,
): ReadonlySet<number> {
  const seen = new Set<number>();
  entities.forEach((entity, index) => {
    if (seen.has(entity.id)) report([...path, index, "id"], `another ${kind} has the id ${entity.id} too`);
    seen.add(entity.id);
  });
  return seen;
}

/** The schema by which project files are checked, for those who check them themselves. */
export const projectSchema = documentSchema.check(
  z.superRefine<Document>((project, context) => {
    checkReferences(project, (path, message) => context.addIssue({ code: "custom", path, message }));
  }),
);
z.globalRegistry.add(projectSchema, {
  title: "Tetrafront project",
  description: "Points, lines, patches and a background grid",
});

/** What the app draws and saves: points, lines, patches, sizes. */
export type Project = z.infer<typeof projectSchema>;
/** A point and its place in model units. */
export type ProjectPoint = Project["points"][number];
/** A line and its points. */
export type ProjectLine = Project["lines"][number];
/** A patch and the loops of lines that bound it. */
export type ProjectPatch = Project["patches"][number];
/** The project's own settings; whoever meshes it may give others. */
export type ProjectMeshing = NonNullable<Project["meshing"]>;
/** The background grid of a project, with its sources. */
export type ProjectBackground = Project["background"];
/** A node of the background grid, with the sizes wanted there. */
export type ProjectBackgroundNode = ProjectBackground["nodes"][number];
/** A place around which elements are wanted no larger than size + growth max(0, r - distance). */
export type ProjectSource = NonNullable<ProjectBackground["sources"]>[number];
/** What a source surrounds: a point, a segment or a triangle. */
export type SourceType = ProjectSource["type"];
/** How a line runs through its points. */
export type LineType = ProjectLine["type"];
/** How a patch spans its lines. */
export type PatchType = ProjectPatch["type"];

/** The id of a point; positive, unique among points. */
export type PointId = number;
/** The id of a line; positive, unique among lines. */
export type LineId = number;
/** The id of a patch; positive, unique among patches. */
export type PatchId = number;
/** The id of a source; positive, unique among sources. */
export type SourceId = number;
