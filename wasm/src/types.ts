/**
 * The plain data that crosses the package's border: what goes in, what comes out. Everything here
 * survives `structuredClone`; large arrays are typed arrays and are transferred, not copied.
 */

/** A closed triangle surface: x y z per node, three node positions per triangle, any turning. */
export interface SurfaceInput {
  readonly points: Float64Array;
  readonly triangles: Uint32Array;
}

export interface MeshOptions {
  /** Uniform element size in model units, > 0. Replaces a project's background grid. */
  readonly size?: number;
  /** Growth of the size per unit of distance from a given surface's edges, >= 0. Default 0.3. */
  readonly growth?: number;
  /** In which order faces leave the front. Default `layered`; `smallest-first` is the paper's. */
  readonly order?: 'layered' | 'smallest-first';
}

export type MeshStatus = 'done' | 'stalled' | 'cancelled' | 'invalid-input';
export type Phase = 'check' | 'sides' | 'surface' | 'volume' | 'verify';

export interface Progress {
  readonly phase: Phase;
  /** Of the whole run, 0 to 1, estimated, never decreasing. */
  readonly fraction: number;
  readonly points: number;
  readonly triangles: number;
  readonly tetrahedra: number;
  readonly frontFaces: number;
  readonly elapsedSeconds: number;
}

export interface RunControl {
  /** Called at most ten times a second, and once at the end. */
  readonly onProgress?: (progress: Progress) => void;
  /** Aborting ends the run within 100 ms with status `cancelled`; what exists is returned. */
  readonly signal?: AbortSignal;
}

export type EntityKind =
  | 'point'
  | 'line'
  | 'patch'
  | 'background-node'
  | 'background-tetrahedron'
  | 'triangle'
  | 'surface-node';

/** What a diagnostic is about. `id` is the project's id where the entity has one. */
export interface EntityRef {
  readonly kind: EntityKind;
  /** Position in the array of that kind. */
  readonly index: number;
  readonly id?: number;
  /** What the user called it, else e.g. "line 12". */
  readonly label: string;
}

export interface Diagnostic {
  /** Stable machine name, e.g. `open-edge`. */
  readonly code: string;
  readonly severity: 'information' | 'warning' | 'error';
  /** One sentence: what is wrong, naming the entities and the place. */
  readonly message: string;
  /** One sentence: what to do about it. */
  readonly remedy: string;
  readonly entities: readonly EntityRef[];
  readonly place?: readonly [number, number, number];
  readonly values: readonly number[];
}

/**
 * The boundary. Node i is at points[3i..3i+2] of the mesh; triangle t has the nodes
 * triangles[3t..3t+2], counter-clockwise seen from outside.
 */
export interface SurfaceMesh {
  readonly points: Float64Array;
  readonly triangles: Uint32Array;
  /** Per triangle: position of its patch in the project; for a given surface, its shell. */
  readonly trianglePatch: Uint32Array;
  /** Two nodes per side of a divided line; empty for a given surface. */
  readonly sides: Uint32Array;
  /** Per side: position of its line in the project. */
  readonly sideLine: Uint32Array;
}

/** Tetrahedron t has the nodes tetrahedra[4t..4t+3] = a b c d, (b-a)×(c-a)·(d-a) > 0. */
export interface VolumeMesh {
  /** The first nodes are those of the surface, in its order. */
  readonly points: Float64Array;
  readonly tetrahedra: Uint32Array;
  /** Per tetrahedron: the region it fills, from 0. */
  readonly regions: Uint32Array;
  /** What is left of the front where the mesh is not complete: three nodes per face. */
  readonly front: Uint32Array;
}

