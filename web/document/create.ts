import type { LineType, PatchType, SourceType, Project } from "tetrafront/project";
import { type Entity, entityName, findRecord, recordsOf, type DrawnKind } from "./entities";
import { keepCoordinates } from "./expression-edits";
import { rangeAlong, smallestSize } from "./extent";
import { orderLoops } from "./loops";
import { likelyPatchType, patchMisfit } from "./patch-rules";
import { entityNouns, selectionHints, stepNames, untitled } from "../strings";
import type { ProjectEdit } from "./edit";
import type { Position } from "./position";
import { setMeshing } from "./size-edits";
import { cross, dot, length, subtract, zero } from "./vectors";

/** An edit that adds entities to the project, and the entities that it adds. */
export interface Creation {
  readonly edit: ProjectEdit;
  readonly entities: readonly Entity[];
  /** What the user should know about the result. */
  readonly note?: string;
}

/** What can be created from a selection, or why nothing can. */
export type Offer =
  | { readonly possible: true; readonly creation: Creation }
  | { readonly possible: false; readonly reason: string };

const refuse = (reason: string): Offer => ({ possible: false, reason });
const offer = (creation: Creation): Offer => ({ possible: true, creation });

/** Returns a project with nothing in it but a name. */
export function emptyProject(name: string = untitled): Project {
  const drawn = { points: [], lines: [], patches: [] };
  const background = { nodes: [], tetrahedra: [] };
  return { format: "tetrafront-project", version: 2, name, ...drawn, background };
}

/** Returns an id above all ids of a kind: an id is not reused while a higher one exists. */
export function nextId(project: Project, kind: DrawnKind): number {
  const highestOf = (of: DrawnKind): number =>
    recordsOf(project, of).reduce((highest, { id }) => Math.max(highest, id), 0);
  // Drawn patches and those of bodies have ids of their own.
  return Math.max(highestOf(kind), kind === "patch" ? highestOf("body-patch") : 0) + 1;
}

export const idsOf = (selection: readonly Entity[], of: DrawnKind): number[] =>
  selection.filter(({ kind }) => kind === of).map(({ id }) => id);

/** Adds a point. `expressions` are those from which its coordinates were computed; null for a coordinate without one. */
export function addPoint(
  project: Project,
  position: Position,
  expressions: readonly (string | null)[] = [],
): Creation {
  const id = nextId(project, "point");
  return {
    entities: [{ kind: "point", id }],
    edit: {
      label: stepNames.add(`${entityNouns.point} ${id}`),
      change: (draft) => {
        draft.project.points.push({ id, position: [...position] });
        keepCoordinates(draft.project, [{ id, expressions }]);
      },
    },
  };
}

export function addBackgroundNode(project: Project, position: Position, size: number): Creation {
  const id = nextId(project, "background-node");
  return {
    entities: [{ kind: "background-node", id }],
    edit: {
      label: stepNames.add(`${entityNouns["background-node"]} ${id}`),
      change: (draft) => {
        draft.project.background.nodes.push({ id, position: [...position], size });
      },
    },
  };
}

function addLines(project: Project, type: LineType, chains: readonly (readonly number[])[]): Creation {
  const first = nextId(project, "line");
  const lines = chains.map((points, index) => ({ id: first + index, type, points: [...points] }));
  const label =
    lines.length === 1 ? stepNames.add(`${entityNouns.line} ${first}`) : stepNames.addLines(lines.length);
  return {
    entities: lines.map(({ id }) => ({ kind: "line", id })),
    edit: {
      label,
      change: ({ project: draft }) => {
        draft.lines.push(...lines);
      },
    },
  };
}

/** Offers a closed spline through the selected points. */
export function offerClosedSpline(project: Project, selection: readonly Entity[]): Offer {
  const points = [...new Set(idsOf(selection, "point"))];
  const [first] = points;
  if (first === undefined || points.length < 3) return refuse(selectionHints.closedSpline);
  return offer(addLines(project, "spline", [[...points, first]]));
}

/**
 * Offers lines through the selected points, in the order of selection: straight lines from each point to the next, a
 * parabola, an arc or a circle through three points, or a spline through three or more.
 */
