/**
 * What can be said about a pocket: which tetrahedra on its own corners fit into it, in how many ways they fill it, and from where
 * all of its faces are seen. All decisions are exact.
 */
import type { Position } from "../../../../document/position";
import { cross, dot, length, mean, subtract } from "../../../../document/vectors";
import { orientation } from "../../kit/orientation";

export type Face = readonly [number, number, number];
export type Element = readonly [number, number, number, number];
export type Pair = readonly [number, number];

/** Empty volume inside a front. The corners of a face are counter-clockwise as seen from the pocket. */
export interface Pocket {
  readonly corners: readonly Position[];
  readonly faces: readonly Face[];
}

/** A pair of corners without an edge, and where the straight line between them runs. */
export interface Diagonal {
  readonly ends: Pair;
  readonly run: "inside" | "outside" | "crossing";
}

/** A tetrahedron on four corners of a pocket. */
export interface Trial {
  /** Its corners, with a positive volume unless it is flat. */
  readonly element: Element;
  readonly verdict: "fits" | "flat" | "crosses" | "outside";
  /** Its edges that do not run inside. */
  readonly culprits: readonly Pair[];
}

const at = (pocket: Pocket, corner: number): Position => pocket.corners[corner] ?? [0, 0, 0];
const sign = (pocket: Pocket, [a, b, c]: Face, to: Position): number =>
  orientation(at(pocket, a), at(pocket, b), at(pocket, c), to);

/** Returns whether each face is seen from a position: whether this is strictly on the empty side of the face's plane. */
export function seenFrom(pocket: Pocket, position: Position): readonly boolean[] {
  return pocket.faces.map((face) => sign(pocket, face, position) > 0);
}

/** Returns the edges of a pocket, each once, the smaller corner first. */
export function edgesOf({ faces }: Pocket): readonly Pair[] {
  return faces.flatMap((face) =>
    face.flatMap((from, i): Pair[] => {
      const to = face[(i + 1) % 3] ?? 0;
      return from < to ? [[from, to]] : [];
    }),
  );
}

/** Returns the pairs of corners that no edge joins. O(corners² · faces). */
export function diagonalsOf(pocket: Pocket): readonly Diagonal[] {
  const edges = new Set(edgesOf(pocket).map(String));
  return pairsBelow(pocket.corners.length).flatMap((ends) =>
    edges.has(String(ends)) ? [] : [{ ends, run: runOf(pocket, ends) }],
  );
}

const pairsBelow = (count: number): readonly Pair[] =>
  Array.from({ length: count }, (_none, a) =>
    Array.from({ length: count - a - 1 }, (_other, i): Pair => [a, a + 1 + i]),
  ).flat();

function runOf(pocket: Pocket, ends: Pair): Diagonal["run"] {
  if (pocket.faces.some((face) => crossesFace(pocket, ends, face))) return "crossing";
  if (edgesOf(pocket).some((edge) => crossesEdge(pocket, ends, edge))) return "crossing";
  const middle = mean(ends.map((end) => at(pocket, end)));
  return isWithin(pocket, middle) ? "inside" : "outside";
}

/** Returns whether a segment between two corners meets a face without a corner in common. */
function crossesFace(pocket: Pocket, [from, to]: Pair, face: Face): boolean {
  if (face.includes(from) || face.includes(to)) return false;
  const [p, q] = [at(pocket, from), at(pocket, to)];
  const sides = [sign(pocket, face, p), sign(pocket, face, q)];
  if (sides[0] === sides[1]) return false;
  const turns = face.map((corner, i) =>
    orientation(p, q, at(pocket, corner), at(pocket, face[(i + 1) % 3] ?? 0)),
  );
  return !(turns.includes(1) && turns.includes(-1));
}

/** Returns whether two segments without a common end lie in one plane and meet. */
function crossesEdge(pocket: Pocket, [a, b]: Pair, [c, d]: Pair): boolean {
  if (a === c || a === d || b === c || b === d) return false;
  const [p, q, r, s] = [a, b, c, d].map((corner) => at(pocket, corner)) as [
    Position,
    Position,
    Position,
    Position,
  ];
  if (orientation(p, q, r, s) !== 0) return false;
  // In one plane, the signs are those of the drawing without the coordinate that says least: exact again.
  const sizes = cross(subtract(q, p), subtract(s, r)).map(Math.abs);
  const dropped = sizes.indexOf(Math.max(...sizes));
  const flat = (x: Position, height = 0): Position => [
    x[(dropped + 1) % 3] ?? 0,
    x[(dropped + 2) % 3] ?? 0,
    height,
  ];
  const parted = (u: Position, v: Position, x: Position, y: Position): boolean =>
    orientation(flat(u), flat(v), flat(u, 1), flat(x)) * orientation(flat(u), flat(v), flat(u, 1), flat(y)) <=
    0;
  return parted(p, q, r, s) && parted(r, s, p, q);
}

