import type { Project } from "tetrafront";
import { drawnKinds, recordsOf, type DrawnKind, type Entity } from "../document/entities";
import { formatPlace, formatShort } from "../ui/format";
import { entityWords, lineTypeNames, patchTypeNames, sourceTypeNames } from "../ui/strings";

/** One line of the model tree: a heading for a kind, or an entity. */
export type TreeRow =
  | {
      readonly type: "group";
      readonly kind: DrawnKind;
      readonly total: number;
      readonly open: boolean;
      readonly position: number;
    }
  | {
      readonly type: "entity";
      readonly entity: Entity;
      readonly title: string;
      /** Told when the row is drawn: few of many are. */
      readonly detail: () => string;
      readonly position: number;
      readonly siblings: number;
    };

function titleOf(kind: DrawnKind, id: number, name: string | undefined): string {
  return name ?? `${entityWords[kind].one} ${id}`;
}

/** What the tree says of an entity, and the words that the filter finds it by besides. */
interface Description {
  readonly title: string;
  readonly detail: () => string;
  readonly words: string;
}

/** Of the entity at a position in the project's list of its kind. */
function describe(project: Project, { kind, id }: Entity, position: number): Description {
  const named = (name: string | undefined, detail: () => string, words = ""): Description => ({
    title: titleOf(kind, id, name),
    detail,
    words,
  });
  switch (kind) {
    case "point": {
      const point = project.points[position];
      return named(point?.name, () => (point ? formatPlace(point.position) : ""));
    }
    case "line": {
      const line = project.lines[position];
      const points = line?.points ?? [];
      const detail = () => (points.length > 3 ? `${points.length} points` : points.join("–"));
      return named(line?.name, detail, line && lineTypeNames[line.type]);
    }
    case "patch": {
      const patch = project.patches[position];
      return named(patch?.name, () => (patch ? patchTypeNames[patch.type] : ""));
    }
    case "background-node": {
      const { size = 0, stretching = 1 } = project.background.nodes[position] ?? {};
      const stretched = stretching === 1 ? "" : ` ×${formatShort(stretching)}`;
      return named(undefined, () => `δ ${formatShort(size)}${stretched}`, "node");
    }
    case "source": {
      const source = project.background.sources?.[position];
      return named(
        source?.name,
        () => `δ ${formatShort(source?.size ?? 0)}`,
        source && sourceTypeNames[source.type],
      );
    }
  }
}

/** A heading, and what of its kind is shown under it. */
interface Group {
  readonly heading: Extract<TreeRow, { type: "group" }>;
  /** Row of the heading. */
  readonly first: number;
  readonly count: number;
  /** Positions in the project's list; null for all of it. */
  readonly matching: readonly number[] | null;
}

/**
 * The rows to show, each made when it is asked for: a background grid may have a hundred thousand nodes, of
 * which few are in sight. A filter opens every group and keeps the entities with that text in them.
 */
export class TreeRows {
  readonly length: number;
  readonly #project: Project;
  readonly #groups: readonly Group[];

  constructor(project: Project, filter: string, closed: ReadonlySet<DrawnKind>) {
    this.#project = project;
    const wanted = filter.trim().toLowerCase();
    const groups: Group[] = [];
    let first = 0;
    drawnKinds.forEach((kind, position) => {
      const total = recordsOf(project, kind).length;
      const open = wanted !== "" || !closed.has(kind);
      const matching = wanted === "" ? null : this.#matching(kind, wanted);
      if (matching?.length === 0) return;
      const heading = { type: "group", kind, total, open, position: position + 1 } as const;
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

  /** Where the row of that key is; -1 if there is none. Linear in the list of its kind. */
  indexOf(key: string | null): number {
    for (const group of this.#groups) {
      const { kind } = group.heading;
      if (key === kind) return group.first;
      if (key === null || !key.startsWith(`${kind}-`)) continue;
      const id = Number(key.slice(kind.length + 1));
      const records = recordsOf(this.#project, kind);
      const place = group.matching
        ? group.matching.findIndex((position) => records[position]?.id === id)
        : records.findIndex((record) => record.id === id);
      return place < 0 || place >= group.count ? -1 : group.first + 1 + place;
    }
    return -1;
  }

  /** The entities of a kind that are shown. */
  entitiesOf(kind: DrawnKind): Entity[] {
    const group = this.#groups.find(({ heading }) => heading.kind === kind);
    if (!group) return [];
    const records = recordsOf(this.#project, kind);
    return Array.from({ length: group.count }, (_, place) => ({
      kind,
      id: records[group.matching?.[place] ?? place]?.id ?? 0,
    }));
  }

  #entityRow({ heading: { kind }, count, matching }: Group, place: number): TreeRow {
    const position = matching?.[place] ?? place;
    const entity = { kind, id: recordsOf(this.#project, kind)[position]?.id ?? 0 };
    const { title, detail } = describe(this.#project, entity, position);
    return { type: "entity", entity, title, detail, position: place + 1, siblings: count };
  }

  #matching(kind: DrawnKind, wanted: string): number[] {
    const word = entityWords[kind].one;
    return recordsOf(this.#project, kind).flatMap(({ id }, position) => {
      const { title, detail, words } = describe(this.#project, { kind, id }, position);
      const isFound =
        `${title} ${word} ${id} ${words}`.toLowerCase().includes(wanted) ||
        detail().toLowerCase().includes(wanted);
      return isFound ? [position] : [];
    });
  }
}
