/** Brings what "Be the mesher" asks for into view: a question about a face that is hidden cannot be answered. */
import type { Trace } from "tetrafront/trace";
import type { Position } from "../../document/position";
import { addScaled, areaVector, distance, dot, mean, subtract, unit } from "../../document/vectors";
import type { Viewer } from "../../viewer/viewer";
import { cornersOf, positionOf } from "./judge";
import type { EdgeTask } from "./mesher-game";
import { endsOf } from "./planar-judge";
import { inSpace } from "./surface-scene";
import type { VolumeTask } from "./volume-game";

/** What is asked for appears at least this large, in pixels. */
const minExtent = 28;
/** Cosine of the largest angle between the view and the normal of a face that can be judged. */
const minFacing = 0.25;
/** How far the eye goes from the normal towards where it was: a face that is seen straight on hides its height. */
const aside = 0.6;

/** What is asked for, and everything that belongs to the choice. */
interface Asked {
  readonly subject: readonly Position[];
  readonly choices: readonly Position[];
  /** The side from which it must be seen; null for an edge, which is seen from everywhere. */
  readonly normal: Position | null;
}

/** Moves the camera unless the base face of a question is well seen, with the nodes to choose from. */
export function showAskedFace(trace: Trace, { question }: VolumeTask, viewer: Viewer): void {
  const subject = cornersOf(trace, question.step.face);
  const choices = [question.step.idealPoint, ...question.nodes.map((node) => positionOf(trace, node))];
  bringIntoView({ subject, choices, normal: unit(areaVector(subject)) }, viewer);
}

/** The same for the base edge of a patch. */
export function showAskedEdge({ question: { front, step, nodes } }: EdgeTask, viewer: Viewer): void {
  const subject = endsOf(front, step.edge).map((node) => inSpace(front, node));
  bringIntoView({ subject, choices: nodes.map((node) => inSpace(front, node)), normal: null }, viewer);
}

function bringIntoView(asked: Asked, viewer: Viewer): void {
  const isFacing = facing(asked, viewer.pose.eye) >= minFacing;
  if (isFacing && isInView(asked, viewer)) return;
  if (!isFacing && asked.normal) turnTo(asked.subject, asked.normal, viewer);
  viewer.framing.fitPositions([...asked.subject, ...asked.choices]);
}

/** Returns the cosine of the angle between the normal and the way to the eye; 1 without a normal. */
function facing({ subject, normal }: Asked, eye: Position): number {
  const toEye = unit(subtract(eye, mean(subject)));
  return normal && toEye ? dot(normal, toEye) : 1;
}

function isInView({ subject, choices }: Asked, viewer: Viewer): boolean {
  const { width, height, coveredLeft } = viewer.labelArea;
  const seen = [...subject, ...choices].map((position) => viewer.toScreen(position));
  const isInside = seen.every(
    (at) => at !== null && at.x >= coveredLeft && at.x <= width && at.y >= 0 && at.y <= height,
  );
  const corners = seen.slice(0, subject.length).flatMap((at) => (at ? [at] : []));
  const span = (of: (at: { readonly x: number; readonly y: number }) => number): number =>
    Math.max(...corners.map(of)) - Math.min(...corners.map(of));
  return (
    isInside &&
    Math.max(
      span(({ x }) => x),
      span(({ y }) => y),
    ) >= minExtent
  );
}

/** Looks at a face from its empty side, from a direction near the present one. */
function turnTo(subject: readonly Position[], normal: Position, viewer: Viewer): void {
  const { eye, target } = viewer.pose;
  const before = unit(subtract(eye, target)) ?? normal;
  // The part of the present direction that lies in the plane of the face.
  const along = unit(addScaled(before, normal, -dot(before, normal)));
  const direction = along ? addScaled(normal, along, aside) : normal;
  const centre = mean(subject);
  viewer.setPose({
    eye: addScaled(centre, unit(direction) ?? normal, distance(eye, target)),
    target: centre,
  });
}
