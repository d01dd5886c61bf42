/**
 * Describes the shape of a BREP file as trimmed surfaces. A BREP file contains all that the kernel knows: surfaces, curves in
 * space and in the plane, tolerances; so it is also how the kernel hands out shapes of other files.
 */
import { plural } from "../base/plural.js";
import { dot, minus, type Vector } from "../base/vectors.js";
import { curveOver, placedCurve, PLANE, SPACE, surfaceOver } from "./brep-geometry.js";
import { keyOf, type Location, NOWHERE, product } from "./brep-locations.js";
import {
  type BrepShape,
  type BrepTables,
  type CurveOnSurface,
  type EdgeShape,
  type FaceShape,
  readTables,
  type Use,
  type VertexShape,
} from "./brep-shape-table.js";
import type { TriangulatedFace } from "./brep-triangles.js";
import { BrepWords } from "./brep-words.js";
import { chainedLoops, type EndedCoedge } from "./coedge-loops.js";
import { boundsOf, endsOf, reparameterized } from "./plane-curves.js";
import {
  CadFileError,
  type FaceSurface,
  type Frame,
  type PlaneCurve,
  type PlaneVector,
  type SpaceCurve,
  type TrimmedEdge,
  type TrimmedFace,
  type TrimmedModel,
  type TrimmedSolid,
} from "./trimmed-model.js";

/** Shapes within shapes; more is a damaged file. */
const MAX_DEPTH = 100;

/** Reads the text of a BREP file. Throws a CadFileError if it is damaged or has no faces. */
export function trimmedModelOfBrep(text: string, fileName: string): TrimmedModel {
  const tables = readTables(new BrepWords(text, fileName), text);
  const { parts, skipped } = partsIn(tables);
  const model = new ModelBuilder(tables).model(parts);
  const notes =
    skipped === 0
      ? model.notes
      : [noteOf("it lies inside of a solid and bounds nothing", skipped), ...model.notes];
  if (model.faces.length > 0) return { ...model, notes };
  const reasons = notes.map((note) => ` (${note})`).join("");
  throw new CadFileError(
    fileName,
    `the file contains no faces that can be described${reasons}`,
    "Export the part as solids.",
  );
}

/** A solid of a file, or faces that bound none. */
export interface BrepPart {
  /** What can be described of it; its only solid is the part. */
  readonly model: TrimmedModel;
  /** All its faces, in the order of the file. */
  readonly faces: readonly TriangulatedFace[];
  /** Per face: the kind of its surface. */
  readonly kinds: readonly (FaceSurface["kind"] | "other")[];
}

/** Returns the solids of a file, each with its faces and the triangles that the file contains. Errors as above, but for empty files. */
export function partsOfBrep(text: string, fileName: string): BrepPart[] {
  const tables = readTables(new BrepWords(text, fileName), text);
  return partsIn(tables).parts.map((part) => {
    const builder = new ModelBuilder(tables);
    const model = builder.model([part]);
    return { model, faces: builder.triangulated, kinds: kindsIn(part, tables) };
  });
}

/** Returns the kinds of the surfaces of the faces of each part, as `partsOfBrep` does. */
export function kindsOfBrep(text: string, fileName: string): BrepPart["kinds"][] {
  const tables = readTables(new BrepWords(text, fileName), text);
  return partsIn(tables).parts.map((part) => kindsIn(part, tables));
}

/** A use of a shape where it is in the whole: locations and orientations of all uses above it included. */
interface Placed {
  readonly shape: number;
  readonly location: Location;
  readonly isReversed: boolean;
}

interface Part {
  readonly isSolid: boolean;
  readonly faces: readonly Placed[];
}

/** Thrown where a face cannot be described; its message ends a sentence. */
class Indescribable extends Error {}

const noteOf = (reason: string, count: number) => `${plural(count, "face")}: ${reason}`;

const shapeOf = ({ shapes }: BrepTables, index: number): BrepShape =>
  shapes[index] ?? { kind: "group", uses: [] };

const kindsIn = ({ faces }: Part, tables: BrepTables): BrepPart["kinds"] =>
  faces.map((face) => kindOf(face, tables));

function kindOf(face: Placed, tables: BrepTables): FaceSurface["kind"] | "other" {
  const { surface } = shapeOf(tables, face.shape) as FaceShape;
  const kind = tables.surfaces[surface ?? -1]?.kind ?? "other";
  return kind === "stored" ? "spline" : kind;
}

