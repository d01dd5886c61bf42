/**
 * The project file (docs/FORMAT.md): one zod schema, and the types inferred from it. It settles the
 * structure: which keys, finite numbers, unique ids, references that exist. Whether the geometry makes
 * sense (a size above zero, a loop that closes, a planar patch that is plane) is the engine's to say,
 * for a drawing that is still unfinished must be loadable.
 */
import { z } from "zod";

export const PROJECT_FORMAT = "tetrafront-project";
export const PROJECT_VERSION = 1;

const id = z.int().positive().meta({ description: "Unique among its kind; a whole number above 0" });
const name = z.string().optional().meta({ description: "What the user calls it" });
const triple = z
  .tuple([z.number(), z.number(), z.number()])
  .readonly()
  .meta({ description: "x y z, in model units" });

const pointSchema = z.strictObject({ id, name, at: triple }).readonly();

const lineSchema = z
  .strictObject({
    id,
    name,
    type: z.enum(["straight", "parabolic", "spline"]),
    points: z.array(z.int().positive()).min(2).readonly().meta({
      description:
        "Point ids along the line: two; start, middle, end; or four and more, closed if it ends where it begins",
    }),
  })
  .readonly();

const loopSchema = z
  .array(z.int())
  .min(1)
  .readonly()
  .meta({ description: "Line ids in walking order; a negative id walks that line backwards" });

const patchSchema = z
  .strictObject({
    id,
    name,
    type: z
      .enum(["planar", "isoparametric-triangle", "serendipity", "barnhill-gregory-nielson", "coons"])
      .meta({
        description: "Of barnhill-gregory-nielson, the loop's second line plays another role than the rest",
      }),
    loops: z.array(loopSchema).min(1).readonly().meta({ description: "The outer loop first, then holes" }),
  })
  .readonly();

const backgroundNodeSchema = z
  .strictObject({
    id,
    at: triple,
    size: z.number().meta({ description: "Wanted edge length, in model units, above 0" }),
    stretching: z
      .number()
      .optional()
      .meta({ description: "Length along `direction` divided by `size`, >= 1" }),
    direction: triple.optional().meta({ description: "Stretching direction; any length but 0" }),
  })
  .readonly();

const sourceSchema = z
  .strictObject({
    id,
    name,
    type: z.enum(["point", "segment", "triangle"]),
    places: z
      .array(triple)
      .min(1)
      .max(3)
      .readonly()
      .meta({ description: "Corners: one of a point, two of a segment, three of a triangle" }),
    size: z.number().meta({ description: "Wanted edge length there, in model units, above 0" }),
    distance: z
      .number()
      .optional()
      .meta({ description: "Up to this far away `size` holds too; 0 or more, 0 if not given" }),
    growth: z
      .number()
      .optional()
      .meta({ description: "Of the size per unit of distance beyond; 0 or more, 0.3 if not given" }),
  })
  .readonly();

const backgroundSchema = z
  .strictObject({
    nodes: z.array(backgroundNodeSchema).readonly(),
    tetrahedra: z
      .array(z.tuple([z.int(), z.int(), z.int(), z.int()]).readonly())
      .readonly()
      .meta({ description: "Four node ids each, in any orientation" }),
    sources: z
      .array(sourceSchema)
      .readonly()
      .optional()
      .meta({ description: "Places around which elements are wanted no larger than a size" }),
    overhang: z.number().min(0).optional().meta({
      description:
        "What this far outside still counts as covered, as a share of the nearest tetrahedron's longest edge",
    }),
  })
  .readonly();

const documentSchema = z
  .strictObject({
    $schema: z.string().optional().meta({ description: "For editors; not interpreted" }),
    format: z.literal(PROJECT_FORMAT),
    version: z.literal(PROJECT_VERSION),
    name: z.string(),
    description: z.string().optional(),
    units: z.string().optional().meta({ description: 'A label such as "mm"; nothing is converted' }),
    points: z.array(pointSchema).readonly(),
    lines: z.array(lineSchema).readonly(),
    patches: z.array(patchSchema).readonly(),
    background: backgroundSchema
      .default({ nodes: [], tetrahedra: [] })
      .meta({ description: "Coarse tetrahedra covering the model, with the wanted size at their nodes" }),
  })
  .readonly();

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

/** What is wrong with a value that should be a list of sources, in a sentence; undefined if nothing. */
export function sourceProblem(sources: unknown): string | undefined {
  const parsed = z.array(sourceSchema).safeParse(sources);
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

export const projectSchema = documentSchema
  .superRefine((project, context) => {
    checkReferences(project, (path, message) => context.addIssue({ code: "custom", path, message }));
  })
  .meta({ title: "Tetrafront project", description: "Points, lines, patches and a background grid" });

export type Project = z.infer<typeof projectSchema>;
export type ProjectPoint = Project["points"][number];
export type ProjectLine = Project["lines"][number];
export type ProjectPatch = Project["patches"][number];
export type ProjectBackground = Project["background"];
export type ProjectBackgroundNode = ProjectBackground["nodes"][number];
/** A place around which elements are wanted no larger than size + growth max(0, r - distance). */
export type ProjectSource = NonNullable<ProjectBackground["sources"]>[number];
export type SourceType = ProjectSource["type"];
export type LineType = ProjectLine["type"];
export type PatchType = ProjectPatch["type"];

export type PointId = number;
export type LineId = number;
export type PatchId = number;
export type SourceId = number;

/** The schema as JSON Schema (draft 2020-12), for editors and other programs. */
export function projectJsonSchema(): Record<string, unknown> {
  return z.toJSONSchema(projectSchema, { io: "input" });
}
