import type { BodyPlacement, Project } from "tetrafront/project";
import type { Offer } from "../create";
import { nounOf } from "../draft-records";
import type { Entity } from "../entities";
import { combined, noRotation } from "../placement";
import type { Position } from "../position";
import { operationStrings, stepNames } from "../../strings";
import { determinant, keepsCircles, mapDirection, mapPosition, meanFactor, type Affine } from "./affine";
import { joinPoints, replacing } from "./join-points";
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
  { label, join }: TransformOptions,
): Offer {
  const parts = selectedParts(project, selection);
  if (!hasParts(parts)) return { possible: false, reason: texts.nothingSelected };
  if (parts.bodies.size > 0 && !map.similarity) return { possible: false, reason: texts.bodies };
  if (determinant(map) === 0) return { possible: false, reason: texts.flat };
  if (!keepsCircles(map) && parts.lines.some(({ type }) => type === "arc" || type === "circle"))
    return { possible: false, reason: texts.arcs };
  const images = hasExpressions(project, map) ? movedImages(project, parts) : [];
  const kept = mappedExpressions(project, images, map);
  const moved = movedProject(project, parts, map);
  const drawn = join && parts.points.length > 0 ? joinPoints(moved) : moved;
  const patches = new Set(drawn.patches.map(({ id }) => id));
  return {
    possible: true,
    creation: {
      entities: selection.filter(({ kind, id }) => kind !== "patch" || patches.has(id)),
      ...(kept === null && { note: operationStrings.numbersKept }),
      edit: {
        label,
        replace: [
          ...replacing(project, drawn),
          ...(parts.bodies.size > 0 ? [[["project", "bodies"], moved.bodies] as const] : []),
          ...(parts.nodes.size > 0
            ? [[["project", "background", "nodes"], moved.background.nodes] as const]
            : []),
          ...(parts.sources.size > 0
            ? [[["project", "background", "sources"], moved.background.sources] as const]
            : []),
          ...keptInstead(project, kept ?? forgotten(project, images)),
        ],
      },
    },
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

function movedProject(project: Project, parts: SelectedParts, map: Affine): Project {
  const pointIds = new Set(parts.points.map(({ id }) => id));
  const at = (position: Position): Position => mapPosition(map, position);
  const { background, bodies } = project;
  return {
    ...project,
    points: project.points.map((point) =>
      pointIds.has(point.id) ? { ...point, position: at(point.position) } : point,
    ),
    ...(bodies && {
      bodies: bodies.map((body) =>
        parts.bodies.has(body.id) ? { ...body, placement: movedPlacement(body.placement, map) } : body,
      ),
    }),
    background: { ...background, ...movedSizes(background, parts, map) },
  };
}

export function movedSizes({ nodes, sources }: Project["background"], parts: SelectedParts, map: Affine) {
  const factor = meanFactor(map);
  const at = (position: Position): Position => mapPosition(map, position);
  return {
    nodes: nodes.map((node) => {
      if (!parts.nodes.has(node.id)) return node;
      const direction = node.direction && { direction: mapDirection(map, node.direction) };
      return { ...node, position: at(node.position), size: node.size * factor, ...direction };
    }),
    ...(sources && {
      sources: sources.map((source) => {
        if (!parts.sources.has(source.id)) return source;
        const reach = source.distance !== undefined && { distance: source.distance * factor };
        return { ...source, positions: source.positions.map(at), size: source.size * factor, ...reach };
      }),
    }),
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
