/**
 * What a project notes about its entities for editors: groups, parameters, and the expressions from which numbers were
 * computed. Meshing ignores all of them.
 */
import * as v from "valibot";
import { LIMITS } from "../base/limits.js";
import { shown } from "../base/values.js";
import { objectWith } from "../calls/schemas.js";
import { EXPRESSION_KINDS, GROUP_KINDS } from "./project-types.js";
import {
  color,
  described,
  id,
  listOf,
  type Path,
  reference,
  type Report,
  uniqueIds,
} from "./schema-parts.js";
import { WORDS } from "./words.js";

type GroupKind = (typeof GROUP_KINDS)[number];
type ExpressionKind = (typeof EXPRESSION_KINDS)[number];

const REMESHING = "size|minSize|maxSize|tolerance|featureAngle|anglePerEdge|layers|dropDetails|growth";

/** A number of a feature of a body: `features.3.radius` of the feature with the id 3. */
const FEATURE_FIELD = /^features\.(\d+)\.(.+)$/;

/** Other numbers of entities that may have an expression. */
const NUMBER_FIELDS: Readonly<Record<ExpressionKind, RegExp>> = {
  point: /^position\.[0-2]$/,
  body: new RegExp(`^(placement\\.(scale|position\\.[0-2]|rotation\\.[0-3])|remeshing\\.(${REMESHING}))$`),
  "background-node": /^(size|stretching|secondStretching|(position|direction|secondDirection)\.[0-2])$/,
  source: /^(size|distance|growth|positions\.[0-2]\.[0-2])$/,
};

/** Numbers of the mesh settings that may have an expression. */
const MESHING_FIELDS = ["size"] as const;

/** Name of a parameter. */
const PARAMETER_NAME = /^[A-Za-z_][A-Za-z0-9_]*$/;

const expression = v.pipe(v.string(), v.regex(/\S/, "an expression"), v.maxLength(LIMITS.expression));

export const groupSchema = v.pipe(
  objectWith({
    id,
    name: described(WORDS.groupName, v.string()),
    color: v.optional(described(WORDS.groupColor, color)),
    members: described(
      WORDS.members,
      listOf(v.pipe(objectWith({ kind: v.picklist(GROUP_KINDS), id: reference }), v.readonly())),
    ),
  }),
  v.readonly(),
);

export const parameterSchema = v.pipe(
  objectWith({
    name: described(
      WORDS.parameterName,
      v.pipe(
        v.string(),
        v.regex(PARAMETER_NAME, "letters, digits and underscores, not beginning with a digit"),
      ),
    ),
    expression: described(WORDS.parameterExpression, expression),
  }),
  v.readonly(),
);

const ofEntity = objectWith({
  kind: v.picklist(EXPRESSION_KINDS),
  id: reference,
  field: described(WORDS.expressionField, v.string()),
  expression: described(WORDS.expression, expression),
});

const ofMeshing = objectWith({
  kind: v.literal("meshing"),
  field: described(WORDS.meshingField, v.picklist(MESHING_FIELDS)),
  expression: described(WORDS.expression, expression),
});

export const expressionSchema = v.pipe(v.variant("kind", [ofEntity, ofMeshing]), v.readonly());

type Group = v.InferOutput<typeof groupSchema>;
type Parameter = v.InferOutput<typeof parameterSchema>;
type Expression = v.InferOutput<typeof expressionSchema>;
type Records = readonly { readonly id: number }[];
type Sources = readonly { readonly id: number; readonly positions: readonly unknown[] }[];

/** The part of a project that its notes refer to. */
interface Noted {
  readonly points: Records;
  readonly lines: Records;
  readonly patches: Records;
  readonly bodies?:
    | readonly { readonly id: number; readonly patches: Records; readonly features?: Records | undefined }[]
    | undefined;
  readonly background: { readonly nodes: Records; readonly sources?: Sources | undefined };
  readonly groups?: readonly Group[] | undefined;
  readonly parameters?: readonly Parameter[] | undefined;
  readonly expressions?: readonly Expression[] | undefined;
  readonly meshing?: { readonly [Field in (typeof MESHING_FIELDS)[number]]?: number | undefined } | undefined;
}

/** Answers whether the notes of a project refer to something. */
export class Subjects {
  readonly #ids: Readonly<Record<GroupKind | ExpressionKind, ReadonlySet<number>>>;
  readonly #corners: ReadonlyMap<number, number>;
  readonly #features: ReadonlyMap<number, Records>;
  readonly #meshing: Noted["meshing"];

