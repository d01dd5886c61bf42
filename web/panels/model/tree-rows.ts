import { isSolid } from "../../document/operations/solids";
import type { Project, ProjectGroup } from "tetrafront/project";
import {
  bodiesOf,
  bodyOfPatch,
  drawnKinds,
  entityKey,
  findRecord,
  recordsOf,
  sameEntity,
  type DrawnKind,
  type Entity,
} from "../../document/entities";
import { formatPosition, formatShort } from "../../strings/format";
import {
  defaultName,
  entityWords,
  lineTypeNames,
  patchTypeNames,
  sourceTypeNames,
  solidName,
  treatmentNames,
} from "../../strings";

/** The kinds that have a heading; the patches of bodies are below their bodies. */
export const headings = drawnKinds.filter((kind) => kind !== "body-patch");

/** A row of the model tree: the heading of a kind, an entity, the heading of the groups that the user made, or one of them. */
export type TreeRow =
  | {
      readonly type: "made-groups";
      readonly total: number;
      readonly open: boolean;
      readonly ordinal: 1;
    }
  | {
      readonly type: "made-group";
      readonly group: ProjectGroup;
      readonly ordinal: number;
      readonly siblings: number;
    }
  | {
      readonly type: "group";
      readonly kind: DrawnKind;
      readonly total: number;
      readonly open: boolean;
      /** 1 for the first row of its level. */
      readonly ordinal: number;
    }
  | {
      readonly type: "entity";
      readonly entity: Entity;
      readonly title: string;
      /** Returns the text on the right; a function, because only few rows are drawn. */
      readonly detail: () => string;
      /** 2 below a heading, 3 below an entity. */
      readonly level: 2 | 3;
      /** Whether the rows below this one are shown; null if there are none. */
      readonly open: boolean | null;
      /** 1 for the first row of its level. */
      readonly ordinal: number;
      /** Number of rows of its level. */
      readonly siblings: number;
    };

/** Key of the heading of the groups that the user made. */
export const madeGroupsKey = "groups";

const madeGroupKey = (id: number): string => `group-${id}`;

/** Returns the key of a row: that of its entity or group, or the name of the kind. */
export function rowKey(row: TreeRow): string {
  switch (row.type) {
    case "group":
      return row.kind;
    case "entity":
      return entityKey(row.entity);
    case "made-groups":
      return madeGroupsKey;
    case "made-group":
      return madeGroupKey(row.group.id);
  }
}

/** Returns the id of the element that shows the row with a key. */
export const rowElementId = (key: string): string => `row-${key}`;

/** The texts of an entity's row, and further words by which the filter finds it. */
interface Description {
  readonly title: string;
  readonly detail: () => string;
  readonly words: string;
}

/** Returns the texts of an entity, given its index in the project's list of its kind. */
function describe(project: Project, { kind, id }: Entity, index: number): Description {
  const named = (name: string | undefined, detail: () => string, words = ""): Description => ({
    title: name ?? defaultName(kind, id),
    detail,
    words,
  });
  switch (kind) {
    case "point": {
      const point = project.points[index];
      return named(point?.name, () => (point ? formatPosition(point.position) : ""));
    }
    case "line": {
      const line = project.lines[index];
      const points = line?.points ?? [];
      const detail = () => (points.length > 3 ? `${points.length} points` : points.join("–"));
      return named(line?.name, detail, line && lineTypeNames[line.type]);
    }
    case "patch": {
      const patch = project.patches[index];
      return named(patch?.name, () => (patch ? patchTypeNames[patch.type] : ""));
    }
    case "body": {
      const body = bodiesOf(project)[index];
      return named(body?.name, () =>
        body ? (isSolid(body) ? solidName : treatmentNames[body.surface ?? "remesh"]) : "",
      );
    }
    case "body-patch":
      return named(findRecord(project, "body-patch", id)?.name, () => "");
    case "background-node": {
      const { size = 0, stretching = 1, secondStretching = 1 } = project.background.nodes[index] ?? {};
      const stretched = [stretching, secondStretching]
        .map((times) => (times === 1 ? "" : ` ×${formatShort(times)}`))
        .join("");
      return named(undefined, () => `size ${formatShort(size)}${stretched}`, "node");
    }
    case "source": {
      const source = project.background.sources?.[index];
      return named(
        source?.name,
        () => `size ${formatShort(source?.size ?? 0)}`,
        source && sourceTypeNames[source.type],
      );
    }
  }
}

