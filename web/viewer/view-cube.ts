/**
 * The cube in the corner of the view, as CSS transforms: its faces, edges and corners are flat elements around its middle. The
 * browser draws and hit-tests them, so that the cube costs the renderer nothing.
 */
import { Matrix4, Vector3, type Quaternion } from "three";
import type { Label } from "./apart";
import type { StandardView } from "./camera";

/** Size of the square around the cube and its distance from the top right corner of the view, in CSS pixels. */
const size = 92;
const offset = 10;
/** Distance of the faces from the middle, and half of their width: edges and corners are between them. In CSS pixels. */
const faceDistance = 29;
const halfFace = 22;

export type CubeFace = Exclude<StandardView, "isometric">;

export interface CubePiece {
  /** -1, 0 or 1 in each axis: the sides of the cube that it belongs to. */
  readonly direction: readonly [number, number, number];
  /** The face; null for an edge or corner. */
  readonly face: CubeFace | null;
  readonly kind: "face" | "edge" | "corner";
  readonly transform: string;
}

const axisFaces: readonly (readonly [negative: CubeFace, positive: CubeFace])[] = [
  ["left", "right"],
  ["front", "back"],
  ["bottom", "top"],
];

const css = ({ elements }: Matrix4): string => `matrix3d(${elements.join(",")})`;

/** The y axis of CSS points downwards. */
const downwards = new Matrix4().makeScale(1, -1, 1);

/** Edges are drawn as if they were horizontal, corners as if they were at the top. */
function turned([, , z]: CubePiece["direction"], sides: number): string {
  if (sides === 2 && z === 0) return " rotate(90deg)";
  return sides === 3 && z < 0 ? " rotate(180deg)" : "";
}

function cubePiece(direction: CubePiece["direction"]): CubePiece {
  const sides = direction.filter((side) => side !== 0).length;
  const axis = direction.findIndex((side) => side !== 0);
  const outward = new Vector3(...direction).normalize();
  const [x, y] = direction;
  const right = x === 0 && y === 0 ? new Vector3(1, 0, 0) : new Vector3(-y, x, 0).normalize();
  const up = new Vector3().crossVectors(outward, right);
  const middle = (faceDistance + (sides - 1) * halfFace) / Math.sqrt(sides);
  const matrix = new Matrix4().makeBasis(right, up, outward).multiply(downwards);
  return {
    direction,
    face: sides === 1 ? (axisFaces[axis]?.[direction[axis] === 1 ? 1 : 0] ?? null) : null,
    kind: sides === 1 ? "face" : sides === 2 ? "edge" : "corner",
    transform: css(matrix.setPosition(outward.multiplyScalar(middle))) + turned(direction, sides),
  };
}

const sides = [-1, 0, 1];

/** The six faces, twelve edges and eight corners of the cube. */
export const cubePieces: readonly CubePiece[] = sides
  .flatMap((x) => sides.flatMap((y) => sides.map((z) => [x, y, z] as const)))
  .filter((direction) => direction.some((side) => side !== 0))
  .map(cubePiece);

/** Returns the transform that turns the pieces as a camera sees the axes of the model. */
export const cubeTransform = (camera: Quaternion): string =>
  css(new Matrix4().makeRotationFromQuaternion(camera.clone().invert()).premultiply(downwards));

/** Returns the square that the cube covers in a view of a width. */
export const cubeArea = (width: number): Label => ({
  x: width - offset - size / 2,
  y: offset + size / 2,
  width: size,
  height: size,
});
