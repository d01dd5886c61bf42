import {
  histogramOf,
  metricValues,
  scalePosition,
  qualitiesOf,
  qualityIn,
  type Elements,
  type Histogram,
  type MeasuredMesh,
  type QualityMeasure,
  type QualitySpace,
} from "../../document/mesh-quality";
import type { Mesh } from "tetrafront";
import type { Cut, CutAxis, Shading } from "../../document/selection";
import type { Position } from "../../document/position";
import { CurvedFaces, shareUnit, type CurvedTriangles } from "./curved-faces";
import { isosurface } from "./field-shapes";
import { cutElements, cutShareUnit, interpolated } from "./smooth-cut";
import { findNeighbours, outside } from "./topology";
import {
  centroidsAlong,
  collectVisibleFaces,
  cornerValues,
  extentAlong,
  heightsAlong,
  hideBeyond,
  hideRegions,
  scaleOf,
  type FieldValues,
  writeCorners,
} from "./visible-faces";

/** The arrays of a mesh that the queries use. */
export interface QueriedMesh extends MeasuredMesh {
  readonly mesh: Elements & Pick<Mesh, "tetrahedronRegion" | "curvedEdges">;
}

/** Which faces of a mesh are drawn, and how. */
export interface ViewOptions {
  /** Position that the corners are relative to. */
  readonly origin: Position;
  /** Null draws the whole mesh. */
  readonly cut: Omit<Cut, "enabled"> | null;
  readonly hiddenRegions: ReadonlySet<number>;
  readonly shading: Shading;
  /** Where the quality that the shading shows is measured. */
  readonly qualitySpace: QualitySpace;
  /** Whether the colours show the values of `setField`, whatever the shading. Default false. */
  readonly byField?: boolean;
}

/** The triangles of a mesh to draw, in flat arrays. */
export interface DrawnFaces {
  /** Per triangle 4t + f: face f of tetrahedron t, opposite its node f. A curved face has several triangles. */
  readonly faces: Uint32Array<ArrayBuffer>;
  /** Per triangle: 1 if it lies on the boundary of its region, 0 if only the cut exposes it. */
  readonly onBoundary: Uint8Array<ArrayBuffer>;
  /** Nine per triangle: x y z of three corners, counter-clockwise from outside. */
  readonly corners: Float32Array<ArrayBuffer>;
  /** Three per corner: its coordinates in its face, as multiples of `shareUnit`; empty if every triangle is a face. */
  readonly shares: Uint8Array<ArrayBuffer>;
  readonly shareUnit: number;
  /**
   * Per corner: the position of its element on the colour scale, 0 to 1, or the index of its region, depending on
   * the shading; empty with plain shading. With a field, the position of its own value.
   */
  readonly values: Float32Array<ArrayBuffer>;
}

/**
 * Answers queries about one mesh and caches what they share. Each takes linear time, up to half a second for a
 * million tetrahedra, so this class is used in a worker.
 */
export class MeshQueries {
  readonly #mesh: QueriedMesh["mesh"];
  readonly #measured: MeasuredMesh;
  #neighbours: Int32Array | null = null;
  #curved: CurvedFaces | null = null;
  /** Scratch space with an entry per face 4t + f, because every face may become visible. */
  #faces = new Uint32Array();
  /** Per tetrahedron: 1 if it is not drawn. */
  readonly #hidden: Uint8Array;
  readonly #centroids = new Map<CutAxis, Float32Array>();
  readonly #extents = new Map<CutAxis, readonly [number, number]>();
  readonly #qualities = new Map<QualityMeasure, Float32Array>();
  #field: FieldValues | null = null;
  /** The mesh with its nodes where they are drawn. */
  #moved: QueriedMesh["mesh"] | null = null;

  constructor(measured: QueriedMesh) {
    this.#mesh = measured.mesh;
    this.#measured = measured;
    this.#hidden = new Uint8Array(measured.mesh.tetrahedra.length / 4);
  }