/** Returns whether a position that is on no face is within a pocket: its winding number is 1, and not 0. */
function isWithin(pocket: Pocket, position: Position): boolean {
  let angle = 0;
  for (const face of pocket.faces) {
    const [a, b, c] = face.map((corner) => subtract(at(pocket, corner), position)) as [
      Position,
      Position,
      Position,
    ];
    const [x, y, z] = [length(a), length(b), length(c)];
    angle += 2 * Math.atan2(dot(a, cross(b, c)), x * y * z + dot(a, b) * z + dot(b, c) * x + dot(c, a) * y);
  }
  return Math.abs(angle) > 2 * Math.PI;
}

/** Returns a tetrahedron for each four corners. O(corners⁴ · faces): for small pockets. */
export function trialsIn(pocket: Pocket): readonly Trial[] {
  const diagonals = diagonalsOf(pocket);
  const fours = pairsBelow(pocket.corners.length).flatMap(([a, b]) =>
    pairsBelow(pocket.corners.length).flatMap(([c, d]): Element[] => (b < c ? [[a, b, c, d]] : [])),
  );
  return fours.map((four) => trialOf(pocket, four, diagonals));
}

function trialOf(pocket: Pocket, [a, b, c, d]: Element, diagonals: readonly Diagonal[]): Trial {
  const own = [a, b, c, d];
  const culprits = diagonals.filter(
    ({ ends, run }) => run !== "inside" && ends.every((end) => own.includes(end)),
  );
  const volume = sign(pocket, [a, b, c], at(pocket, d));
  const element: Element = volume < 0 ? [a, c, b, d] : [a, b, c, d];
  const trial = (verdict: Trial["verdict"]): Trial => ({
    element,
    verdict,
    culprits: culprits.map(({ ends }) => ends),
  });
  if (volume === 0) return trial("flat");
  if (culprits.some(({ run }) => run === "crossing")) return trial("crosses");
  if (culprits.length > 0) return trial("outside");
  const faces = facesOf(element);
  const isCrossed = edgesOf(pocket).some((edge) => faces.some((face) => crossesFace(pocket, edge, face)));
  const holdsCorner = pocket.corners.some(
    (corner, index) => !own.includes(index) && faces.every((face) => sign(pocket, face, corner) >= 0),
  );
  if (isCrossed || holdsCorner) return trial("crosses");
  return trial(isWithin(pocket, mean(own.map((corner) => at(pocket, corner)))) ? "fits" : "outside");
}

/** Returns the faces of an element, counter-clockwise as seen from inside. */
export const facesOf = ([a, b, c, d]: Element): readonly Face[] => [
  [a, b, c],
  [a, d, b],
  [b, d, c],
  [c, d, a],
];

/**
 * Returns all ways to fill a pocket with tetrahedra that fit. Some element must stand on the first face that is open, so trying all
 * elements on it, and going on in the same way, finds every filling once.
 */
export function fillingsOf(pocket: Pocket, trials = trialsIn(pocket)): readonly (readonly Element[])[] {
  const fitting = trials.filter(({ verdict }) => verdict === "fits").map(({ element }) => element);
  const fill = (
    open: ReadonlyMap<string, Face>,
    used: readonly Element[],
  ): readonly (readonly Element[])[] => {
    const [first] = open.keys();
    if (first === undefined) return [used];
    return fitting.flatMap((element) => {
      const isOnFace = facesOf(element).some((face) => keyOf(face) === first);
      const next = isOnFace && !used.includes(element) ? withElement(open, element) : null;
      return next ? fill(next, [...used, element]) : [];
    });
  };
  return fill(new Map(pocket.faces.map((face) => [keyOf(face), face])), []);
}

/** Names a face by its corners in their sense, beginning with the smallest. */
function keyOf(face: Face): string {
  const first = face.indexOf(Math.min(...face));
  return [0, 1, 2].map((i) => face[(first + i) % 3]).join(" ");
}

/** Returns the open faces after an element: its own faces close, and the back of each other one opens; null if it does not fit. */
function withElement(open: ReadonlyMap<string, Face>, element: Element): ReadonlyMap<string, Face> | null {
  const next = new Map(open);
  for (const face of facesOf(element)) {
    const [a, b, c] = face;
    if (next.delete(keyOf(face))) continue;
    const back: Face = [a, c, b];
    if (next.has(keyOf(back))) return null;
    next.set(keyOf(back), back);
  }
  return next;
}

/** Returns the volume of a pocket. */
export function volumeOf({ corners, faces }: Pocket): number {
  const volumes = faces.map(([a, b, c]) =>
    dot(cross(corners[a] ?? [0, 0, 0], corners[b] ?? [0, 0, 0]), corners[c] ?? [0, 0, 0]),
  );
  // The faces look inward.
  return -volumes.reduce((sum, each) => sum + each, 0) / 6;
}
