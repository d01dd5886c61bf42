import type { BodyPlacement, Project, ProjectBackgroundNode, ProjectSource } from "tetrafront/project";
import type { Offer } from "../create";
import { nounOf } from "../draft-records";
import { existingIn, type Entity } from "../entities";
import { combined, noRotation } from "../placement";
import { orthogonalTo } from "../vectors";
import { operationStrings, stepNames } from "../../strings";
import {
  determinant,
  keepsCircles,
  mapDirection,
  mapPosition,
  mapTangents,
  meanFactor,
  type Affine,
} from "./affine";
import { joinPoints } from "./join-points";
import { forgotten, hasExpressions, keptInstead, mappedExpressions, type Image } from "./mapped-expressions";
import { hasParts, selectedParts, type SelectedParts } from "./selected-parts";

const texts = operationStrings.refusals;

export interface TransformOptions {
  readonly label: string;
  /** Share points, lines and patches that coincide afterwards. */
  readonly join: boolean;
}

/** Returns the name of the step of undo for a change of a selection. */
export function transformStep(change: "move" | "rotate" | "scale", selection: readonly Entity[]): string {
  const [only, ...others] = selection;
  const isOne = only !== undefined && others.length === 0;
  return isOne ? stepNames[change](nounOf(only.kind, only.id)) : operationStrings.transforms[change].step;
}

/** Offers to transform the selected entities and all that they are built on. */
export function offerTransform(
  project: Project,
  selection: readonly Entity[],
  map: Affine,
  options: TransformOptions,
): Offer {
  return transformer(project, selection)(map, options);
}

/**
 * Returns a function that offers what `offerTransform` does, by one map after the other: what does not depend on the map is
 * found once. Without joining, an offer takes time for what it moves, and one copy of each changed list.
 */
export function transformer(
  project: Project,
  selection: readonly Entity[],
): (map: Affine, options: TransformOptions) => Offer {
  const parts = selectedParts(project, selection);
  const move = mover(project, parts);
  return (map, { label, join }) => {
    if (!hasParts(parts)) return { possible: false, reason: texts.nothingSelected };
    if (parts.bodies.size > 0 && !map.similarity) return { possible: false, reason: texts.bodies };
    if (determinant(map) === 0) return { possible: false, reason: texts.flat };
    if (!keepsCircles(map) && parts.lines.some(({ type }) => type === "arc" || type === "circle"))
      return { possible: false, reason: texts.arcs };
    const images = hasExpressions(project, map) ? movedImages(project, parts) : [];
    const kept = mappedExpressions(project, images, map);
    const changes = move(map);
    const moved = { ...project, ...changes };
    const { points, lines, patches } = join && parts.points.length > 0 ? joinPoints(moved) : moved;
    return {
      possible: true,
      creation: {
        entities:
          patches === project.patches
            ? selection
            : existingIn({ ...moved, points, lines, patches }, selection),
        ...(kept === null && { note: operationStrings.numbersKept }),
        edit: {
          label,
          replace: {
            ...changes,
            points,
            lines,
            patches,
            ...keptInstead(project, kept ?? forgotten(project, images)),
          },
        },
      },
    };
  };
}

/** Returns the entities of a selection as images of themselves. Sizes painted on a moved body follow it. */
function movedImages(
  { background }: Project,
  { points, bodies, nodes, sources }: SelectedParts,
): readonly Image[] {
  const own = (background.sources ?? []).filter(
    ({ id, body }) => sources.has(id) && (body === undefined || !bodies.has(body)),
  );
  const images = (kind: Image["kind"], ids: Iterable<number>): Image[] =>
    Array.from(ids, (id) => ({ kind, id, image: id }));
  return [
    ...images(
      "point",
      points.map(({ id }) => id),
    ),
    ...images("body", bodies),
    ...images("background-node", nodes),
    ...images(
      "source",
      own.map(({ id }) => id),
    ),
  ];
}

/** Returns a function that maps parts of a project: the places of the parts in its lists are found once. */
function mover({ points, lines, bodies = [], background }: Project, parts: SelectedParts) {
  const directed = parts.lines.filter(({ startTangent, endTangent }) => startTangent ?? endTangent);
  const changeLines = recordChanger(lines, new Set(directed.map(({ id }) => id)));
  const changePoints = recordChanger(points, new Set(parts.points.map(({ id }) => id)));
  const changeBodies = recordChanger(bodies, parts.bodies);
  const changeNodes = recordChanger(background.nodes, parts.nodes);
  const changeSources = recordChanger(background.sources ?? [], parts.sources);
  return (map: Affine): Partial<Project> => ({
    points: changePoints((point) => ({ ...point, position: mapPosition(map, point.position) })),
    ...(directed.length > 0 && { lines: changeLines((line) => mapTangents(map, line)) }),
    ...(parts.bodies.size > 0 && {
      bodies: changeBodies((body) => ({ ...body, placement: movedPlacement(body.placement, map) })),
    }),
    ...(parts.nodes.size + parts.sources.size > 0 && {
      background: {
        ...background,
        nodes: changeNodes((node) => movedNode(node, map)),
        ...(background.sources && { sources: changeSources((source) => movedSource(source, map)) }),
      },
    }),
  });
}

/** Returns a function that changes the records with some ids in copies of a list. Without such records it returns the list. */
function recordChanger<Item extends { readonly id: number }>(
  list: readonly Item[],
  ids: ReadonlySet<number>,
): (change: (item: Item) => Item) => readonly Item[] {
  const found = list.flatMap((item, index) => (ids.has(item.id) ? [[index, item] as const] : []));
  return (change) => {
    if (found.length === 0) return list;
    const changed = list.slice();
    for (const [index, item] of found) changed[index] = change(item);
    return changed;
  };
}

function movedNode(node: ProjectBackgroundNode, map: Affine): ProjectBackgroundNode {
  const direction = node.direction && { direction: mapDirection(map, node.direction) };
  // A scaling of one direction turns directions towards or away from each other.
  const second = node.secondDirection && {
    secondDirection: orthogonalTo(direction?.direction, mapDirection(map, node.secondDirection)),
  };
  const position = mapPosition(map, node.position);
  return { ...node, position, size: node.size * meanFactor(map), ...direction, ...second };
}

export function movedSource(source: ProjectSource, map: Affine): ProjectSource {
  const factor = meanFactor(map);
  return {
    ...source,
    positions: source.positions.map((position) => mapPosition(map, position)),
    size: source.size * factor,
    ...(source.distance !== undefined && { distance: source.distance * factor }),
  };
}

/** Maps that are not similarities leave placements unchanged: bodies cannot follow them. */
export function movedPlacement(placement: BodyPlacement = {}, map: Affine): BodyPlacement {
  if (!map.similarity) return placement;
  const { rotation, factor } = map.similarity;
  const { position = [0, 0, 0], rotation: before = noRotation, scale = 1 } = placement;
  return {
    position: mapPosition(map, position),
    rotation: combined(rotation, before),
    scale: scale * factor,
  };
}