/** A heading and the entities shown under it. */
interface Group {
  readonly heading: Extract<TreeRow, { type: "group" }>;
  /** Row index of the heading. */
  readonly first: number;
  /** Number of entities shown under the heading. */
  readonly count: number;
  readonly entries: Entries;
}

/** The entities of a group in the order of their rows, made on demand. */
interface Entries {
  readonly count: number;
  at(offset: number): Extract<TreeRow, { type: "entity" }>;
  entityAt(offset: number): Entity;
  /** Returns the offset of an entity; -1 if it has no row. */
  indexOf(entity: Entity): number;
}

/**
 * The rows of the model tree. Each row is created on demand, because a background grid may have 100 000 nodes and only
 * a few rows are in sight. A filter opens every group and keeps the entities that contain its text.
 */
export class TreeRows {
  readonly length: number;
  readonly #project: Project;
  readonly #groups: readonly Group[];
  /** Rows of the groups that the user made, heading included: above all others. */
  readonly #made: readonly TreeRow[];

  /** `closed`: keys of the headings and entities whose rows below are not shown. */
  constructor(project: Project, filter: string, closed: ReadonlySet<string>) {
    this.#project = project;
    const text = filter.trim().toLowerCase();
    const groups: Group[] = [];
    this.#made = madeGroupRows(project, text, closed);
    const hasMade = project.groups !== undefined && project.groups.length > 0;
    let first = this.#made.length;
    headings.forEach((kind, index) => {
      const total = recordsOf(project, kind).length;
      const open = text !== "" || !closed.has(kind);
      const entries = kind === "body" ? this.#bodyEntries(text, closed) : this.#flatEntries(kind, text);
      if (text !== "" && entries.count === 0) return;
      const heading = { type: "group", kind, total, open, ordinal: index + (hasMade ? 2 : 1) } as const;
      const count = open ? entries.count : 0;
      groups.push({ heading, first, count, entries });
      first += 1 + count;
    });
    this.#groups = groups;
    this.length = first;
  }

