import type { Project, ProjectBody, ProjectSource } from "tetrafront/project";
import { operationStrings } from "../../strings";
import { nextId, type Offer } from "../create";
import { bodiesOf, entityKey, type Entity } from "../entities";
import { insertion, withInsertion, type Insertion } from "../insert-shape";
import { mapPoints, type Shape } from "../shape";
import type { KeptExpression } from "../expression-edits";
import { determinant, mapPosition, mapTangents, type Affine } from "./affine";
import { keptInstead, mappedExpressions, type Image } from "./mapped-expressions";
import { hasParts, selectedParts, shapeOf, type SelectedParts } from "./selected-parts";
import { movedPlacement, movedSource, type TransformOptions } from "./transform";

const texts = operationStrings.refusals;

/** Returns a shape after a map. A map that mirrors also reverses the loops, so that patches keep their outer side. */
export function mappedShape(shape: Shape, map: Affine): Shape {
  const placed = mapPoints(shape, (position) => mapPosition(map, position));
  const moved = { ...placed, lines: placed.lines.map((line) => mapTangents(map, line)) };
  if (determinant(map) > 0) return moved;
  const patches = moved.patches.map((patch) => ({
    ...patch,
    loops: patch.loops.map((loop) => loop.map((step) => -step).toReversed()),
  }));
  return { ...moved, patches };
}

/** Offers copies of the selected points, lines, patches, bodies and sources, one per map; the selection stays. */
export function offerCopies(
  project: Project,
  selection: readonly Entity[],
  maps: readonly Affine[],
  options: TransformOptions,
): Offer {
  return offerCopiesFrom(project, project, selection, maps, options);
}

/** Offers copies of selected parts of the same or another project. */
export function offerCopiesFrom(
  project: Project,
  from: Project,
  selection: readonly Entity[],
  maps: readonly Affine[],
  { label, join }: TransformOptions,
): Offer {
  const parts = selectedParts(from, selection);
  if (!hasParts({ ...parts, nodes: new Set() })) return { possible: false, reason: texts.nothingSelected };
  if (parts.bodies.size > 0 && maps.some(({ similarity }) => !similarity)) {
    return { possible: false, reason: texts.bodies };
  }
  const shape = shapeOf(parts);
  let lists = project;
  const entities: Entity[] = [];
  const kept: (readonly KeptExpression[] | null)[] = [];
  for (const map of maps) {
    const before = new Set(lists.points.map(({ id }) => id));
    const made = insertion(lists, mappedShape(shape, map), { join });
    entities.push(...copiedEntities(selection, parts, made));
    lists = { ...lists, ...withInsertion(lists, made) };
    const others = copiedOthers(lists, from, parts, map);
    entities.push(...others.entities);
    lists = { ...lists, ...others.lists };
    // Points that the model had keep their own expressions.
    const points = parts.points.flatMap(({ id }, index): Image[] => {
      const image = made.pointIds[index];
      return image === undefined || before.has(image) ? [] : [{ kind: "point", id, image }];
    });
    kept.push(mappedExpressions(from, [...points, ...others.images], map));
  }
  const isFollowing = kept.every((one) => one !== null);
  if (lists.points === project.points && lists.lines === project.lines && lists.patches === project.patches) {
    const hasOthers = lists.bodies !== project.bodies || lists.background !== project.background;
    if (!hasOthers) return { possible: false, reason: texts.allCoincide };
  }
  return {
    possible: true,
    creation: {
      entities: distinct(entities),
      ...(!isFollowing && { note: operationStrings.numbersKept }),
      edit: {
        label,
        replace: { ...lists, ...keptInstead(project, isFollowing ? kept.flat() : []) },
      },
    },
  };
}

/** Returns entities without repetitions: copies may share some. */
function distinct(entities: readonly Entity[]): Entity[] {
  return [...new Map(entities.map((entity) => [entityKey(entity), entity])).values()];
}

/** The copies of what was selected itself, of the drawn kinds. */
function copiedEntities(selection: readonly Entity[], parts: SelectedParts, made: Insertion): Entity[] {
  const copyOf = ({ kind, id }: Entity): Entity[] => {
    const isIt = (record: { readonly id: number }): boolean => record.id === id;
    const copy =
      kind === "point"
        ? made.pointIds[parts.points.findIndex(isIt)]
        : kind === "line"
          ? made.lineIds[parts.lines.findIndex(isIt)]
          : kind === "patch"
            ? made.patchIds[parts.patches.findIndex(isIt)]
            : undefined;
    return copy === undefined ? [] : [{ kind, id: Math.abs(copy) }];
  };
  return selection.flatMap(copyOf);
}

type Identified = { readonly id: number };

/** Copies of bodies and sources. */
function copiedOthers(project: Project, from: Project, parts: SelectedParts, map: Affine) {
  const bodies = copiedBodies(project, from, parts, map);
  const sources = copiedSources(project, from, parts, map, bodies);
  const copies = new Set(bodies.map(({ id }) => id));
  const ownSources = sources.filter(({ body }) => body === undefined || !copies.has(body));
  const chosen = (list: readonly Identified[] = [], ids: ReadonlySet<number>): readonly Identified[] =>
    list.filter(({ id }) => ids.has(id));
  const imagesOf = (
    kind: "body" | "source",
    of: readonly Identified[],
    made: readonly Identified[],
  ): Image[] => of.flatMap(({ id }, i) => (made[i] ? [{ kind, id, image: made[i].id }] : []));
  const images = [
    ...imagesOf("body", chosen(from.bodies, parts.bodies), bodies),
    // Sizes painted on a copied body follow it.
    ...imagesOf("source", chosen(from.background.sources, parts.sources), sources).filter(({ image }) =>
      ownSources.some(({ id }) => id === image),
    ),
  ];
  const { background } = project;
  return {
    entities: [
      ...bodies.map(({ id }): Entity => ({ kind: "body", id })),
      ...ownSources.map(({ id }): Entity => ({ kind: "source", id })),
    ],
    images,
    lists: {
      ...(bodies.length > 0 && { bodies: [...(project.bodies ?? []), ...bodies] }),
      ...(sources.length > 0 && {
        background: { ...background, sources: [...(background.sources ?? []), ...sources] },
      }),
    },
  };
}

function copiedBodies(project: Project, from: Project, { bodies }: SelectedParts, map: Affine) {
  const first = nextId(project, "body");
  let patch = nextId(project, "patch");
  return (from.bodies ?? [])
    .filter(({ id }) => bodies.has(id))
    .map((body, i) => ({
      ...body,
      id: first + i,
      placement: movedPlacement(body.placement, map),
      patches: body.patches.map((own) => ({ ...own, id: patch++ })),
    }));
}

/** Sizes painted on a copied body belong to its copy. Pasted into another project without the body, to none. */
function copiedSources(
  project: Project,
  from: Project,
  parts: SelectedParts,
  map: Affine,
  copies: readonly ProjectBody[],
): ProjectSource[] {
  const { sources } = parts;
  const first = nextId(project, "source");
  const originals = bodiesOf(from).filter(({ id }) => parts.bodies.has(id));
  const copyOf = new Map(originals.map(({ id }, i) => [id, copies[i]?.id]));
  return (from.background.sources ?? [])
    .filter(({ id }) => sources.has(id))
    .map((original, i) => {
      const { body: painted, ...source } = movedSource(original, map);
      const body = painted === undefined ? undefined : (copyOf.get(painted) ?? painted);
      const isKept = body !== undefined && (from === project || body !== painted);
      return { ...source, id: first + i, ...(isKept && { body }) };
    });
}
