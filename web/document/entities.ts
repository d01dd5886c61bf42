import type {
  Project,
  ProjectBackgroundNode,
  ProjectBody,
  ProjectBodyPatch,
  ProjectLine,
  ProjectPatch,
  ProjectPoint,
  ProjectSource,
} from "tetrafront/project";

/** Kinds of entities that the user draws or imports, and selects in tree, view and inspector. */
export type DrawnKind = "point" | "line" | "patch" | "body" | "body-patch" | "background-node" | "source";

/** One drawn entity, by its id in the project file. */
export interface Entity {
  readonly kind: DrawnKind;
  readonly id: number;
}

/** All kinds, in the order of the tree. */
export const drawnKinds: readonly DrawnKind[] = [
  "point",
  "line",
  "patch",
  "body",
  "body-patch",
  "background-node",
  "source",
];

/** A string that identifies the entity in sets, maps and test ids, e.g. "point-12". */
export function entityKey(entity: Entity): string {
  return `${entity.kind}-${entity.id}`;
}

export function sameEntity(a: Entity | null, b: Entity | null): boolean {
  return a === b || (a !== null && b !== null && a.kind === b.kind && a.id === b.id);
}

interface RecordOfKind {
  point: ProjectPoint;
  line: ProjectLine;
  patch: ProjectPatch;
  body: ProjectBody;
  "body-patch": ProjectBodyPatch;
  "background-node": ProjectBackgroundNode;
  source: ProjectSource;
}

const noSources: readonly ProjectSource[] = [];
const noBodies: readonly ProjectBody[] = [];

export function bodiesOf({ bodies = noBodies }: Project): readonly ProjectBody[] {
  return bodies;
}

/** The patches of lists of bodies, made once per list. */
const bodyPatches = new WeakMap<object, readonly ProjectBodyPatch[]>();

function bodyPatchesOf(project: Project): readonly ProjectBodyPatch[] {
  const bodies = bodiesOf(project);
  let patches = bodyPatches.get(bodies);
  if (!patches) {
    patches = bodies.flatMap((body) => body.patches);
    bodyPatches.set(bodies, patches);
  }
  return patches;
}

/** Returns the id of the body that an entity is or belongs to; null if there is none. */
export function bodyOfEntity(project: Project, { kind, id }: Entity): number | null {
  if (kind === "body") return id;
  return kind === "body-patch" ? (bodyOfPatch(project, id)?.id ?? null) : null;
}

/** Returns how sentences name a body. */
export const bodyLabel = ({ id, name }: ProjectBody): string => name ?? `body ${id}`;

/** Returns the body that a patch belongs to. */
export function bodyOfPatch(project: Project, patch: number): ProjectBody | undefined {
  return bodiesOf(project).find(({ patches }) => patches.some(({ id }) => id === patch));
}

/** Returns the body of an entity that is a patch of one; any other entity as it is. */
export function bodyForPatch(project: Project, entity: Entity): Entity {
  const body = entity.kind === "body-patch" ? bodyOfPatch(project, entity.id) : undefined;
  return body ? { kind: "body", id: body.id } : entity;
}

/** Returns a drawn patch or a patch of a body by its id: all patches have ids of their own. */
export function patchEntity(project: Project, id: number): Entity {
  return { kind: bodyOfPatch(project, id) ? "body-patch" : "patch", id };
}

/** Returns a patch by its index in a mesh: the drawn patches come first, then those of the bodies. */
export function patchAt(project: Project, index: number): Entity | undefined {
  const drawn = project.patches[index];
  if (drawn) return { kind: "patch", id: drawn.id };
  const ofBody = bodyPatchesOf(project)[index - project.patches.length];
  return ofBody && { kind: "body-patch", id: ofBody.id };
}

/** The project's records of one kind, in file order. */
export function recordsOf<K extends DrawnKind>(project: Project, kind: K): readonly RecordOfKind[K][] {
  const lists: { readonly [P in DrawnKind]: readonly RecordOfKind[P][] } = {
    point: project.points,
    line: project.lines,
    patch: project.patches,
    body: bodiesOf(project),
    "body-patch": bodyPatchesOf(project),
    "background-node": project.background.nodes,
    source: project.background.sources ?? noSources,
  };
  return lists[kind];
}

