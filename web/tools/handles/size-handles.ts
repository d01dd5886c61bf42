import type { Project } from "tetrafront/project";
import { LIMITS } from "tetrafront";
import {
  rounded,
  setNodeShape,
  setSourceShape,
  shapeOfNode,
  shapeOfSource,
  type NodeShape,
  type SourceShape,
} from "../../document/grid-edits";
import type { ProjectEdit } from "../../document/edit";
import { findRecord, type Entity } from "../../document/entities";
import type { Position } from "../../document/position";
import type { DocumentStore } from "../../session/document-store";
import type { Glyph } from "../../viewer/layers/size-glyph-layer";
import { strings } from "../../strings";
import { formatPosition, formatShort } from "../../strings/format";
import { onGrid, type Grips } from "./grips";
import {
  add,
  cross,
  distance,
  type Frame,
  frameAlong,
  length,
  orthogonalTo,
  scale,
  subtract,
  unit,
} from "../../document/vectors";

/** What a handle changes: a corner of a source by its index, or a length. */
export type HandleRole = "size" | "direction" | "second direction" | "distance" | { readonly corner: number };

/** A place in the view that the user can drag. */
export interface Handle {
  readonly role: HandleRole;
  readonly position: Position;
  /** The handle changes how far it is from here; the position of a corner is free. */
  readonly from: Position;
}

/** A node or source whose handles are shown, at the moment when a drag begins. */
export type Handled =
  | { readonly kind: "node"; readonly id: number; readonly centre: Position; readonly shape: NodeShape }
  | { readonly kind: "source"; readonly id: number; readonly shape: SourceShape };

/** Smallest distance of a handle from its centre, in CSS pixels: beside the dot that moves the whole. */
const leastPixels = 26;
/** A stretching that is nearer to 1 becomes 1. */
const roundness = 1.03;

/** Returns the node or source that is the whole selection; null for any other selection. */
export function handledOf(project: Project, selection: readonly Entity[]): Handled | null {
  const [entity, ...others] = selection;
  if (!entity || others.length > 0) return null;
  if (entity.kind === "background-node") {
    const node = findRecord(project, "background-node", entity.id);
    return node ? { kind: "node", id: node.id, centre: node.position, shape: shapeOfNode(node) } : null;
  }
  if (entity.kind !== "source") return null;
  const source = findRecord(project, "source", entity.id);
  return source ? { kind: "source", id: source.id, shape: shapeOfSource(source) } : null;
}

/** Lengths of half a glyph: across, along its direction and along its second direction. */
const radiiOf = ({ size, stretching, secondStretching }: NodeShape) => ({
  across: size / 2,
  along: (size * stretching) / 2,
  second: (size * secondStretching) / 2,
});

/** Returns the frame of the handles of a node: z along its direction, y along the second one, if it has them. */
function frameOf({ direction, stretching, secondDirection, secondStretching }: NodeShape): Frame {
  if (!(secondStretching > 1)) return frameAlong(direction);
  const y = frameAlong(stretching > 1 ? orthogonalTo(direction, secondDirection) : secondDirection).z;
  const z = frameAlong(stretching > 1 ? direction : y)[stretching > 1 ? "z" : "x"];
  return { origin: [0, 0, 0], x: cross(y, z), y, z };
}

/** Returns the handles, in true size unless the glyph is smaller than they are. `pixel`: length of a CSS pixel. */
export function handlesOf(handled: Handled, pixel: number): readonly Handle[] {
  const least = leastPixels * pixel;
  if (handled.kind === "node") {
    const { centre, shape } = handled;
    const { across, along, second } = radiiOf(shape);
    const { x, y, z } = frameOf(shape);
    const at = (axis: Position, reach: number) => ({
      from: centre,
      position: add(centre, scale(axis, reach)),
    });
    const isStretched = shape.stretching > 1 || shape.secondStretching > 1;
    return [
      { role: "size", ...at(x, Math.max(across, least)) },
      { role: "direction", ...at(z, Math.max(along, 1.5 * least)) },
      // The first stretching of a ball has any direction.
      ...(isStretched
        ? [{ role: "second direction", ...at(y, Math.max(second, 1.25 * least)) } as const]
        : []),
    ];
  }
  const { positions, size, distance: reach } = handled.shape;
  const [first = [0, 0, 0] as const, second] = positions;
  const { x, y } = second ? frameAlong(subtract(second, first)) : { x: axisX, y: axisY };
  const corners = positions.map((position, corner) => ({ role: { corner }, from: position, position }));
  return [
    { role: "size", from: first, position: add(first, scale(x, Math.max(size / 2, least))) },
    { role: "distance", from: first, position: add(first, scale(y, Math.max(reach, 1.5 * least))) },
    ...(positions.length > 1 ? corners : []),
  ];
}

const axisX: Position = [1, 0, 0];
const axisY: Position = [0, 1, 0];