export function offerLine(project: Project, selection: readonly Entity[], type: LineType): Offer {
  const points = idsOf(selection, "point");
  switch (type) {
    case "straight":
      if (points.length < 2) return refuse(selectionHints.straightLine);
      return offer(
        addLines(
          project,
          type,
          points.slice(1).map((point, i) => [points[i] ?? point, point]),
        ),
      );
    case "parabolic":
      if (points.length !== 3) return refuse(selectionHints.parabola);
      return offer(addLines(project, type, [points]));
    case "arc":
      if (points.length !== 3) return refuse(selectionHints.arc);
      return offer(addLines(project, type, [points]));
    case "circle":
      if (points.length !== 3) return refuse(selectionHints.circle);
      return offer(addLines(project, type, [[...points, ...points.slice(0, 1)]]));
    case "spline":
      if (points.length < 3) return refuse(selectionHints.spline);
      return offer(addLines(project, type, [points]));
    case "hermite":
      if (points.length < 2) return refuse(selectionHints.straightLine);
      return offer(addLines(project, type, [points]));
  }
}

/** Offers a patch of a type, or of the most likely type, bounded by the selected lines. */
export function offerPatch(project: Project, selection: readonly Entity[], type: PatchType | null): Offer {
  const found = orderLoops(project, idsOf(selection, "line"));
  if (!found.success) return refuse(found.reason);
  const { loops } = found;
  const chosen = type ?? likelyPatchType(project, loops);
  const misfit = patchMisfit(project, chosen, loops);
  if (misfit !== null) return refuse(misfit);
  const id = nextId(project, "patch");
  return offer({
    entities: [{ kind: "patch", id }],
    edit: {
      label: stepNames.add(`${entityNouns.patch} ${id}`),
      change: ({ project: draft }) => {
        draft.patches.push({ id, type: chosen, loops: loops.map((loop) => [...loop]) });
      },
    },
  });
}

/** Offers the loops of the selected lines as holes of the selected patch. */
export function offerHole(project: Project, selection: readonly Entity[]): Offer {
  const [patchId, ...others] = idsOf(selection, "patch");
  const patch = patchId === undefined ? undefined : findRecord(project, "patch", patchId);
  if (!patch || others.length > 0 || patch.type === "loft") return refuse(selectionHints.hole);
  const found = orderLoops(project, idsOf(selection, "line"));
  if (!found.success) return refuse(found.reason);
  const loops = [...patch.loops, ...found.loops];
  const misfit = patchMisfit(project, patch.type, loops);
  if (misfit !== null) return refuse(misfit);
  const entity: Entity = { kind: "patch", id: patch.id };
  return offer({
    entities: [entity],
    edit: {
      label: stepNames.addHole(entityName(project, entity) ?? `${entityNouns.patch} ${patch.id}`),
      change: ({ project: draft }) => {
        const record = draft.patches.find(({ id }) => id === patch.id);
        if (record) record.loops = loops.map((loop) => [...loop]);
      },
    },
  });
}

/** Volume below which four positions count as coplanar, relative to the cube of their distance. */
const flatness = 1e-9;

/** Returns whether four positions span no volume. */
function isFlat([a = zero, b = a, c = a, d = a]: readonly Position[]): boolean {
  const [u, v, w] = [subtract(b, a), subtract(c, a), subtract(d, a)];
  return Math.abs(dot(cross(u, v), w)) <= flatness * Math.max(length(u), length(v), length(w)) ** 3;
}

/**
 * Offers a tetrahedron of the background grid with the four selected nodes. The first one replaces a uniform size, which would
 * leave the grid without effect.
 */
