/**
 * The schema of the project file (docs/FORMAT.md), whose types are in project-types.ts. It checks the structure:
 * known keys, finite numbers that the engine accepts, unique ids, valid references. The engine checks the geometry
 * (sizes above zero, closed loops, planar patches that are plane), because an unfinished project must be loadable.
 */
import * as v from "valibot";
import { LIMITS } from "../base/limits.js";
import { objectWith, parsedBy } from "../calls/schemas.js";
import { entityLabel } from "../diagnostics/entity-names.js";
import { failuresSchema, featuresSchema } from "./feature-schema.js";
import {
  FRONT_ORDERS,
  INNER_SHELLS,
  LINE_TYPES,
  MAX_LAYERS,
  MAX_REMESH_ANGLE,
  MESH_DEFAULTS,
  INTERIORS,
  OPTIMIZATIONS,
  PATCH_TYPES,
  REPAIR_KINDS,
  SOURCE_TYPES,
} from "../generated/constants.js";
import { checkBodyArrays } from "./body-arrays.js";
import { checkNotes, expressionSchema, groupSchema, parameterSchema, Subjects } from "./notes.js";
import { checkProblem, problemSchema } from "./problem-schema.js";
import {
  color,
  described,
  id,
  integer,
  listOf,
  name,
  number,
  type Path,
  reference,
  type Report,
  threeNumbers,
  uniqueIds,
  upTo,
} from "./schema-parts.js";
import {
  BODY_SURFACES,
  type Project,
  PROJECT_FORMAT,
  type ProjectBody,
  type ProjectSource,
} from "./project-types.js";
import { PROJECT_VERSION } from "./versions.js";
import { WORDS } from "./words.js";

const triple = described(WORDS.position, threeNumbers);

const pointSchema = v.pipe(objectWith({ id, name, position: triple }), v.readonly());

const lineSchema = v.pipe(
  objectWith({
    id,
    name,
    type: v.picklist(LINE_TYPES),
    points: described(WORDS.linePoints, v.pipe(v.array(reference), v.minLength(2), v.readonly())),
    startTangent: v.optional(described(WORDS.startTangent, threeNumbers)),
    endTangent: v.optional(described(WORDS.endTangent, threeNumbers)),
  }),
  v.readonly(),
);

const loopSchema = described(WORDS.loop, v.pipe(v.array(integer), v.minLength(1), v.readonly()));

const patchSchema = v.pipe(
  objectWith({
    id,
    name,
    type: described(WORDS.patchType, v.picklist(PATCH_TYPES)),
    loops: described(WORDS.loops, v.pipe(v.array(loopSchema), v.minLength(1), v.readonly())),
  }),
  v.readonly(),
);

const bodyPatchSchema = v.pipe(
  objectWith({
    id,
    name,
    color: v.optional(described(WORDS.patchColor, color)),
    solid: v.optional(described(WORDS.patchSolid, v.string())),
    origin: v.optional(described(WORDS.patchOrigin, v.string())),
  }),
  v.readonly(),
);

const remeshingSchema = v.pipe(
  objectWith({
    size: v.optional(described(WORDS.remeshSize, upTo(LIMITS.length))),
    minSize: v.optional(described(WORDS.minSize, upTo(LIMITS.length))),
    maxSize: v.optional(described(WORDS.maxSize, upTo(LIMITS.length))),
    tolerance: v.optional(described(WORDS.tolerance, upTo(LIMITS.length))),
    featureAngle: v.optional(described(WORDS.featureAngle, upTo(MAX_REMESH_ANGLE))),
    anglePerEdge: v.optional(described(WORDS.anglePerEdge, upTo(MAX_REMESH_ANGLE))),
    layers: v.optional(described(WORDS.layers, upTo(MAX_LAYERS))),
    dropDetails: v.optional(described(WORDS.dropDetails, upTo(LIMITS.length))),
    growth: v.optional(described(WORDS.remeshGrowth, upTo(LIMITS.growth))),
  }),
  v.readonly(),
);

/** Largest deviation of the norm of a rotation from 1. */
const UNIT_TOLERANCE = 1e-6;

const placementSchema = v.pipe(
  objectWith({
    position: v.optional(described(WORDS.bodyPosition, threeNumbers)),
    rotation: v.optional(
      described(
        WORDS.rotation,
        v.pipe(
          v.strictTuple([number, number, number, number]),
          v.check(
            (rotation) => Math.abs(Math.hypot(...rotation) - 1) <= UNIT_TOLERANCE,
            "expected a unit quaternion: the sum of its squares must be 1",
          ),
          v.readonly(),
        ),
      ),
    ),
    scale: v.optional(described(WORDS.scale, v.pipe(upTo(LIMITS.length), v.gtValue(0)))),
  }),
  v.readonly(),
);