  /** Sets the values that colours can show. */
  setField(field: FieldValues): void {
    this.#field = field;
    const { offsets } = field;
    const { points } = this.#mesh;
    const isMoved = offsets?.length === points.length;
    this.#moved = isMoved ? { ...this.#mesh, points: points.map((x, i) => x + (offsets[i] ?? 0)) } : null;
  }

  /** Returns where the field has a value: x y z of three corners per triangle, relative to `origin`. */
  isosurface(level: number, origin: Position): Float32Array<ArrayBuffer> {
    const values = this.#field?.values ?? new Float32Array();
    return isosurface(this.#moved ?? this.#mesh, values, level, origin);
  }

  facesOf({ origin, cut, hiddenRegions, shading, qualitySpace, byField }: ViewOptions): DrawnFaces {
    const neighbours = this.#cachedNeighbours();
    this.#hidden.fill(0);
    const field = byField === true ? this.#field : null;
    const shape = (field && this.#moved) ?? this.#mesh;
    // Values of elements belong to whole ones, and curved faces are not divided.
    if (cut && field && !field.isPerElement && !this.#isCurved(shape)) {
      hideRegions(this.#mesh.tetrahedronRegion, hiddenRegions, this.#hidden);
      return this.#cutSmoothly(shape, field, cut, origin);
    }
    if (cut) hideBeyond(this.#centroidsAlong(cut.axis), this.#limit(cut), cut.flipped, this.#hidden);
    hideRegions(this.#mesh.tetrahedronRegion, hiddenRegions, this.#hidden);
    const count = collectVisibleFaces(neighbours, this.#hidden, this.#faces);
    const { faces, corners, shares } = this.#trianglesOf(shape, this.#faces.slice(0, count), origin);
    const onBoundary = Uint8Array.from(faces, (face) => Number(this.#endsRegion(face, neighbours)));
    const values = field
      ? cornerValues(this.#mesh.tetrahedra, faces, shares, field)
      : this.#valuesOf(faces, shading, qualitySpace);
    return { faces, onBoundary, corners, shares, shareUnit, values };
  }

  /** Returns what the plane of a cut leaves of the mesh, with the section of each element that it meets. */
  #cutSmoothly(
    shape: QueriedMesh["mesh"],
    { values, range }: FieldValues,
    cut: Omit<Cut, "enabled">,
    origin: Position,
  ): DrawnFaces {
    const neighbours = this.#cachedNeighbours();
    const { tetrahedra, points } = this.#mesh;
    const heights = heightsAlong(points, cut, this.#limit(cut));
    const divided = cutElements({ tetrahedra, neighbours, hidden: this.#hidden, heights }, this.#faces);
    const { wholeCount, cut: parts } = divided;
    const faces = new Uint32Array(wholeCount + parts.faces.length);
    faces.set(this.#faces.subarray(0, wholeCount));
    faces.set(parts.faces, wholeCount);
    const onBoundary = Uint8Array.from(faces, (face, i) =>
      parts.isSection[i - wholeCount] === 1 ? 0 : Number(this.#endsRegion(face, neighbours)),
    );
    const corners = new Float32Array(9 * faces.length);
    writeCorners(shape, faces, wholeCount, origin, corners);
    corners.set(
      interpolated(parts, shape.points, 3).map((x, i) => x - (origin[i % 3] ?? 0)),
      9 * wholeCount,
    );
    const shares = new Uint8Array(9 * faces.length);
    for (let corner = 0; corner < 9 * wholeCount; corner += 9)
      for (let k = 0; k < 9; k += 4) shares[corner + k] = 1 / cutShareUnit;
    shares.set(parts.shares, 9 * wholeCount);
    const positions = new Float32Array(3 * faces.length);
    const field = { values, range, isPerElement: false, offsets: null };
    positions.set(cornerValues(tetrahedra, faces.subarray(0, wholeCount), new Uint8Array(), field));
    positions.set(interpolated(parts, values, 1).map(scaleOf(range)), 3 * wholeCount);
    return { faces, onBoundary, corners, shares, shareUnit: cutShareUnit, values: positions };
  }

  /** Returns whether faces of a shape are drawn curved: only straight edges are moved with their nodes. */
  #isCurved(shape: QueriedMesh["mesh"]): boolean {
    const { curvedEdges } = this.#mesh;
    return shape === this.#mesh && curvedEdges !== undefined && curvedEdges.edges.length > 0;
  }

  histogram(measure: QualityMeasure, space: QualitySpace, barCount: number): Histogram {
    return histogramOf(this.#qualitiesBy(measure, space), measure, barCount);
  }

  #trianglesOf(
    shape: QueriedMesh["mesh"],
    faces: Uint32Array<ArrayBuffer>,
    origin: Position,
  ): CurvedTriangles {
    const { curvedEdges } = this.#mesh;
    if (curvedEdges !== undefined && this.#isCurved(shape)) {
      this.#curved ??= new CurvedFaces(this.#mesh, curvedEdges);
      return this.#curved.trianglesOf(faces, origin);
    }
    const corners = new Float32Array(9 * faces.length);
    writeCorners(shape, faces, faces.length, origin, corners);
    return { faces, corners, shares: new Uint8Array() };
  }

  #cachedNeighbours(): Int32Array {
    if (!this.#neighbours) {
      this.#neighbours = findNeighbours(this.#mesh.tetrahedra);
      this.#faces = new Uint32Array(this.#neighbours.length);
    }
    return this.#neighbours;
  }

  #endsRegion(face: number, neighbours: Int32Array): boolean {
    const { tetrahedronRegion: regions } = this.#mesh;
    const beyond = neighbours[face] ?? outside;
    return beyond === outside || regions[beyond] !== regions[face >> 2];
  }

  #centroidsAlong(axis: CutAxis): Float32Array {
    return cached(this.#centroids, axis, () => centroidsAlong(this.#mesh, axis));
  }

  #limit({ axis, position }: Omit<Cut, "enabled">): number {
    const [low, high] = cached(this.#extents, axis, () => extentAlong(this.#mesh.points, axis));
    return low + position * (high - low);
  }

  #qualitiesBy(measure: QualityMeasure, space: QualitySpace): Float32Array {
    const { metricShapes } = this.#measured;
    if (space === "metric" && metricShapes) return metricValues(metricShapes, measure);
    return cached(this.#qualities, measure, () => qualitiesOf(this.#mesh, measure));
  }

  #valuesOf(faces: Uint32Array, shading: Shading, space: QualitySpace): Float32Array<ArrayBuffer> {
    if (shading === "plain") return new Float32Array();
    const valueOf = shading === "region" ? this.#regionOf : this.#qualityBy(shading, space);
    const values = new Float32Array(3 * faces.length);
    for (let i = 0; i < faces.length; ++i) values.fill(valueOf((faces[i] ?? 0) >> 2), 3 * i, 3 * i + 3);
    return values;
  }

  readonly #regionOf = (tetrahedron: number): number => this.#mesh.tetrahedronRegion[tetrahedron] ?? 0;

  #qualityBy(measure: QualityMeasure, space: QualitySpace): (tetrahedron: number) => number {
    const measured = this.#measured;
    // Computing the quality of all elements would delay the picture; compute it for the drawn ones.
    const known = space === "space" || !measured.metricShapes ? this.#qualities.get(measure) : undefined;
    return (tetrahedron) =>
      scalePosition(known?.[tetrahedron] ?? qualityIn(measured, space, measure, tetrahedron), measure);
  }
}

function cached<Key, Value>(cache: Map<Key, Value>, key: Key, compute: () => Value): Value {
  const value = cache.get(key) ?? compute();
  cache.set(key, value);
  return value;
}