export function offerTetrahedron(project: Project, selection: readonly Entity[]): Offer {
  const nodes = idsOf(selection, "background-node");
  const [a, b, c, d] = nodes;
  if (nodes.length !== 4 || a === undefined || b === undefined || c === undefined || d === undefined) {
    return refuse(selectionHints.tetrahedron);
  }
  const corners = nodes.map((id) => findRecord(project, "background-node", id)?.position ?? zero);
  if (isFlat(corners)) return refuse(selectionHints.flatTetrahedron);
  const same = (other: readonly number[]): boolean => nodes.every((node) => other.includes(node));
  if (project.background.tetrahedra.some(same)) return refuse(selectionHints.sameTetrahedron);
  const replacesUniform = project.background.tetrahedra.length === 0 && project.meshing?.size !== undefined;
  return offer({
    entities: nodes.map((id) => ({ kind: "background-node", id })),
    edit: {
      label: stepNames.addTetrahedron,
      change: (draft) => {
        draft.project.background.tetrahedra.push([a, b, c, d]);
        if (replacesUniform) setMeshing("size", null).change(draft);
      },
    },
    ...(replacesUniform && { note: selectionHints.replacesUniform }),
  });
}

/** Number of corners of a source. */
export const cornersOf: { readonly [T in SourceType]: number } = { point: 1, segment: 2, triangle: 3 };
/** Size of a new source, relative to the smallest size in the grid; without a grid, to the extent of the model. */
const sourceShare = 0.5;
const extentShare = 0.025;
/** Distance of a new source, in elements of its size. */
const elementsAround = 2;

interface Box {
  readonly centre: Position;
  readonly extent: number;
}

function boxOf(project: Project): Box {
  const positioned = project.points.length > 0 ? project.points : project.background.nodes;
  if (positioned.length === 0) return { centre: [0, 0, 0], extent: 1 };
  const ranges = [0, 1, 2].map((axis) => rangeAlong(positioned, axis));
  const [x = 0, y = 0, z = 0] = ranges.map(([low, high]) => (low + high) / 2);
  return { centre: [x, y, z], extent: Math.max(...ranges.map(([low, high]) => high - low)) || 1 };
}

/** Returns the positions of selected points and background nodes, and of the ends of selected lines, in order. */
function selectedPositions(project: Project, selection: readonly Entity[]): Position[] {
  return selection.flatMap(({ kind, id }) => {
    switch (kind) {
      case "point":
      case "background-node": {
        const record = findRecord(project, kind, id);
        return record ? [record.position] : [];
      }
      case "line": {
        const points = findRecord(project, "line", id)?.points ?? [];
        return [points.at(0), points.at(-1)].flatMap((end) => {
          const point = findRecord(project, "point", end ?? 0);
          return point ? [point.position] : [];
        });
      }
      case "patch":
      case "body":
      case "body-patch":
      case "source":
        return [];
    }
  });
}

/** Adds a source at the selected positions, or in the middle of the model if their number does not fit. */
export function addSource(project: Project, selection: readonly Entity[], type: SourceType): Creation {
  const { centre, extent } = boxOf(project);
  const needed = cornersOf[type];
  const selected = selectedPositions(project, selection);
  const [x, y, z] = centre;
  const reach = extent / 10;
  const corners: readonly Position[] = [
    type === "point" ? centre : [x - reach, y, z],
    [x + reach, y, z],
    [x, y + reach, z],
  ];
  return addSourceAt(project, type, selected.length === needed ? selected : corners.slice(0, needed));
}

/** Adds a source with its corners at positions. Its size is smaller than those around it. */
export function addSourceAt(project: Project, type: SourceType, positions: readonly Position[]): Creation {
  const id = nextId(project, "source");
  const { extent } = boxOf(project);
  const smallest = smallestSize(project);
  const rough = smallest === undefined ? extentShare * extent : sourceShare * smallest;
  const size = Number(rough.toPrecision(2));
  const distance = Number((elementsAround * size).toPrecision(2));
  return {
    entities: [{ kind: "source", id }],
    edit: {
      label: stepNames.add(`${entityNouns.source} ${id}`),
      change: ({ project: draft }) => {
        draft.background.sources ??= [];
        draft.background.sources.push({
          id,
          type,
          positions: positions.map((position) => [...position]),
          size,
          distance,
        });
      },
    },
  };
}

/** Offers a source at the selected positions, if there is one for each of its corners. */
export function offerSource(project: Project, selection: readonly Entity[], type: SourceType): Offer {
  const needed = cornersOf[type];
  if (selectedPositions(project, selection).length === needed)
    return offer(addSource(project, selection, type));
  return refuse(selectionHints.source(needed));
}