const repairSchema = v.pipe(
  objectWith({
    kind: described(WORDS.repairKind, v.picklist(REPAIR_KINDS)),
    count: described(WORDS.repairCount, v.pipe(integer, v.gtValue(0))),
    positions: described(WORDS.repairPositions, listOf(threeNumbers)),
  }),
  v.readonly(),
);

/** The schema of a body, with checks of its arrays. */
export const bodySchema: v.GenericSchema<unknown, ProjectBody> = v.pipe(
  objectWith({
    id,
    name,
    points: described(WORDS.bodyPoints, v.string()),
    triangles: described(WORDS.bodyTriangles, v.string()),
    trianglePatch: v.optional(described(WORDS.trianglePatch, v.string())),
    trueFaces: v.optional(described(WORDS.trueFaces, v.string())),
    patches: described(WORDS.bodyPatches, v.pipe(v.array(bodyPatchSchema), v.minLength(1), v.readonly())),
    surface: v.optional(described(WORDS.bodySurface, v.picklist(BODY_SURFACES))),
    remeshing: v.optional(described(WORDS.remeshing, remeshingSchema)),
    placement: v.optional(described(WORDS.placement, placementSchema)),
    features: v.optional(featuresSchema),
    failures: v.optional(described(WORDS.failures, failuresSchema)),
    isOutdated: v.optional(described(WORDS.isOutdated, v.boolean())),
    repairs: v.optional(described(WORDS.repairs, listOf(repairSchema))),
    repairDeviation: v.optional(described(WORDS.repairDeviation, v.pipe(number, v.minValue(0)))),
  }),
  v.rawCheck(({ dataset, addIssue }) => {
    if (!dataset.typed) return;
    const { value } = dataset;
    checkBodyArrays(value, (field, problem) =>
      addIssue({ message: `${entityLabel("body", value)}: ${problem}`, path: pathItems(value, [field]) }),
    );
  }),
  v.readonly(),
);

const backgroundNodeSchema = v.pipe(
  objectWith({
    id,
    position: triple,
    size: described(WORDS.nodeSize, upTo(LIMITS.length)),
    stretching: v.optional(described(WORDS.stretching, upTo(LIMITS.stretching))),
    direction: v.optional(described(WORDS.direction, threeNumbers)),
    secondStretching: v.optional(described(WORDS.secondStretching, upTo(LIMITS.stretching))),
    secondDirection: v.optional(described(WORDS.secondDirection, threeNumbers)),
  }),
  v.readonly(),
);

const sourceSchema = v.pipe(
  objectWith({
    id,
    name,
    type: v.picklist(SOURCE_TYPES),
    positions: described(
      WORDS.positions,
      v.pipe(v.array(triple), v.minLength(1), v.maxLength(3), v.readonly()),
    ),
    size: described(WORDS.sourceSize, upTo(LIMITS.length)),
    distance: v.optional(described(WORDS.distance, upTo(LIMITS.length))),
    growth: v.optional(described(WORDS.growth, upTo(LIMITS.growth))),
    body: v.optional(described(WORDS.sourceBody, id)),
  }),
  v.readonly(),
);

const backgroundSchema = v.pipe(
  objectWith({
    nodes: listOf(backgroundNodeSchema),
    tetrahedra: described(
      WORDS.tetrahedra,
      listOf(v.pipe(v.strictTuple([integer, integer, integer, integer]), v.readonly())),
    ),
    sources: v.optional(described(WORDS.sources, listOf(sourceSchema))),
    coverageMargin: v.optional(described(WORDS.coverageMargin, v.pipe(number, v.minValue(0)))),
  }),
  v.readonly(),
);

const meshingSchema = v.pipe(
  objectWith({
    size: v.optional(described(WORDS.size, upTo(LIMITS.length))),
    elements: v.optional(
      described(WORDS.elements, v.pipe(integer, v.minValue(1), v.maxValue(MESH_DEFAULTS.maxTetrahedra))),
    ),
    gradation: v.optional(described(WORDS.gradation, upTo(LIMITS.gradation))),
    innerShells: v.optional(described(WORDS.innerShells, v.picklist(INNER_SHELLS))),
    order: v.optional(described(WORDS.order, v.picklist(FRONT_ORDERS))),
    optimization: v.optional(described(WORDS.optimization, v.picklist(OPTIMIZATIONS))),
    interior: v.optional(described(WORDS.interior, v.picklist(INTERIORS))),
  }),
  v.readonly(),
);