  at(index: number): TreeRow | undefined {
    if (index < this.#made.length) return this.#made[index];
    const group = this.#groups.findLast(({ first }) => first <= index);
    if (!group || index > group.first + group.count || index < 0) return undefined;
    return index === group.first ? group.heading : group.entries.at(index - group.first - 1);
  }

  slice(first: number, last: number): TreeRow[] {
    const rows = Array.from({ length: Math.max(0, last - first) }, (_, i) => this.at(first + i));
    return rows.filter((row) => row !== undefined);
  }

  /** Returns the index of the row with a key; -1 if there is none. Linear in the number of entities of its kind. */
  indexOf(key: string | null): number {
    const made = this.#made.findIndex((row) => rowKey(row) === key);
    if (made >= 0) return made;
    const entity = key === null ? null : entityOfKey(key);
    for (const { heading, first, count, entries } of this.#groups) {
      if (key === heading.kind) return first;
      if (!entity || headingOf(entity.kind) !== heading.kind) continue;
      const offset = entries.indexOf(entity);
      return offset < 0 || offset >= count ? -1 : first + 1 + offset;
    }
    return -1;
  }

  /** Returns the entities of a kind that are shown. */
  entitiesOf(kind: DrawnKind): Entity[] {
    const group = this.#groups.find(({ heading }) => heading.kind === headingOf(kind));
    if (!group) return [];
    const shown = Array.from({ length: group.count }, (_, offset) => group.entries.entityAt(offset));
    return shown.filter((entity) => entity.kind === kind);
  }

  #flatEntries(kind: DrawnKind, text: string): Entries {
    const records = recordsOf(this.#project, kind);
    const matching = text === "" ? null : this.#matching(kind, text);
    const count = matching?.length ?? records.length;
    const indexAt = (offset: number): number => matching?.[offset] ?? offset;
    const entityAt = (offset: number): Entity => ({ kind, id: records[indexAt(offset)]?.id ?? 0 });
    return {
      count,
      entityAt,
      at: (offset) => {
        const index = indexAt(offset);
        const entity = entityAt(offset);
        const { title, detail } = describe(this.#project, entity, index);
        const position = { level: 2, open: null, ordinal: offset + 1, siblings: count } as const;
        return { type: "entity", entity, title, detail, ...position };
      },
      indexOf: ({ id }) =>
        matching
          ? matching.findIndex((index) => records[index]?.id === id)
          : records.findIndex((record) => record.id === id),
    };
  }

  /** The bodies, each followed by its patches. */
  #bodyEntries(text: string, closed: ReadonlySet<string>): Entries {
    const rows = bodiesOf(this.#project).flatMap((body, index, bodies) => {
      const entity: Entity = { kind: "body", id: body.id };
      const patches = body.patches
        .map(({ id }): Entity => ({ kind: "body-patch", id }))
        .filter((patch) => text === "" || this.#matches(patch, 0, text));
      const isShown = text === "" || patches.length > 0 || this.#matches(entity, index, text);
      if (!isShown) return [];
      const open = text !== "" || !closed.has(entityKey(entity));
      const { title, detail } = describe(this.#project, entity, index);
      const position = { level: 2, open, ordinal: index + 1, siblings: bodies.length } as const;
      return [
        { type: "entity", entity, title, detail, ...position } as const,
        ...(open ? patches : []).map((patch, p) => {
          const described = describe(this.#project, patch, p);
          const below = { level: 3, open: null, ordinal: p + 1, siblings: patches.length } as const;
          return { type: "entity", entity: patch, ...described, ...below } as const;
        }),
      ];
    });
    const at = (offset: number) => {
      const row = rows[offset];
      if (!row) throw new RangeError("There is no such row");
      return row;
    };
    return {
      count: rows.length,
      at,
      entityAt: (offset) => at(offset).entity,
      indexOf: (entity) => rows.findIndex((row) => sameEntity(row.entity, entity)),
    };
  }

  #matching(kind: DrawnKind, text: string): number[] {
    return recordsOf(this.#project, kind).flatMap(({ id }, index) =>
      this.#matches({ kind, id }, index, text) ? [index] : [],
    );
  }

  #matches(entity: Entity, index: number, text: string): boolean {
    const { title, detail, words } = describe(this.#project, entity, index);
    return (
      `${title} ${entityWords[entity.kind].one} ${entity.id} ${words}`.toLowerCase().includes(text) ||
      detail().toLowerCase().includes(text)
    );
  }
}

function madeGroupRows(
  { groups = [] }: Project,
  text: string,
  closed: ReadonlySet<string>,
): readonly TreeRow[] {
  const matching = groups.filter(({ name }) => name.toLowerCase().includes(text));
  if (matching.length === 0) return [];
  const open = text !== "" || !closed.has(madeGroupsKey);
  const rows = matching.map((group, index) => {
    return { type: "made-group", group, ordinal: index + 1, siblings: matching.length } as const;
  });
  return [{ type: "made-groups", total: groups.length, open, ordinal: 1 }, ...(open ? rows : [])];
}

/** Returns the kind of the heading above entities of a kind. */
export const headingOf = (kind: DrawnKind): DrawnKind => (kind === "body-patch" ? "body" : kind);

/** Returns the key of the row above an entity: that of its heading, or of the body of a patch. */
export function rowAbove(project: Project, { kind, id }: Entity): string {
  const body = kind === "body-patch" ? bodyOfPatch(project, id) : undefined;
  return body ? entityKey({ kind: "body", id: body.id }) : headingOf(kind);
}

function entityOfKey(key: string): Entity | null {
  const kind = drawnKinds.find((drawn) => key.slice(0, key.lastIndexOf("-")) === drawn);
  return kind ? { kind, id: Number(key.slice(kind.length + 1)) } : null;
}