/**
 * Returns the solids of a file in their order. Shells and faces that bound none, and follow each other in a group, are one part.
 * `skipped`: number of faces inside of solids that bound nothing.
 */
function partsIn(tables: BrepTables): { readonly parts: readonly Part[]; readonly skipped: number } {
  const parts: Part[] = [];
  let skipped = 0;
  const facesOf = (placed: Placed): Placed[] => {
    const shape = shapeOf(tables, placed.shape);
    if (shape.kind === "face") return [placed];
    if (shape.kind !== "solid" && shape.kind !== "shell") return [];
    return shape.uses.flatMap((use) => {
      const isInside = use.orientation === "internal" || use.orientation === "external";
      if (isInside) skipped++;
      return isInside ? [] : facesOf(placedUse(placed, use));
    });
  };
  const addAll = (placed: readonly Placed[], depth: number): void => {
    if (depth > MAX_DEPTH) return;
    let loose: Placed[] = [];
    const addLoose = () => {
      if (loose.length > 0) parts.push({ isSolid: false, faces: loose });
      loose = [];
    };
    for (const one of placed) {
      const { kind, uses } = shapeOf(tables, one.shape);
      if (kind === "solid" || kind === "group") addLoose();
      if (kind === "solid") parts.push({ isSolid: true, faces: facesOf(one) });
      else if (kind === "shell" || kind === "face") loose.push(...facesOf(one));
      else if (kind === "group")
        addAll(
          uses.map((use) => placedUse(one, use)),
          depth + 1,
        );
    }
    addLoose();
  };
  addAll([placedUse({ shape: 0, location: NOWHERE, isReversed: false }, tables.root)], 0);
  return { parts, skipped };
}

class ModelBuilder {
  readonly #tables: BrepTables;
  readonly #vertices: number[] = [];
  readonly #curves: SpaceCurve[] = [];
  readonly #surfaces: FaceSurface[] = [];
  readonly #edges: TrimmedEdge[] = [];
  readonly #faces: TrimmedFace[] = [];
  readonly #reasons = new Map<string, number>();
  readonly #known = new Map<string, number>();
  /** Faces that two solids share are here twice. */
  readonly triangulated: TriangulatedFace[] = [];

  constructor(tables: BrepTables) {
    this.#tables = tables;
  }

  model(parts: readonly Part[]): TrimmedModel {
    const solids = parts.map(({ isSolid, faces }, solid): TrimmedSolid => {
      const missingFaces = faces.filter((face) => !this.#addWithTriangles(face, solid)).length;
      return { isSolid, name: "", missingFaces };
    });
    return {
      vertices: Float64Array.from(this.#vertices),
      curves: this.#curves,
      surfaces: this.#surfaces,
      edges: this.#edges,
      faces: this.#faces,
      solids,
      notes: Array.from(this.#reasons, ([reason, count]) => noteOf(reason, count)),
    };
  }

  #shape(index: number): BrepShape {
    return shapeOf(this.#tables, index);
  }

  #note(reason: string): void {
    this.#reasons.set(reason, (this.#reasons.get(reason) ?? 0) + 1);
  }

  /** Returns whether the face could be described. */
  #addWithTriangles(placed: Placed, solid: number): boolean {
    const face = this.#addFace(placed, solid);
    const { triangulation } = this.#shape(placed.shape) as FaceShape;
    this.triangulated.push({
      face,
      triangulation: this.#tables.triangulations[triangulation ?? -1],
      placing: this.#tables.locations.placing(placed.location),
      isReversed: placed.isReversed,
    });
    return face !== undefined;
  }

  /** Returns the index of the face; undefined if it cannot be described. */
  #addFace(placed: Placed, solid: number): number | undefined {
    const key = `face ${placed.shape} ${keyOf(placed.location)}`;
    const known = this.#known.get(key);
    const other = known === undefined ? undefined : this.#faces[known];
    if (known !== undefined && other !== undefined) {
      if (other.otherSolid === undefined && other.reversed !== placed.isReversed)
        this.#faces[known] = { ...other, otherSolid: solid };
      else this.#note("more than two solids, or two on the same side, share it");
      return known;
    }
    try {
      const face = this.#faces.push(this.#face(placed, solid)) - 1;
      this.#known.set(key, face);
      return face;
    } catch (failure) {
      if (!(failure instanceof Indescribable)) throw failure;
      this.#note(failure.message);
      return undefined;
    }
  }