const documentSchema = v.pipe(
  objectWith({
    $schema: v.optional(described(WORDS.schema, v.string())),
    format: v.literal(PROJECT_FORMAT),
    version: v.literal(PROJECT_VERSION),
    name: v.string(),
    description: v.optional(v.string()),
    units: v.optional(described(WORDS.units, v.string())),
    meshing: v.optional(described(WORDS.meshing, meshingSchema)),
    points: listOf(pointSchema),
    lines: listOf(lineSchema),
    patches: listOf(patchSchema),
    bodies: v.optional(described(WORDS.bodies, listOf(bodySchema))),
    background: v.optional(described(WORDS.background, backgroundSchema), { nodes: [], tetrahedra: [] }),
    groups: v.optional(described(WORDS.groups, listOf(groupSchema))),
    parameters: v.optional(described(WORDS.parameters, listOf(parameterSchema))),
    expressions: v.optional(described(WORDS.expressions, listOf(expressionSchema))),
    problem: v.optional(described(WORDS.problem, problemSchema)),
  }),
  v.readonly(),
);

/** Both types are one: what the schema lets pass is a project, and each project passes it. */
type Same<A, B> = [A] extends [B] ? ([B] extends [A] ? A : never) : never;
type Document = Same<Project, v.InferOutput<typeof documentSchema>>;

/** Number of positions of a source of each type. */
const POSITIONS: Readonly<Record<ProjectSource["type"], number>> = {
  point: 1,
  segment: 2,
  triangle: 3,
};

/** Reports duplicate ids, references to missing entities, and sources with too few positions. */
export function checkReferences(project: Document, report: Report): void {
  const points = uniqueIds(project.points, ["points"], "point", report);
  const lines = uniqueIds(project.lines, ["lines"], "line", report);
  checkBodyIds(project, uniqueIds(project.patches, ["patches"], "patch", report), report);
  const nodes = uniqueIds(project.background.nodes, ["background", "nodes"], "background node", report);
  const expect = (known: ReadonlySet<number>, kind: string, entity: number, path: Path) => {
    if (!known.has(entity)) report(path, `there is no ${kind} with the id ${entity}`);
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
  checkNotes(project, report);
  const { problem } = project;
  if (problem === undefined) return;
  const subjects = new Subjects(project);
  checkProblem({ problem, hasPatch: (patch) => subjects.has("patch", patch) }, report);
}

/** Reports duplicate ids of bodies, and of patches among all patches. */
function checkBodyIds({ bodies = [] }: Document, drawn: ReadonlySet<number>, report: Report): void {
  uniqueIds(bodies, ["bodies"], "body", report);
  const patches = new Set(drawn);
  bodies.forEach((body, b) => uniqueIds(body.patches, ["bodies", b, "patches"], "patch", report, patches));
}

/** Describes what is wrong with a list of sources; undefined if it is valid. */
export function sourceProblem(sources: unknown): string | undefined {
  const parsed = parsedBy(v.array(sourceSchema), sources);
  if ("problems" in parsed)
    return parsed.problems.map(({ path, message }) => `sources${path}: ${message}`)[0];
  const problems: string[] = [];
  checkSources(parsed.value, (_, message) => problems.push(message));
  return problems[0];
}

function checkSources(sources: readonly ProjectSource[], report: Report): void {
  uniqueIds(sources, ["background", "sources"], "source", report);
  sources.forEach(({ type, positions }, s) => {
    const expected = POSITIONS[type];
    if (positions.length === expected) return;
    const noun = expected === 1 ? "position" : "positions";
    report(
      ["background", "sources", s, "positions"],
      `a source of type "${type}" needs ${expected} ${noun}, found ${positions.length}`,
    );
  });
}

/** The schema of project files. */
export const projectSchema: v.GenericSchema<unknown, Project> = v.pipe(
  documentSchema,
  v.rawCheck(({ dataset, addIssue }) => {
    if (!dataset.typed) return;
    const { value } = dataset;
    checkReferences(value, (path, message) => addIssue({ message, path: pathItems(value, path) }));
  }),
  v.title("Tetrafront project"),
  v.description("Points, lines, patches, bodies and a background grid"),
);

/** Returns the keys from `input` on with their values. */
function pathItems(input: unknown, keys: Path): [v.IssuePathItem, ...v.IssuePathItem[]] | undefined {
  let at = input as Readonly<Record<PropertyKey, unknown>>;
  const [first, ...rest] = keys.map((key): v.IssuePathItem => {
    const item = { type: "unknown", origin: "value", input: at, key, value: at[key] } as const;
    at = item.value as typeof at;
    return item;
  });
  return first && [first, ...rest];
}

/** Returns the project that a value holds, or its problems. */
export const parsedProject = (value: unknown) => parsedBy(projectSchema, value);