/** Returns the grips of the node or source that is the whole selection; null for any other selection. */
export function sizeGrips(
  documents: DocumentStore,
  selection: readonly Entity[],
  pixel: number,
): Grips | null {
  const handled = handledOf(documents.project, selection);
  if (!handled) return null;
  const handles = handlesOf(handled, pixel);
  return {
    glyphs: [glyphOf(handled)],
    grips: handles.map(({ role, from, position }) => ({
      from,
      position,
      moves: "view",
      label: labelOf(handled, role),
    })),
    begin: (index) => {
      const handle = handles[index];
      // A press must not end the preview of an operation.
      if (!handle || documents.state.getState().gestureStart !== null) return null;
      const gesture = documents.begin(draggedTo(handled, handle, handle.position).label);
      const isCorner = typeof handle.role === "object";
      return {
        moveTo: (to, step) =>
          gesture.update(draggedTo(handled, handle, isCorner ? onGrid(to, handle.position, step) : to)),
        commit: () => gesture.commit(),
        cancel: () => gesture.cancel(),
      };
    },
  };
}

function labelOf({ kind, shape }: Handled, role: HandleRole): string {
  const { inspector, drawing } = strings;
  if (role === "size") return drawing.grip(inspector.size, formatShort(shape.size));
  if (kind === "node") {
    const isFirst = role === "direction";
    const stretching = isFirst ? shape.stretching : shape.secondStretching;
    const direction = isFirst ? shape.direction : shape.secondDirection;
    const names = isFirst
      ? [inspector.stretching, inspector.direction]
      : [inspector.secondStretching, inspector.secondDirection];
    const [stretchingName = "", directionName = ""] = names;
    return `${drawing.grip(stretchingName, formatShort(stretching))}, ${drawing.grip(directionName, formatPosition(direction))}`;
  }
  const { positions } = shape;
  if (typeof role !== "object") return drawing.grip(inspector.distance, formatShort(shape.distance));
  const name = inspector.cornerPosition(role.corner, positions.length);
  return drawing.grip(name, formatPosition(positions[role.corner] ?? []));
}

/** Returns the ellipsoid of a node, with three half axes if it has a second stretching, or the sphere of the size of a source at its first corner. */
function glyphOf(handled: Handled): Glyph {
  if (handled.kind === "source") {
    const { positions, size } = handled.shape;
    const [centre = [0, 0, 0] as const] = positions;
    return { centre, axis: [0, 0, 1], across: size / 2, along: size / 2 };
  }
  const { centre, shape } = handled;
  const { across, along, second: alongSecond } = radiiOf(shape);
  const { direction, secondStretching, secondDirection } = shape;
  const second = secondStretching > 1 && { axis: secondDirection, along: alongSecond };
  if (!second) return { centre, axis: direction, across, along };
  // Without a first stretching, the second direction need not be orthogonal to the first.
  if (!(shape.stretching > 1)) return { centre, across, ...second };
  return { centre, axis: direction, across, along, second };
}

/** Returns the edit of a drag that moved a handle to a position. Lengths change by the same factor as their handle's. */
export function draggedTo(handled: Handled, { role, position, from }: Handle, to: Position): ProjectEdit {
  const factor = distance(to, from) / (distance(position, from) || 1);
  if (handled.kind === "node")
    return setNodeShape(handled.id, nodeDragged(handled.shape, role, factor, to, from));
  const { shape, id } = handled;
  if (typeof role === "object") {
    return setSourceShape(id, { ...shape, positions: shape.positions.with(role.corner, to) });
  }
  if (role === "size") return setSourceShape(id, { ...shape, size: lengthOf(shape.size * factor) });
  // Without a distance, its handle has no length of its own to scale.
  const reach = shape.distance > 0 ? shape.distance * factor : distance(to, from);
  return setSourceShape(id, { ...shape, distance: rounded(reach) });
}

function nodeDragged(
  shape: NodeShape,
  role: HandleRole,
  factor: number,
  to: Position,
  from: Position,
): NodeShape {
  // The ellipsoid grows as a whole.
  if (role === "size") return { ...shape, size: lengthOf(shape.size * factor) };
  const isSecond = role === "second direction";
  const asked = Math.min(LIMITS.stretching, (isSecond ? shape.secondStretching : shape.stretching) * factor);
  const stretching = asked < roundness ? 1 : rounded(asked);
  const given = unit(subtract(to, from));
  if (!isSecond) return { ...shape, stretching, direction: tidy(given ?? shape.direction) };
  return { ...shape, secondStretching: stretching, secondDirection: tidy(given ?? shape.secondDirection) };
}

const lengthOf = (value: number): number => Math.max(rounded(value), Number.MIN_VALUE);

/** Returns a direction with three decimals; that of an axis if it is nearly one. */
function tidy(direction: Position): Position {
  const axis = [axisX, axisY, [0, 0, 1] as Position].find((one) => length(cross(one, direction)) < 0.03);
  if (axis) return axis;
  return direction.map((x) => Math.round(1000 * x) / 1000) as [number, number, number];
}
