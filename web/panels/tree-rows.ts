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

/** Title and detail of every entity of one kind, with the text that the filter searches. */
function describeAll(project: Project, kind: DrawnKind) {
  switch (kind) {
    case "point":
      return project.points.map(({ id, name, at }) => ({
        id,
        name,
        detail: () => formatPlace(at),
        words: "",
      }));
    case "line":
      return project.lines.map(({ id, name, type, points }) => ({
        id,
        name,
        detail: () => (points.length > 3 ? `${points.length} points` : points.join("–")),
        words: lineTypeNames[type],
      }));
    case "patch":
      return project.patches.map(({ id, name, type }) => ({
        id,
        name,
        detail: () => patchTypeNames[type],
        words: "",
      }));
    case "background-node":
      return project.background.nodes.map(({ id, size, stretching }) => ({
        id,
        name: undefined,
        detail: () =>
          `δ ${formatShort(size)}${stretching && stretching !== 1 ? ` ×${formatShort(stretching)}` : ""}`,
        words: "node",
      }));
    case "source":
      return recordsOf(project, kind).map(({ id, name, type, size }) => ({
        id,
        name,
        detail: () => `δ ${formatShort(size)}`,
        words: sourceTypeNames[type],
      }));
  }
}

/** The rows to show. A filter opens every group and keeps the entities with that text in them. */
export function treeRows(project: Project, filter: string, closed: ReadonlySet<DrawnKind>): TreeRow[] {
  const wanted = filter.trim().toLowerCase();
  const rows: TreeRow[] = [];
  drawnKinds.forEach((kind, position) => {
    const total = recordsOf(project, kind).length;
    const open = wanted !== "" || !closed.has(kind);
    if (!open) {
      // Nothing of a closed group is looked at: a background grid may have a hundred thousand nodes.
      rows.push({ type: "group", kind, total, open, position: position + 1 });
      return;
    }
    const matching = describeAll(project, kind)
      .map(({ id, name, detail, words }) => ({ id, detail, words, title: titleOf(kind, id, name) }))
      .filter(({ id, detail, words, title }) => {
        if (wanted === "") return true;
        const text = `${title} ${entityWords[kind].one} ${id} ${words}`.toLowerCase();
        return text.includes(wanted) || detail().toLowerCase().includes(wanted);
      });
    if (wanted !== "" && matching.length === 0) return;
    rows.push({ type: "group", kind, total, open, position: position + 1 });
    matching.forEach(({ id, title, detail }, index) =>
      rows.push({
        type: "entity",
        entity: { kind, id },
        title,
        detail,
        position: index + 1,
        siblings: matching.length,
      }),
    );
  });
  return rows;
}
