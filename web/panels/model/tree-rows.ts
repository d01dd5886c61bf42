import type { Project } from "tetrafront";
import { drawnKinds, entityKey, recordsOf, type DrawnKind, type Entity } from "../../document/entities";
import { formatPosition, formatShort } from "../../ui/format";
import { entityWords, lineTypeNames, patchTypeNames, sourceTypeNames } from "../../strings";

/** A row of the model tree: the heading of a kind, or an entity. */
export type TreeRow =
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
      /** 1 for the first row of its group. */
      readonly ordinal: number;
      /** Number of rows in its group. */
      readonly siblings: number;
    };

/** Returns the key of a row: that of its entity, or the name of the kind. */
export const rowKey = (row: TreeRow): string => (row.type === "group" ? row.kind : entityKey(row.entity));

/** Returns the id of the element that shows the row with a key. */
export const rowElementId = (key: string): string => `row-${key}`;

function titleOf(kind: DrawnKind, id: number, name: string | undefined): string {
  return name ?? `${entityWords[kind].one} ${id}`;
}

/** The texts of an entity's row, and further words by which the filter finds it. */
interface Description {
  readonly title: string;
  readonly detail: () => string;
  readonly words: string;
}

/** Returns the texts of an entity, given its index in the project's list of its kind. */
function describe(project: Project, { kind, id }: Entity, index: number): Description {
  const named = (name: string | undefined, detail: () => string, words = ""): Description => ({
    title: titleOf(kind, id, name),
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
    case "background-node": {
      const { size = 0, stretching = 1 } = project.background.nodes[index] ?? {};
      const stretched = stretching === 1 ? "" : ` ×${formatShort(stretching)}`;
      return named(undefined, () => `δ ${formatShort(size)}${stretched}`, "node");
    }
    case "source": {
      const source = project.background.sources?.[index];
      return named(
        source?.name,
        () => `δ ${formatShort(source?.size ?? 0)}`,
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
  /** Indices in the project's list; null for all of them. */
  readonly matching: readonly number[] | null;
}

/**
 * The rows of the model tree. Each row is created on demand, because a background grid may have 100 000 nodes and only
 * a few rows are in sight. A filter opens every group and keeps the entities that contain its text.
 */
export class TreeRows {
  readonly length: number;
  readonly #project: Project;
  readonly #groups: readonly Group[];

  constructor(project: Project, filter: string, closed: ReadonlySet<DrawnKind>) {
    this.#project = project;
    const text = filter.trim().toLowerCase();
    const groups: Group[] = [];
    let first = 0;
    drawnKinds.forEach((kind, index) => {
      const total = recordsOf(project, kind).length;
      const open = text !== "" || !closed.has(kind);
      const matching = text === "" ? null : this.#matching(kind, text);
      if (matching?.length === 0) return;
      const heading = { type: "group", kind, total, open, ordinal: index + 1 } as const;
      const count = open ? (matching?.length ?? total) : 0;
      groups.push({ heading, first, count, matching });
      first += 1 + count;
    });
    this.#groups = groups;
    this.length = first;
  }

  at(index: number): TreeRow | undefined {
    const group = this.#groups.findLast(({ first }) => first <= index);
    if (!group || index > group.first + group.count || index < 0) return undefined;
    return index === group.first ? group.heading : this.#entityRow(group, index - group.first - 1);
  }

  slice(first: number, last: number): TreeRow[] {
    const rows = Array.from({ length: Math.max(0, last - first) }, (_, i) => this.at(first + i));
    return rows.filter((row) => row !== undefined);
  }

  /** Returns the index of the row with a key; -1 if there is none. Linear in the number of entities of its kind. */
  indexOf(key: string | null): number {
    for (const group of this.#groups) {
      const { kind } = group.heading;
      if (key === kind) return group.first;
      if (key === null || !key.startsWith(`${kind}-`)) continue;
      const id = Number(key.slice(kind.length + 1));
      const records = recordsOf(this.#project, kind);
      const offset = group.matching
        ? group.matching.findIndex((index) => records[index]?.id === id)
        : records.findIndex((record) => record.id === id);
      return offset < 0 || offset >= group.count ? -1 : group.first + 1 + offset;
    }
    return -1;
  }

  /** Returns the entities of a kind that are shown. */
  entitiesOf(kind: DrawnKind): Entity[] {
    const group = this.#groups.find(({ heading }) => heading.kind === kind);
    if (!group) return [];
    const records = recordsOf(this.#project, kind);
    return Array.from({ length: group.count }, (_, offset) => ({
      kind,
      id: records[group.matching?.[offset] ?? offset]?.id ?? 0,
    }));
  }

  #entityRow({ heading: { kind }, count, matching }: Group, offset: number): TreeRow {
    const index = matching?.[offset] ?? offset;
    const entity = { kind, id: recordsOf(this.#project, kind)[index]?.id ?? 0 };
    const { title, detail } = describe(this.#project, entity, index);
    return { type: "entity", entity, title, detail, ordinal: offset + 1, siblings: count };
  }

  #matching(kind: DrawnKind, text: string): number[] {
    const word = entityWords[kind].one;
    return recordsOf(this.#project, kind).flatMap(({ id }, index) => {
      const { title, detail, words } = describe(this.#project, { kind, id }, index);
      const isFound =
        `${title} ${word} ${id} ${words}`.toLowerCase().includes(text) ||
        detail().toLowerCase().includes(text);
      return isFound ? [index] : [];
    });
  }
}
