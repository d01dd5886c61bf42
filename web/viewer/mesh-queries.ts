import {
  histogramOf,
  placeOnScale,
  qualitiesOf,
  qualityOf,
  type Elements,
  type Histogram,
  type QualityMeasure,
} from "../document/mesh-quality";
import type { VolumeMesh } from "tetrafront";
import type { Cut, CutAxis, Shading } from "../document/selection";
import type { Place } from "./layers/layer";
import { findNeighbours, outside } from "./topology";
import {
  centroidsAlong,
  collectVisibleFaces,
  extentAlong,
  hideBeyond,
  hideRegions,
  writeCorners,
} from "./visible-faces";

/** What is looked at of a mesh. */
export type Surveyed = Elements & Pick<VolumeMesh, "regions">;

/** How a mesh is looked at. */
export interface Look {
  /** Corners are given relative to this place. */
  readonly origin: Place;
  /** Null shows the boundary. */
  readonly cut: Omit<Cut, "enabled"> | null;
  readonly hiddenRegions: ReadonlySet<number>;
  readonly shading: Shading;
}

/** The triangles to be drawn of a mesh, in flat arrays. */
export interface DrawnFaces {
  /** Per triangle 4t + f: face f of tetrahedron t, opposite its node f. */
  readonly faces: Uint32Array<ArrayBuffer>;
  /** Per triangle: 1 where its region ends at it, 0 where only the cut does. */
  readonly onBoundary: Uint8Array<ArrayBuffer>;
  /** Nine per triangle: x y z of three corners, counter-clockwise from outside. */
  readonly corners: Float32Array<ArrayBuffer>;
  /**
   * Per corner the place of its element on the colour scale, or the number of its region, whichever the shading
   * is by; empty where there is none.
   */
  readonly values: Float32Array<ArrayBuffer>;
}

/**
 * A mesh and all that has been found out about it, each when first needed and once. The searches are linear
 * and take up to half a second for a million tetrahedra: they belong into a worker.
 */
export class Survey {
  readonly #mesh: Surveyed;
  #neighbours: Int32Array | null = null;
  /** Room for all faces: a sheet is drawn once per side, so every face may become visible. */
  #faces = new Uint32Array();
  /** Per tetrahedron: 1 where it is not shown. */
  readonly #hidden: Uint8Array;
  readonly #centroids = new Map<CutAxis, Float32Array>();
  readonly #extents = new Map<CutAxis, readonly [number, number]>();
  readonly #qualities = new Map<QualityMeasure, Float32Array>();

  constructor(mesh: Surveyed) {
    this.#mesh = mesh;
    this.#hidden = new Uint8Array(mesh.tetrahedra.length / 4);
  }

  facesOf({ origin, cut, hiddenRegions, shading }: Look): DrawnFaces {
    const neighbours = this.#knownNeighbours();
    this.#hidden.fill(0);
    if (cut) hideBeyond(this.#centroidsAlong(cut.axis), this.#limit(cut), cut.flipped, this.#hidden);
    hideRegions(this.#mesh.regions, hiddenRegions, this.#hidden);
    const count = collectVisibleFaces(neighbours, this.#hidden, this.#faces);
    const faces = this.#faces.slice(0, count);
    const corners = new Float32Array(9 * count);
    writeCorners(this.#mesh, faces, count, origin, corners);
    const onBoundary = Uint8Array.from(faces, (face) => Number(this.#endsRegion(face, neighbours)));
    return { faces, onBoundary, corners, values: this.#valuesOf(faces, shading) };
  }

  histogram(measure: QualityMeasure, barCount: number): Histogram {
    return histogramOf(this.#qualitiesBy(measure), measure, barCount);
  }

  #knownNeighbours(): Int32Array {
    if (!this.#neighbours) {
      this.#neighbours = findNeighbours(this.#mesh.tetrahedra);
      this.#faces = new Uint32Array(this.#neighbours.length);
    }
    return this.#neighbours;
  }

  #endsRegion(face: number, neighbours: Int32Array): boolean {
    const { regions } = this.#mesh;
    const beyond = neighbours[face] ?? outside;
    return beyond === outside || regions[beyond] !== regions[face >> 2];
  }

  #centroidsAlong(axis: CutAxis): Float32Array {
    return remembered(this.#centroids, axis, () => centroidsAlong(this.#mesh, axis));
  }

  #limit({ axis, position }: Omit<Cut, "enabled">): number {
    const [low, high] = remembered(this.#extents, axis, () => extentAlong(this.#mesh.points, axis));
    return low + position * (high - low);
  }

  #qualitiesBy(measure: QualityMeasure): Float32Array {
    return remembered(this.#qualities, measure, () => qualitiesOf(this.#mesh, measure));
  }

  #valuesOf(faces: Uint32Array, shading: Shading): Float32Array<ArrayBuffer> {
    if (shading === "plain") return new Float32Array();
    const valueOf = this.#valueBy(shading);
    const values = new Float32Array(3 * faces.length);
    for (let i = 0; i < faces.length; ++i) values.fill(valueOf((faces[i] ?? 0) >> 2), 3 * i, 3 * i + 3);
    return values;
  }

  #valueBy(shading: QualityMeasure | "region"): (tetrahedron: number) => number {
    const { regions } = this.#mesh;
    if (shading === "region") return (tetrahedron) => regions[tetrahedron] ?? 0;
    // Those of all elements take their time, and the picture waits.
    const known = this.#qualities.get(shading);
    return (tetrahedron) =>
      placeOnScale(known?.[tetrahedron] ?? qualityOf(this.#mesh, shading, tetrahedron), shading);
  }
}

function remembered<Key, Value>(known: Map<Key, Value>, key: Key, find: () => Value): Value {
  const value = known.get(key) ?? find();
  known.set(key, value);
  return value;
}