export interface MeshReport {
  readonly status: MeshStatus;
  readonly points: number;
  readonly tetrahedra: number;
  readonly triangles: number;
  readonly seconds: {
    readonly total: number;
    readonly check: number;
    readonly sides: number;
    readonly surface: number;
    readonly volume: number;
    readonly optimize: number;
  };
  /** Degrees, over all tetrahedra. */
  readonly dihedral: { readonly min: number; readonly max: number };
  /** 3 × inradius / circumradius. */
  readonly radiusRatio: { readonly min: number; readonly mean: number };
  readonly volume: number;
  readonly recovery: {
    readonly relaxed: number;
    readonly starred: number;
    readonly reopened: number;
  };
  readonly front: {
    readonly pops: number;
    readonly gatheredFaces: number;
    readonly candidatesTried: number;
    readonly facesTested: number;
    readonly facesAnalysed: number;
    readonly exactPredicates: number;
  };
  /** 16 hexadecimal digits: a hash over coordinates and indices, equal on every platform. */
  readonly fingerprint: string;
  readonly diagnostics: readonly Diagnostic[];
}

export interface MeshResult {
  readonly surface: SurfaceMesh;
  readonly volume: VolumeMesh;
  readonly report: MeshReport;
}

/** What a viewer draws of a project before it is meshed, and everything wrong with the project. */
export interface ProjectPreview {
  /** Polyline of line l: linePoints[3i..3i+2], lineOffsets[l] <= i < lineOffsets[l+1]. */
  readonly linePoints: Float64Array;
  readonly lineOffsets: Uint32Array;
  /** Triangles of patch p: patchTriangles[3t..3t+2], patchOffsets[p] <= t < patchOffsets[p+1]. */
  readonly patchPoints: Float64Array;
  readonly patchTriangles: Uint32Array;
  readonly patchOffsets: Uint32Array;
  readonly diagnostics: readonly Diagnostic[];
}

// The project file (docs/FORMAT.md). The zod schema in project.ts is the one source; its inferred
// type equals this shape.

export type PointId = number;
export type LineId = number;
export type PatchId = number;

export interface ProjectPoint {
  readonly id: PointId;
  readonly name?: string | undefined;
  readonly at: readonly [number, number, number];
}

export interface ProjectLine {
  readonly id: LineId;
  readonly name?: string | undefined;
  readonly type: 'straight' | 'parabolic' | 'spline';
  /** Point ids along the line: two; start, middle, end; four or more. */
  readonly points: readonly PointId[];
}

export interface ProjectPatch {
  readonly id: PatchId;
  readonly name?: string | undefined;
  readonly type:
    'planar' | 'isoparametric-triangle' | 'serendipity' | 'barnhill-gregory-nielson' | 'coons';
  /** The outer loop first, then holes. A negative id walks that line backwards. */
  readonly loops: readonly (readonly number[])[];
}

export interface ProjectBackgroundNode {
  readonly id: number;
  readonly at: readonly [number, number, number];
  readonly size: number;
  readonly stretching?: number | undefined;
  readonly direction?: readonly [number, number, number] | undefined;
}

export interface Project {
  readonly format: 'tetrafront-project';
  readonly version: 1;
  readonly name: string;
  readonly description?: string | undefined;
  readonly units?: string | undefined;
  readonly points: readonly ProjectPoint[];
  readonly lines: readonly ProjectLine[];
  readonly patches: readonly ProjectPatch[];
  readonly background: {
    readonly nodes: readonly ProjectBackgroundNode[];
    /** Four node ids each. */
    readonly tetrahedra: readonly (readonly [number, number, number, number])[];
  };
}

/** One mesher: an engine in a worker of its own (browser and Node). Runs are queued. */
export interface Mesher {
  meshProject(
    project: Project,
    options?: MeshOptions,
    control?: RunControl,
  ): Promise<MeshResult>;
  fillSurface(
    surface: SurfaceInput,
    options?: MeshOptions,
    control?: RunControl,
  ): Promise<MeshResult>;
  /** Samples lines and patches for display and checks the project; tolerates broken input. */
  previewProject(project: Project): Promise<ProjectPreview>;
  /** Ends the worker; runs under way are rejected. */
  dispose(): void;
}
