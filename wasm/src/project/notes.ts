/**
 * What a project notes about its entities for editors: groups, parameters, and the expressions from which numbers were
 * computed. Meshing ignores all of them.
 */
import * as v from "valibot";
import { LIMITS } from "../base/limits.js";
import { shown } from "../base/values.js";
import { objectWith } from "../calls/schemas.js";
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

/** Kinds of entities that a group may hold. A patch may be drawn or belong to a body. */
export const GROUP_KINDS = ["point", "line", "patch", "body", "source"] as const;

/** Kinds of entities whose numbers may have expressions. */
export const EXPRESSION_KINDS = ["point", "body", "background-node", "source"] as const;

type GroupKind = (typeof GROUP_KINDS)[number];
type ExpressionKind = (typeof EXPRESSION_KINDS)[number];

const REMESHING = "size|minSize|maxSize|tolerance|featureAngle|anglePerEdge|layers|dropDetails|growth";

/** Numbers of entities that may have an expression. */
const NUMBER_FIELDS: Readonly<Record<ExpressionKind, RegExp>> = {
  point: /^position\.[0-2]$/,
  body: new RegExp(`^(placement\\.(scale|position\\.[0-2]|rotation\\.[0-3])|remeshing\\.(${REMESHING}))$`),
  "background-node": /^(size|stretching|(position|direction)\.[0-2])$/,
  source: /^(size|distance|growth|positions\.[0-2]\.[0-2])$/,
};

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

export const expressionSchema = v.pipe(
  objectWith({
    kind: v.picklist(EXPRESSION_KINDS),
    id: reference,
    field: described(WORDS.expressionField, v.string()),
    expression: described(WORDS.expression, expression),
  }),
  v.readonly(),
);

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
  readonly bodies?: readonly { readonly id: number; readonly patches: Records }[] | undefined;
  readonly background: { readonly nodes: Records; readonly sources?: Sources | undefined };
  readonly groups?: readonly Group[] | undefined;
  readonly parameters?: readonly Parameter[] | undefined;
  readonly expressions?: readonly Expression[] | undefined;
}

/** Answers whether the notes of a project refer to something. */
export class Subjects {
  readonly #ids: Readonly<Record<GroupKind | ExpressionKind, ReadonlySet<number>>>;
  readonly #corners: ReadonlyMap<number, number>;

  constructor({ points, lines, patches, bodies = [], background: { nodes, sources = [] } }: Noted) {
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
  }

  has(kind: GroupKind | ExpressionKind, entity: number): boolean {
    return this.#ids[kind].has(entity);
  }

  /** Returns whether the entity, which exists, has the number. */
  hasNumber({ kind, id: entity, field }: Expression): boolean {
    if (!NUMBER_FIELDS[kind].test(field)) return false;
    const [list, corner] = field.split(".");
    return list !== "positions" || Number(corner) < (this.#corners.get(entity) ?? 0);
  }
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
    expressions.map(({ kind, id: entity, field }) => `${shown(field)} of ${kind} ${entity}`),
    (e, subject) => report(["expressions", e], `another expression also defines ${subject}`),
  );
  expressions.forEach((noted, e) => {
    const { kind, id: entity, field } = noted;
    if (!subjects.has(kind, entity)) {
      report(["expressions", e, "id"], `there is no ${kind} with the id ${entity}`);
    } else if (!subjects.hasNumber(noted)) {
      report(["expressions", e, "field"], `${kind} ${entity} has no number ${shown(field)}`);
    }
  });
}

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
