/**
 * Joins shapes that were triangulated by themselves, such as the solids of a CAD file, to one surface: each shape a
 * region, each of its faces a patch. Faces that two shapes share become interfaces.
 */
import { type Steps, stepwise } from "../base/steps.js";
import { NO_REGION } from "../generated/constants.js";
import type { MeshGroup, Mesh } from "../mesh/mesh.js";
import { listed } from "./groups.js";
import { imprinted } from "./imprint.js";
import {
  joinedShapes,
  type JoinedShapes,
  namesOf,
  orientShapes,
  type Shape,
  type ShapeFace,
  weldShapes,
} from "./joined-shapes.js";
import { shareFaces, sharePlanarPieces, shareTriangles } from "./shared-faces.js";

/** Returns the surface of all shapes. Its notes list what was changed, open shapes and faces without triangles. */
export function* surfaceOfShapes(shapes: readonly Shape[]): Steps<Mesh> {
  return (yield* joinedSurface(shapes)).mesh;
}

/** Like `surfaceOfShapes`; also returns how many of the shapes are closed. */
export function* joinedSurface(
  shapes: readonly Shape[],
): Steps<{ readonly mesh: Mesh; readonly closedShapes: number }> {
  let joined = joinedShapes(shapes);
  const open = yield* weldShapes(joined);
  yield* orientShapes(joined);
  if (open.size > 0) joined.notes.push(`not closed: ${namesOf(joined, open)}`);
  if (shapes.length > 1) {
    joined = yield* imprinted(joined);
    yield* shareFaces(joined);
    yield* shareTriangles(joined);
    yield* sharePlanarPieces(joined);
  }
  return { mesh: yield* meshOf(joined, shapes), closedShapes: shapes.length - open.size };
}

function* meshOf(joined: JoinedShapes, shapes: readonly Shape[]): Steps<Mesh> {
  const { names, points, shapeOf, faceOf, twin, isDropped, notes } = joined;
  const patches = new SharedPatches(shapes, names);
  const kept = shapeOf.map((_, t) => t).filter((t) => isDropped[t] === 0);
  const triangles = new Uint32Array(3 * kept.length);
  const trianglePatch = new Uint32Array(kept.length);
  const triangleRegions = new Uint32Array(2 * kept.length).fill(NO_REGION);
  yield* stepwise(kept.length, (i) => {
    const t = kept[i] ?? 0;
    const other = twin[t] ?? t;
    triangles.set(joined.triangles.subarray(3 * t, 3 * t + 3), 3 * i);
    const face = faceOf[t] ?? 0;
    trianglePatch[i] = other === t ? patches.of(face) : patches.between(face, faceOf[other] ?? 0);
    triangleRegions[2 * i] = shapeOf[t] ?? 0;
    if (other !== t) triangleRegions[2 * i + 1] = shapeOf[other] ?? 0;
  });
  // A solid may fill a cavity of another, and one that is not closed keeps its region when a repair closes it.
  const isLimited = shapes.some(({ maxVolume = 0 }) => maxVolume > 0);
  const allNotes = [...notes, ...patches.emptyFaces()];
  return {
    points,
    isWelded: true,
    triangles,
    trianglePatch,
    patches: patches.groups,
    tetrahedra: new Uint32Array(),
    tetrahedronRegion: new Uint32Array(),
    regions: [],
    surfaceRegions: {
      regions: names.map((name, s) => ({ name, tag: s + 1, isTagChosen: true })),
      triangleRegions,
      ...((shapes.length > 1 || isLimited) && { areMeshed: true }),
      ...(isLimited && { maxVolumes: Float64Array.from(shapes, ({ maxVolume = 0 }) => maxVolume) }),
    },
    ...(allNotes.length > 0 && { notes: allNotes }),
    nodeData: new Map(),
  };
}

/** Patches of faces, and of pairs of faces that two shapes share, in the order in which they are asked for. */
class SharedPatches {
  readonly groups: MeshGroup[] = [];
  readonly #faces: readonly (ShapeFace & { readonly shape: string; readonly label: string })[];
  readonly #indices = new Map<string, number>();
  /** Number of interfaces per pair of shapes. */
  readonly #interfaces = new Map<string, number>();
  #lastTag: number;

  constructor(shapes: readonly Shape[], names: readonly string[]) {
    this.#faces = shapes.flatMap(({ faces }, s) => {
      const shape = names[s] ?? "";
      return faces.map((face, f) => {
        return { ...face, shape, label: labelOf(face.name ?? `face ${f + 1}`, shape, shapes.length === 1) };
      });
    });
    this.#lastTag = this.#faces.length;
  }

  /** Returns the patch of a face. */
  of(face: number): number {
    const { label = "", color } = this.#faces[face] ?? {};
    return this.#index(`${face}`, () => ({ name: label, tag: face + 1, color }));
  }

  /** Returns the patch of an interface between two faces: "bolt / nut", "bolt / nut 2". */
  between(one: number, other: number): number {
    return this.#index(`${one} ${other}`, () => {
      const [a, b] = [this.#faces[one], this.#faces[other]];
      const name = `${a?.shape ?? ""} / ${b?.shape ?? ""}`;
      const number = (this.#interfaces.get(name) ?? 0) + 1;
      this.#interfaces.set(name, number);
      return { name: number === 1 ? name : `${name} ${number}`, tag: ++this.#lastTag, color: a?.color };
    });
  }

  /** Returns a sentence about the faces without triangles. */
  emptyFaces(): string[] {
    const empty = this.#faces.filter(({ triangles }) => triangles <= 0).map(({ label }) => label);
    return empty.length === 0 ? [] : [`without triangles: ${listed(empty)}; ${HEAL}`];
  }

  #index(key: string, make: () => MeshGroup): number {
    const known = this.#indices.get(key);
    if (known !== undefined) return known;
    this.#indices.set(key, this.groups.length);
    return this.groups.push(make()) - 1;
  }
}

const HEAL = "heal these faces in the CAD program, or export the part again";

/** Returns the name of a patch; `own`: that of the face, empty or the same if the whole shape is one face. */
function labelOf(own: string, shape: string, isOnlyShape: boolean): string {
  if (own === "") return isOnlyShape ? "surface" : shape;
  return isOnlyShape || own === shape ? own : `${shape} ${own}`;
}