  constructor(project: Noted) {
    const { points, lines, patches, bodies = [], background, meshing } = project;
    const { nodes, sources = [] } = background;
    this.#meshing = meshing;
    const idsOf = (...lists: readonly Records[]) =>
      new Set(lists.flatMap((list) => list.map((one) => one.id)));
    this.#ids = {
      point: idsOf(points),
      line: idsOf(lines),
      patch: idsOf(patches, ...bodies.map((body) => body.patches)),
      body: idsOf(bodies),
      "background-node": idsOf(nodes),
      source: idsOf(sources),
    };
    this.#corners = new Map(sources.map((source) => [source.id, source.positions.length]));
    this.#features = new Map(
      bodies.flatMap(({ id: body, features }) => (features ? [[body, features]] : [])),
    );
  }

  has(kind: GroupKind | ExpressionKind, entity: number): boolean {
    return this.#ids[kind].has(entity);
  }

  /** Returns whether the subject of an expression exists: its entity, or the mesh settings. */
  hasSubject(noted: Expression): boolean {
    return noted.kind === "meshing" || this.has(noted.kind, noted.id);
  }

  /** Returns whether the subject, which exists, has the number. */
  hasNumber(noted: Expression): boolean {
    if (noted.kind === "meshing") return this.#meshing?.[noted.field] !== undefined;
    const { kind, id: entity, field } = noted;
    const [, feature, path] = (kind === "body" && FEATURE_FIELD.exec(field)) || [];
    if (path !== undefined) {
      const owner = this.#features.get(entity)?.find((one) => one.id === Number(feature));
      return !/(^|\.)id$/.test(path) && typeof valueAt(owner, path) === "number";
    }
    if (!NUMBER_FIELDS[kind].test(field)) return false;
    const [list, corner] = field.split(".");
    return list !== "positions" || Number(corner) < (this.#corners.get(entity) ?? 0);
  }
}

const isFeatureList = (value: unknown): value is Records =>
  Array.isArray(value) && value.every((one) => typeof one === "object" && one !== null && "id" in one);

/** Returns the value at a path of fields; of a list of features, the one with an id. */
function valueAt(record: unknown, path: string): unknown {
  return path.split(".").reduce<unknown>((at, key) => {
    if (isFeatureList(at)) return at.find(({ id: own }) => own === Number(key));
    const isHolder = typeof at === "object" && at !== null && Object.hasOwn(at, key);
    return isHolder ? (at as Readonly<Record<string, unknown>>)[key] : undefined;
  }, record);
}

/** Reports groups and expressions that refer to nothing, and whatever is noted twice. O(size). */
export function checkNotes(project: Noted, report: Report): void {
  const { groups = [], parameters = [], expressions = [] } = project;
  if (groups.length + parameters.length + expressions.length === 0) return;
  const subjects = new Subjects(project);
  uniqueIds(groups, ["groups"], "group", report);
  groups.forEach(({ members }, g) => checkMembers(members, subjects, ["groups", g, "members"], report));
  checkDistinct(
    parameters.map(({ name }) => name),
    (p, name) => report(["parameters", p, "name"], `another parameter also has the name "${name}"`),
  );
  checkDistinct(
    expressions.map((noted) => `${shown(noted.field)} of ${subjectOf(noted)}`),
    (e, subject) => report(["expressions", e], `another expression also defines ${subject}`),
  );
  expressions.forEach((noted, e) => {
    if (noted.kind !== "meshing" && !subjects.hasSubject(noted)) {
      report(["expressions", e, "id"], `there is no ${noted.kind} with the id ${noted.id}`);
    } else if (!subjects.hasNumber(noted)) {
      report(["expressions", e, "field"], `${subjectOf(noted)} has no number ${shown(noted.field)}`);
    }
  });
}

/** Names the subject of an expression in an error. */
const subjectOf = (noted: Expression): string =>
  noted.kind === "meshing" ? "meshing" : `${noted.kind} ${noted.id}`;

function checkMembers(members: Group["members"], subjects: Subjects, path: Path, report: Report): void {
  members.forEach(({ kind, id: member }, m) => {
    if (!subjects.has(kind, member)) report([...path, m], `there is no ${kind} with the id ${member}`);
  });
  checkDistinct(
    members.map(({ kind, id: member }) => `${kind} ${member}`),
    (m, member) => report([...path, m], `the group already has ${member}`),
  );
}

function checkDistinct(keys: readonly string[], onRepeated: (index: number, key: string) => void): void {
  const seen = new Set<string>();
  keys.forEach((key, index) => {
    if (seen.has(key)) onRepeated(index, key);
    seen.add(key);
  });
}
