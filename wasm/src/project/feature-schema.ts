/** The schema of the features of a solid. */
import * as v from "valibot";
import type { Feature } from "../cad/features/feature.js";
import { objectWith } from "../calls/schemas.js";
import {
  color,
  described,
  id,
  integer,
  listOf,
  name,
  number,
  reference,
  threeNumbers,
} from "./schema-parts.js";
import { WORDS } from "./words.js";

/** The features that a project stores. */
export type SolidFeature = Feature;

const isOff = v.optional(v.boolean());
const common = { id, name, isOff };
const piece = { ...common, operation: v.picklist(["new", "join", "cut", "intersect"]) };
const placement = { position: threeNumbers, axis: threeNumbers, x: v.optional(threeNumbers) };
const rotation = { position: threeNumbers, axis: threeNumbers, angle: number };
const names = listOf(v.string());
const features = v.optional(listOf(reference));

const curve = v.variant("kind", [
  objectWith({
    kind: v.literal("line"),
    points: v.pipe(v.strictTuple([threeNumbers, threeNumbers]), v.readonly()),
  }),
  objectWith({
    kind: v.literal("arc"),
    points: v.pipe(v.strictTuple([threeNumbers, threeNumbers, threeNumbers]), v.readonly()),
  }),
  objectWith({
    kind: v.literal("spline"),
    points: listOf(threeNumbers),
    isClosed: v.optional(v.boolean()),
    isEven: v.optional(v.boolean()),
  }),
  objectWith({ kind: v.literal("circle"), center: threeNumbers, axis: threeNumbers, radius: number }),
  objectWith({
    kind: v.literal("three-point-circle"),
    points: v.pipe(v.strictTuple([threeNumbers, threeNumbers, threeNumbers]), v.readonly()),
  }),
]);
const loop = listOf(curve);
const profile = objectWith({ outer: loop, holes: v.optional(listOf(loop)) });

const turnedFace = objectWith({ ...rotation, curve });
const gridFace = objectWith({ grid: v.picklist(["square", "triangle"]), positions: v.string() });
const sewnFace = v.union([profile, turnedFace, gridFace]);
const looks = v.optional(listOf(objectWith({ name: v.optional(v.string()), color: v.optional(color) })));

/** The schema of one feature. */
export const featureSchema: v.GenericSchema<unknown, SolidFeature> = v.pipe(
  v.variant("type", [
    objectWith({ ...piece, ...placement, type: v.literal("box"), size: threeNumbers }),
    objectWith({ ...piece, ...placement, type: v.literal("cylinder"), radius: number, height: number }),
    objectWith({
      ...piece,
      ...placement,
      type: v.literal("cone"),
      radius: number,
      topRadius: number,
      height: number,
    }),
    objectWith({ ...piece, ...placement, type: v.literal("sphere"), radius: number }),
    objectWith({
      ...piece,
      ...placement,
      type: v.literal("torus"),
      majorRadius: number,
      minorRadius: number,
      angle: v.optional(number),
    }),
    objectWith({
      ...piece,
      ...placement,
      type: v.literal("prism"),
      sides: integer,
      radius: number,
      height: number,
    }),
    objectWith({ ...piece, ...placement, type: v.literal("wedge"), size: threeNumbers, topLength: number }),
    objectWith({ ...piece, type: v.literal("extrude"), profile, vector: threeNumbers }),
    objectWith({ ...piece, ...rotation, type: v.literal("revolve"), profile }),
    objectWith({
      ...piece,
      type: v.literal("loft"),
      sections: listOf(profile),
      isRuled: v.optional(v.boolean()),
    }),
    objectWith({ ...piece, type: v.literal("sweep"), profile, path: loop }),
    objectWith({ ...piece, type: v.literal("sew"), faces: listOf(sewnFace), looks }),
    objectWith({
      ...piece,
      type: v.literal("import"),
      brep: v.string(),
      looks,
    }),
    objectWith({ ...piece, type: v.literal("boolean"), tool: v.lazy(() => listOf(featureSchema)) }),
    objectWith({
      ...common,
      type: v.literal("hole"),
      position: threeNumbers,
      axis: threeNumbers,
      diameter: number,
      depth: v.optional(number),
      counterbore: v.optional(objectWith({ diameter: number, depth: number })),
      countersink: v.optional(objectWith({ diameter: number, angle: number })),
    }),
    objectWith({ ...common, type: v.literal("fillet"), edges: names, radius: number }),
    objectWith({ ...common, type: v.literal("chamfer"), edges: names, distance: number }),
    objectWith({ ...common, type: v.literal("shell"), openFaces: names, thickness: number }),
    objectWith({
      ...common,
      type: v.literal("move"),
      translation: v.optional(threeNumbers),
      rotation: v.optional(objectWith(rotation)),
    }),
    objectWith({
      ...common,
      type: v.literal("mirror"),
      position: threeNumbers,
      normal: threeNumbers,
      keepOriginal: v.optional(v.boolean()),
    }),
    objectWith({ ...common, type: v.literal("linear-array"), step: threeNumbers, count: integer, features }),
    objectWith({ ...common, ...rotation, type: v.literal("circular-array"), count: integer, features }),
  ]),
  v.readonly(),
);

/** What the schemas of several features have in common, for the schema that the package has as a file. */
export const sharedSchemas = { threeNumbers, curve, loop, profile, feature: featureSchema };

export const failuresSchema = listOf(
  v.pipe(objectWith({ feature: reference, message: v.string(), remedy: v.string() }), v.readonly()),
);

/** The features of a body; their ids must differ. */
export const featuresSchema = described(
  WORDS.features,
  v.pipe(
    listOf(featureSchema),
    v.check(
      (all) => new Set(all.map((feature) => feature.id)).size === all.length,
      "each feature needs an id of its own",
    ),
  ),
);
