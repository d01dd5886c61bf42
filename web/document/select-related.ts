import type { Project } from "tetrafront/project";
import { linePaths } from "./line-paths";
import { drawnLoops, keyOf } from "./loop-search";
import type { ViewState } from "./selection";
import {
  bodiesOf,
  dependentsOf,
  entityKey,
  findRecord,
  recordsOf,
  type DrawnKind,
  type Entity,
} from "./entities";

const selectable: readonly DrawnKind[] = ["point", "line", "patch", "body"];

/** Returns all points, lines, patches and bodies. */
export function allEntities(project: Project): Entity[] {
  return selectable.flatMap((kind) => recordsOf(project, kind).map(({ id }): Entity => ({ kind, id })));
}

/** The layer of the view that shows a kind. */
export const layersOfKinds: { readonly [K in DrawnKind]: keyof ViewState["layers"] } = {
  point: "points",
  line: "lines",
  patch: "patches",
  body: "bodies",
  "body-patch": "bodies",
  "background-node": "background",
  source: "sources",
};

/** Returns the entities that the view shows. A hidden body hides its patches. */
export function shownAmong(
  project: Project,
  entities: readonly Entity[],
  { layers, hidden }: Pick<ViewState, "layers" | "hidden">,
): Entity[] {
  const hiddenBodies = bodiesOf(project).filter(({ id }) => hidden.has(entityKey({ kind: "body", id })));
  const hiddenPatches = new Set(hiddenBodies.flatMap(({ patches }) => patches.map(({ id }) => id)));
  return entities.filter(
    (entity) =>
      layers[layersOfKinds[entity.kind]] &&
      !hidden.has(entityKey(entity)) &&
      !(entity.kind === "body-patch" && hiddenPatches.has(entity.id)),
  );
}

/** Returns everything that is not selected, of the selected kinds; without a selection, everything. */
export function invertedSelection(project: Project, selection: readonly Entity[]): Entity[] {
  if (selection.length === 0) return allEntities(project);
  const selected = new Set(selection.map(entityKey));
  return sameKinds(project, selection).filter((entity) => !selected.has(entityKey(entity)));
}

/** Returns all entities of the selected kinds. */
export function sameKinds(project: Project, selection: readonly Entity[]): Entity[] {
  const kinds = [...new Set(selection.map(({ kind }) => kind))];
  return kinds.flatMap((kind) => recordsOf(project, kind).map(({ id }): Entity => ({ kind, id })));
}

/** Returns what an entity is built on: the lines of a patch, the points of a line. */
function partsOf(project: Project, { kind, id }: Entity): Entity[] {
  if (kind === "patch") {
    const lines = new Set((findRecord(project, "patch", id)?.loops ?? []).flat().map(Math.abs));
    return [...lines].map((line) => ({ kind: "line", id: line }));
  }
  const points = kind === "line" ? (findRecord(project, "line", id)?.points ?? []) : [];
  return [...new Set(points)].map((point) => ({ kind: "point", id: point }));
}

/** Returns the lines around the selected patches, and the points of the selected lines. */
export function boundaryOf(project: Project, selection: readonly Entity[]): Entity[] {
  return unique(selection.flatMap((entity) => partsOf(project, entity)));
}

/**
 * Returns the lines of the smallest loop that all selected lines belong to, the first selected line first; the selection if
 * there is none. If a whole loop is selected, returns the next one through its first line.
 */
export function loopAround(project: Project, selection: readonly Entity[]): Entity[] {
  const lines = selection.flatMap(({ kind, id }) => (kind === "line" ? [id] : []));
  const [first] = lines;
  if (first === undefined) return [...selection];
  const loops = drawnLoops(linePaths(project, null))
    .map((loop) => loop.lines.map(Math.abs))
    .filter((loop) => loop.includes(first))
    .toSorted((a, b) => a.length - b.length);
  const selected = loops.findIndex((loop) => keyOf(loop) === keyOf(lines));
  const found =
    selected >= 0
      ? loops[(selected + 1) % loops.length]
      : loops.find((loop) => lines.every((line) => loop.includes(line)));
  if (!found) return [...selection];
  const start = found.indexOf(first);
  return [...found.slice(start), ...found.slice(0, start)].map((id) => ({ kind: "line", id }));
}

/** Returns the selected entities with everything that they are built on. */
export function withParts(project: Project, selection: readonly Entity[]): Entity[] {
  return reached(selection, (entity) => partsOf(project, entity));
}

/** Returns everything that is connected with the selection by common points and lines. */
export function connectedTo(project: Project, selection: readonly Entity[]): Entity[] {
  return reached(selection, (entity) => [...partsOf(project, entity), ...dependentsOf(project, entity)]);
}

function reached(start: readonly Entity[], neighbours: (entity: Entity) => readonly Entity[]): Entity[] {
  const found = new Map<string, Entity>();
  const waiting = [...start];
  for (let entity = waiting.pop(); entity; entity = waiting.pop()) {
    if (found.has(entityKey(entity))) continue;
    found.set(entityKey(entity), entity);
    waiting.push(...neighbours(entity));
  }
  return [...found.values()];
}

const unique = (entities: readonly Entity[]): Entity[] => [
  ...new Map(entities.map((entity) => [entityKey(entity), entity])).values(),
];