/** Returns whether the project has no entities. */
export function isEmptyProject(project: Project): boolean {
  return drawnKinds.every((kind) => recordsOf(project, kind).length === 0);
}

/** Returns the record of an entity, or undefined if the project has none. O(length of the list). */
export function findRecord<K extends DrawnKind>(
  project: Project,
  kind: K,
  id: number,
): RecordOfKind[K] | undefined {
  return recordsOf(project, kind).find((record) => record.id === id);
}

/** Returns those of the entities that a project has. O(records of their kinds + entities). */
export function existingIn(project: Project, entities: readonly Entity[]): readonly Entity[] {
  const ids = new Map<DrawnKind, ReadonlySet<number>>();
  const idsOf = (kind: DrawnKind): ReadonlySet<number> => {
    const known = ids.get(kind) ?? new Set(recordsOf(project, kind).map(({ id }) => id));
    ids.set(kind, known);
    return known;
  };
  return entities.filter(({ kind, id }) => idsOf(kind).has(id));
}

/** The user's own name of the entity, if it has one. */
export function entityName(project: Project, entity: Entity): string | undefined {
  const record = findRecord(project, entity.kind, entity.id);
  return record && "name" in record ? record.name : undefined;
}

/** Returns the entity that `entityKey` has named; undefined for another string. */
export function entityOfKey(key: string): Entity | undefined {
  const end = key.lastIndexOf("-");
  const kind = drawnKinds.find((one) => one === key.slice(0, end));
  return kind && { kind, id: Number(key.slice(end + 1)) };
}

/** Index of each id in its list: the engine addresses entities by index, the project file by id. */
export function indexById(project: Project, kind: DrawnKind): ReadonlyMap<number, number> {
  return new Map(recordsOf(project, kind).map((record, index) => [record.id, index]));
}

/** As `dependentsOf`, for many entities: indexes lists once, when the first entity that needs them is asked for. */
export function dependentFinder(project: Project): (entity: Entity) => readonly Entity[] {
  let lines: ReadonlyMap<number, readonly Entity[]> | undefined;
  let patches: ReadonlyMap<number, readonly Entity[]> | undefined;
  return ({ kind, id }) => {
    if (kind === "body") return paintedOn(project, id);
    if (kind === "point")
      return (lines ??= dependentsBy(project.lines, "line", (line) => line.points)).get(id) ?? [];
    if (kind !== "line") return [];
    patches ??= dependentsBy(project.patches, "patch", ({ loops }) => loops.flat().map(Math.abs));
    return patches.get(id) ?? [];
  };
}

/** Returns the entities of a list by the ids of what they are built on, in the order of the list. */
function dependentsBy<Item extends { readonly id: number }>(
  list: readonly Item[],
  kind: DrawnKind,
  basesOf: (item: Item) => readonly number[],
): ReadonlyMap<number, readonly Entity[]> {
  const found = new Map<number, Entity[]>();
  for (const item of list) {
    for (const base of new Set(basesOf(item))) {
      const dependents = found.get(base);
      if (dependents) dependents.push({ kind, id: item.id });
      else found.set(base, [{ kind, id: item.id }]);
    }
  }
  return found;
}

/** The sources painted on a body. */
function paintedOn({ background }: Project, body: number): Entity[] {
  const sources = background.sources ?? [];
  return sources.filter((source) => source.body === body).map(({ id }) => ({ kind: "source", id }));
}

/**
 * The entities built directly on this one: lines of a point, patches of a line, sizes painted on a body.
 * O(lines + patches + sources).
 */
export function dependentsOf(project: Project, entity: Entity): Entity[] {
  switch (entity.kind) {
    case "point":
      return project.lines
        .filter((line) => line.points.includes(entity.id))
        .map(({ id }) => ({ kind: "line", id }));
    case "line":
      return project.patches
        .filter((patch) => patch.loops.some((loop) => loop.some((step) => Math.abs(step) === entity.id)))
        .map(({ id }) => ({ kind: "patch", id }));
    case "body":
      return paintedOn(project, entity.id);
    case "patch":
    case "body-patch":
    case "background-node":
    case "source":
      return [];
  }
}
