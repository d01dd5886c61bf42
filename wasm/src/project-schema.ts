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
    points: z
      .array(z.int().positive())
      .min(2)
      .readonly()
      .meta({ description: "Point ids along the line: two; start, middle, end; or four and more" }),
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
    type: z.enum(["planar", "isoparametric-triangle", "serendipity", "barnhill-gregory-nielson", "coons"]),
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

const backgroundSchema = z
  .strictObject({
    nodes: z.array(backgroundNodeSchema).readonly(),
    tetrahedra: z
      .array(z.tuple([z.int(), z.int(), z.int(), z.int()]).readonly())
      .readonly()
      .meta({ description: "Four node ids each, in any orientation" }),
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

/** Reports what `report` is told about ids used twice and references that lead nowhere. */
export function checkReferences(
  project: Document,
  report: (path: (string | number)[], message: string) => void,
): void {
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
}

function uniqueIds(
  entities: readonly { readonly id: number }[],
  path: Path,
  kind: string,
  report: (path: Path, message: string) => void,
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
export type LineType = ProjectLine["type"];
export type PatchType = ProjectPatch["type"];

export type PointId = number;
export type LineId = number;
export type PatchId = number;

/** The schema as JSON Schema (draft 2020-12), for editors and other programs. */
export function projectJsonSchema(): Record<string, unknown> {
  return z.toJSONSchema(projectSchema, { io: "input" });
}
