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
import type { cutSmoothly } from "./smooth-cut";
import { findNeighbours, outside } from "./topology";
import {
  centroidsAlong,
  collectVisibleFaces,
  cornerValues,
  extentAlong,
  hideBeyond,
  hideRegions,
  type DrawnFaces,
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

  /** The mesh where it is drawn, and the values of the field at its nodes. */
  get drawnField(): { readonly mesh: Elements; readonly values: Float32Array<ArrayBuffer> } {
    return { mesh: this.#moved ?? this.#mesh, values: this.#field?.values ?? new Float32Array() };
  }

  /** `divide`: divides elements at the plane of a cut if the colours show values at the nodes; null cuts between elements. */
  facesOf(options: ViewOptions, divide: typeof cutSmoothly | null = null): DrawnFaces {
    const { origin, cut, hiddenRegions, shading, qualitySpace, byField } = options;
    const neighbours = this.#cachedNeighbours();
    this.#hidden.fill(0);
    hideRegions(this.#mesh.tetrahedronRegion, hiddenRegions, this.#hidden);
    const field = byField === true ? this.#field : null;
    const shape = (field && this.#moved) ?? this.#mesh;
    // Values of elements belong to whole ones, and curved faces are not divided.
    if (divide && cut && field && !field.isPerElement && !this.#isCurved(shape)) {
      const { axis, flipped } = cut;
      const plane = { axis, flipped, limit: this.#limit(cut) };
      const mesh = { mesh: this.#mesh, neighbours, hidden: this.#hidden, scratch: this.#faces };
      const { isSection, ...drawn } = divide(mesh, plane, field, { points: shape.points, origin });
      const onBoundary = Uint8Array.from(drawn.faces, (face, i) =>
        isSection(i) ? 0 : Number(this.#endsRegion(face, neighbours)),
      );
      return { ...drawn, onBoundary };
    }
    if (cut) hideBeyond(this.#centroidsAlong(cut.axis), this.#limit(cut), cut.flipped, this.#hidden);
    const count = collectVisibleFaces(neighbours, this.#hidden, this.#faces);
    const { faces, corners, shares } = this.#trianglesOf(shape, this.#faces.slice(0, count), origin);
    const onBoundary = Uint8Array.from(faces, (face) => Number(this.#endsRegion(face, neighbours)));
    const values = field
      ? cornerValues(this.#mesh.tetrahedra, faces, shares, field)
      : this.#valuesOf(faces, shading, qualitySpace);
    return { faces, onBoundary, corners, shares, shareUnit, values };
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