  #face(placed: Placed, solid: number): TrimmedFace {
    const shape = this.#shape(placed.shape) as FaceShape;
    if (shape.surface === undefined) throw new Indescribable("it has triangles only");
    const place = { surface: shape.surface, location: product(placed.location, shape.location) };
    // The orientation of the face says on which side the solid is; its loops run as on the surface.
    const inFace = { ...placed, isReversed: false };
    const wires = shape.uses.map((use) => this.#coedges(placedUse(inFace, use), place));
    const coedges = wires.flat();
    const surface = this.#surface(
      place,
      coedges.map(({ inPlane, range }) => boundsOf(inPlane, range)),
    );
    const loops = wires.flatMap(chainedLoops);
    if (loops.length === 0) throw new Indescribable("it has no edges");
    return {
      surface,
      reversed: placed.isReversed,
      loops,
      solid,
      otherSolid: undefined,
      name: "",
      color: undefined,
    };
  }

  #coedges(wire: Placed, place: Place): EndedCoedge[] {
    const shape = this.#shape(wire.shape);
    if (shape.kind !== "wire") return [];
    const used = shape.uses.filter(
      ({ orientation }) => orientation === "forward" || orientation === "reversed",
    );
    return used.flatMap((use) => {
      const placed = placedUse(wire, use);
      const edge = this.#shape(placed.shape);
      return edge.kind === "edge" ? [this.#coedge(edge, placed, place)] : [];
    });
  }

  #coedge(shape: EdgeShape, placed: Placed, place: Place): EndedCoedge {
    const edge = this.#edge(shape, placed);
    const { first, last, start, end } = this.#edges[edge] as TrimmedEdge;
    const range: PlaneVector = [first, last];
    const inPlane = this.#planeCurve(shape, placed, place, range);
    const ends = endsOf(inPlane, range);
    const reversed = placed.isReversed;
    return {
      coedge: { edge, reversed, inPlane },
      inPlane,
      range,
      from: { vertex: reversed ? end : start, at: reversed ? ends[1] : ends[0] },
      to: { vertex: reversed ? start : end, at: reversed ? ends[0] : ends[1] },
    };
  }

  #edge(shape: EdgeShape, { shape: index, location }: Placed): number {
    return this.#once(`edge ${index} ${keyOf(location)}`, () => {
      const { curve, isDegenerate, onSurfaces } = shape;
      const range = isDegenerate ? onSurfaces[0] : curve;
      if (range === undefined) throw new Indescribable("an edge of it has no curve in space");
      const { first, last } = range;
      if (!(last > first)) throw new Indescribable("an edge of it has no length in its parameter");
      const vertexAt = (orientation: Use["orientation"]) => {
        const use = shape.uses.find((one) => one.orientation === orientation);
        if (use === undefined) throw new Indescribable("an edge of it has no ends");
        return this.#vertex(use, location);
      };
      const made = isDegenerate || curve === undefined ? undefined : this.#curve(curve, location);
      const [start, end] = [vertexAt("forward"), vertexAt("reversed")];
      this.#edges.push({ curve: made, first, last, start, end, tolerance: shape.tolerance });
      return this.#edges.length - 1;
    });
  }

  #vertex(use: Use, above: Location): number {
    const location = product(above, use.location);
    return this.#once(`vertex ${use.shape} ${keyOf(location)}`, () => {
      const { position } = this.#shape(use.shape) as VertexShape;
      this.#vertices.push(...this.#tables.locations.placing(location).point(position));
      return this.#vertices.length / 3 - 1;
    });
  }

  #curve({ curve, location, first, last }: NonNullable<EdgeShape["curve"]>, above: Location): number {
    const where = product(above, location);
    const stored = this.#tables.curves[curve];
    if (stored === undefined) throw new Indescribable("an edge of it has no curve in space");
    const isFixed = stored.kind === "line" || stored.kind === "circle" || stored.kind === "ellipse";
    return this.#once(`curve ${curve} ${keyOf(where)} ${isFixed ? "" : `${first} ${last}`}`, () => {
      const made = curveOver(stored, [first, last], SPACE);
      if (made.kind === "other") throw new Indescribable(`an edge of it is ${made.name}`);
      this.#curves.push(placedCurve(made, this.#tables.locations.placing(where)));
      return this.#curves.length - 1;
    });
  }

  /** Returns an edge in the plane of a surface; on a plane, files need not contain it. */
  #planeCurve(shape: EdgeShape, placed: Placed, place: Place, range: PlaneVector): PlaneCurve {
    const key = keyOf(place.location);
    const found = shape.onSurfaces.find(
      ({ surface, location }) =>
        surface === place.surface && keyOf(product(placed.location, location)) === key,
    );
    if (found === undefined) return this.#projected(shape, placed, place, range);
    return this.#storedPlaneCurve(found, placed.isReversed, range);
  }

  #storedPlaneCurve(found: CurveOnSurface, isReversed: boolean, range: PlaneVector): PlaneCurve {
    const stored = this.#tables.planeCurves[isReversed ? found.backward : found.curve];
    if (stored === undefined) throw new Indescribable("an edge of it has no curve in the plane");
    const own: PlaneVector = [found.first, found.last];
    const made = curveOver(stored, own, PLANE);
    if (made.kind === "other") throw new Indescribable(`an edge of it is ${made.name} in the plane`);
    const result = reparameterized(made, own, range);
    if (result === undefined)
      throw new Indescribable("an edge of it has different parameters in space and in the plane");
    return result;
  }

  #projected(shape: EdgeShape, placed: Placed, place: Place, range: PlaneVector): PlaneCurve {
    const surface = this.#tables.surfaces[place.surface];
    if (surface?.kind !== "plane" || shape.curve === undefined)
      throw new Indescribable("an edge of it has no curve in the plane");
    const stored = this.#tables.curves[shape.curve.curve];
    const made = stored && curveOver(stored, range, SPACE);
    if (made === undefined || made.kind === "other")
      throw new Indescribable("an edge of it has no curve in the plane");
    const { locations } = this.#tables;
    const curve = placedCurve(made, locations.placing(product(placed.location, shape.curve.location)));
    return projectedCurve(curve, locations.placing(place.location).frame(surface.frame));
  }

  #surface(place: Place, bounds: readonly (readonly [PlaneVector, PlaneVector])[]): number {
    const stored = this.#tables.surfaces[place.surface];
    if (stored === undefined) throw new Indescribable("it has no surface");
    const over = (d: 0 | 1): PlaneVector => [
      Math.min(...bounds.map(([low]) => low[d])),
      Math.max(...bounds.map(([, high]) => high[d])),
    ];
    const [u, v] = [over(0), over(1)];
    const isFixed = !["stored", "extrusion", "revolution"].includes(stored.kind);
    const key = `surface ${place.surface} ${keyOf(place.location)} ${isFixed ? "" : `${u.join()} ${v.join()}`}`;
    return this.#once(key, () => {
      const made = surfaceOver(stored, u, v, this.#tables.locations.placing(place.location));
      if (made.kind === "other") throw new Indescribable(`its surface is ${made.name}`);
      this.#surfaces.push(made);
      return this.#surfaces.length - 1;
    });
  }

  #once(key: string, make: () => number): number {
    const known = this.#known.get(key);
    if (known !== undefined) return known;
    const made = make();
    this.#known.set(key, made);
    return made;
  }
}

/** A surface where it is in the whole. */
interface Place {
  readonly surface: number;
  readonly location: Location;
}

function placedUse(above: Placed, use: Use): Placed {
  return {
    shape: use.shape,
    location: product(above.location, use.location),
    isReversed: above.isReversed !== (use.orientation === "reversed"),
  };
}

/** Returns a curve of a plane in the plane's coordinates, with the same parameter. */
function projectedCurve(curve: SpaceCurve, { origin, x, y }: Frame): PlaneCurve {
  const vector = (a: Vector): PlaneVector => [dot(a, x), dot(a, y)];
  const point = (a: Vector): PlaneVector => vector(minus(a, origin));
  if (curve.kind !== "spline") {
    const { frame } = curve;
    return { ...curve, frame: { origin: point(frame.origin), x: vector(frame.x), y: vector(frame.y) } };
  }
  const { poles } = curve.spline;
  const flat = new Float64Array((poles.length / 3) * 2);
  for (let p = 0; p < poles.length / 3; p++)
    flat.set(point([poles[3 * p] ?? 0, poles[3 * p + 1] ?? 0, poles[3 * p + 2] ?? 0]), 2 * p);
  return { kind: "spline", spline: { ...curve.spline, poles: flat } };
}
