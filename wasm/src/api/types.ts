/**
 * The plain data that crosses the package's border: what goes in, what comes out. Everything here
 * survives `structuredClone`; large arrays are typed arrays and are transferred, not copied.
 */

import type { DiagnosticCode } from "../diagnostics/codes.js";
import type { DiagnosticData } from "../diagnostics/data.js";
import type {
  MeshInspection,
  RepairOptions,
  SurfaceInspection,
  SurfaceRefinement,
  SurfaceRepair,
} from "./inspection.js";
import type { Project, ProjectBackground, ProjectSource } from "../project/schema.js";

/** A closed triangle surface: x y z per node, three node positions per triangle, any turning. */
export interface SurfaceInput {
  readonly points: Float64Array;
  readonly triangles: Uint32Array;
  /**
   * Per triangle the number by which messages name it, where the surface was made of another, as by `repairSurface` and
   * `refineSurface`: its number there, `NO_ORIGIN` for none. Default: its position.
   */
  readonly origin?: Uint32Array | undefined;
  /** Per node the same. */
  readonly nodeOrigin?: Uint32Array | undefined;
}

/**
 * A background grid as flat arrays: what a generated mesh becomes (`backgroundFromMesh`), at full speed
 * also with hundreds of thousands of tetrahedra.
 */
export interface BackgroundArrays {
  /** x y z per node. */
  readonly points: Float64Array;
  /** Wanted edge length per node, above 0. */
  readonly sizes: Float64Array;
  /** Per node: wanted length along its direction divided by its size, 1 or more. Default 1. */
  readonly stretchings?: Float64Array | undefined;
  /** x y z per node, of any length but 0. Needed where a stretching is above 1. */
  readonly directions?: Float64Array | undefined;
  /** Four node positions per tetrahedron, in any orientation. */
  readonly tetrahedra: Uint32Array;
  /** What this far outside still counts as covered, as in `ProjectBackground`. Default 0. */
  readonly coverageMargin?: number | undefined;
  /** In addition to those of a project. For a given surface they may be all there is. */
  readonly sources?: readonly ProjectSource[] | undefined;
}

/** How a surface is refined: by the sizes that it will be filled with. */
export interface RefineOptions extends MeshOptions {
  /**
   * What the surface encloses, as `inspectSurface` tells it, in cubed model units: then sizes by which the inside would
   * have more tetrahedra than a run makes are refused before anything is divided. Without it only the triangles count.
   */
  readonly volume?: number | undefined;
}

/** How a project is previewed. */
export interface PreviewOptions {
  /** The uniform size that the project will be meshed with: then its grid is not checked. */
  readonly size?: number | undefined;
  /** As among the `MeshOptions`, for what is said about regions and cavities. */
  readonly innerShells?: InnerShells | undefined;
  /** As among the `MeshOptions`: the grid that the project will be meshed with, in place of its own. */
  readonly background?: BackgroundArrays | undefined;
}

/** How a given surface is judged. */
export interface InspectionOptions {
  /**
   * As among the `MeshOptions` it will be filled with: closed parts within a body bound cavities and must be turned so,
   * or regions, which either way will do. Default `cavities`.
   */
  readonly innerShells?: InnerShells | undefined;
  /**
   * Of each code so many findings are listed, and the others counted: a whole number from 1 to a million. Default
   * 1000. Each takes about 0.8 kB of memory and 10 µs.
   */
  readonly maxDiagnostics?: number | undefined;
}

/** How a covering grid is built. */
export interface CoverOptions {
  /** At every node, in model units. Default: a twentieth of the model's diagonal. */
  readonly size?: number | undefined;
  /** Five tetrahedra that fill a box, or a single one. Default `box`. */
  readonly shape?: "box" | "tetrahedron" | undefined;
}

/** What `proposeSizes` looks at. */
export interface ProposalOptions {
  /** The largest size. Default: a twentieth of the model's diagonal. */
  readonly uniform?: number | undefined;
  /** No proposal below this. Default: a fiftieth of the largest. */
  readonly smallest?: number | undefined;
  /** Around a full turn of a curved line or patch; 0 leaves curvature out. Default 24. */
  readonly elementsPerCircle?: number | undefined;
  /** Between opposite patches, across the inside; 0 leaves nearness out. Default 3. */
  readonly elementsPerGap?: number | undefined;
  /** Of the proposed sources, per unit of distance. Default 0.3. */
  readonly growth?: number | undefined;
}

/** Sizes that a model seems to ask for. */
export interface SizeProposal {
  /** Uniform, to be refined by the sources; 0 where there is nothing to see. */
  readonly size: number;
  /** The smallest first, with ids from 1. */
  readonly sources: readonly ProjectSource[];
}

/** What a closed part of the boundary bounds that lies within a body and shares no line with it. */
export type InnerShells = "cavities" | "regions";
/** In which order faces leave the front. */
export type FrontOrder = "layered" | "smallest-first";
/** How much work goes into the shape of the elements after the front. */
export type Optimization = "none" | "fast" | "default" | "thorough";

/** How a project or a surface is meshed. */
export interface MeshOptions {
  /**
   * Element size in model units, from 1e-30 to 1e30. Replaces the nodes and tetrahedra of a project's background grid,
   * not its sources; within a given surface it is the largest. Not together with `background`, unless that has
   * sources only.
   *
   * A given surface is kept: where its triangles are larger than wanted, by this or by a grid or sources, so are
   * the elements beside them (`coarse-surface`), and sizes fall inwards by `growth`, at most 0.5, per unit of
   * distance. `refineSurface` divides them first.
   */
  readonly size?: number | undefined;
  /**
   * Sizes from these nodes and tetrahedra, which must cover the model: in place of those of a project
   * (its sources stay), or of a given surface's own edges, if there are any.
   */
  readonly background?: BackgroundArrays | undefined;
  /** Growth of the size per unit of distance from a given surface's edges, 0 to 10. Default 0.3. */
  readonly growth?: number | undefined;
  /**
   * The most by which sizes of the background grid may grow from one element to the next, above 1 and up to 10;
   * nodes that ask for more are given less. Default 1.3; 0 takes all grids as they are.
   */
  readonly gradation?: number | undefined;
  /**
   * Default `cavities`: parts of the boundary within a body bound empty spaces. With `regions` every
   * space is filled, as a region of its own that fits what is around it.
   */
  readonly innerShells?: InnerShells | undefined;
  /** In which order faces leave the front. Default `layered`; `smallest-first` is the paper's. */
  readonly order?: FrontOrder | undefined;
  /**
   * Whether faces that cannot cross a new element are told from the others cheaply, as the paper does,
   * before the analysis of the rest. Default true; false gives the same mesh, slower, to show what the
   * filters are worth.
   */
  readonly filters?: boolean | undefined;
  /** Default `default`; `none` leaves the mesh as the front made it. */
  readonly optimization?: Optimization | undefined;
  /** For tests: no front; the whole inside goes to the exact fill that otherwise comes last. */
  readonly exactFillOnly?: boolean | undefined;
}

/** How a run ended. Only `done` is a complete mesh; `stalled` and `cancelled` may hold a part. */
export type MeshStatus = "done" | "stalled" | "cancelled" | "invalid-input";
/** The stages of a run in their order. */
export type Phase = "check" | "sides" | "surface" | "volume" | "optimize" | "verify";

/** Where a run stands, or any other call; in all but runs the phase is `check`, and there are no counts. */
export interface Progress {
  readonly phase: Phase;
  /** Of the whole call, 0 to 1, estimated, never decreasing. */
  readonly fraction: number;
  readonly nodes: number;
  readonly triangles: number;
  readonly tetrahedra: number;
  readonly frontFaces: number;
  /** As many as the sizes ask for, estimated before the front starts; 0 until then. */
  readonly expectedTetrahedra: number;
  /** How far the exact fill is with what the front has left open, 0 to 1, estimated; 0 while it is not at work. */
  readonly exactFillFraction: number;
  readonly elapsedSeconds: number;
}

/** How a run is followed and stopped. */
export interface RunControl {
  /**
   * Called at most ten times a second, and once at the end. What it throws, or its promise is rejected with, ends
   * the call, which is rejected with just that.
   */
  readonly onProgress?: ((progress: Progress) => void) | undefined;
  /**
   * Called by `meshProject` and `fillSurface` at most four times a second while the front advances, with x y z of the
   * three corners of each of its faces. The caller owns the array. Costs at most 2 % of the run's time. A failure of
   * this function has the same effect as one of `onProgress`.
   */
  readonly onFront?: ((corners: Float64Array) => void) | undefined;
  /**
   * Aborting ends `meshProject` and `fillSurface` with status `cancelled`, as a rule within 100 ms, and what exists is
   * returned. Where the engine does not answer within half a second it is ended by force, and the mesh is empty. All other calls have no result of that kind, and
   * are rejected with a `MesherError` of code `cancelled`.
   */
  readonly signal?: AbortSignal | undefined;
}

/** How `createMesher` is stopped. */
export interface AbortControl {
  /** Aborting rejects the call with a `MesherError` of code `cancelled`. */
  readonly signal?: AbortSignal | undefined;
}

/** A mesh from anywhere: as `VolumeMesh`, but elements may be turned either way. */
export interface MeshInput {
  /** x y z per node. */
  readonly points: Float64Array;
  /** Four node positions per element. */
  readonly tetrahedra: Uint32Array;
  /** One per element; without, all are in region 0. */
  readonly regions?: Uint32Array | undefined;
  /** Elements that were inverted in the file they are from, as `FileMesh` tells; they count as turned. */
  readonly invertedTetrahedra?: Uint32Array | undefined;
}

/** What a diagnostic can be about. */
export type EntityKind =
  | "point"
  | "line"
  | "patch"
  | "background-node"
  | "background-tetrahedron"
  | "triangle"
  | "surface-node"
  | "source";

/** What a diagnostic is about. `id` is the project's id where the entity has one. */
export interface EntityRef {
  readonly kind: EntityKind;
  /** Position in the array of that kind. */
  readonly index: number;
  readonly id?: number | undefined;
  /** What the user called it, else e.g. "line 12". */
  readonly label: string;
}

/** Only errors keep a model from being meshed. */
export type Severity = "information" | "warning" | "error";

/** A diagnostic of one code. */
export interface DiagnosticOf<Code extends DiagnosticCode> {
  /** Stable machine name, e.g. `open-edge`. */
  readonly code: Code;
  readonly severity: Severity;
  /** One sentence: what is wrong, naming the entities and the place. */
  readonly message: string;
  /** One sentence: what to do about it. Empty for information that asks for nothing. */
  readonly remedy: string;
  readonly entities: readonly EntityRef[];
  readonly position?: readonly [number, number, number] | undefined;
  /** The numbers of the sentence, by their names. */
  readonly data: DiagnosticData[Code];
}

/**
 * One thing that is wrong, or worth knowing: what, where, and what to do. Its `code` tells of what type its `data` are.
 *
 *     if (found.code === "too-many-elements") retry(Math.cbrt(found.data.expected / found.data.limit));
 */
export type Diagnostic = { [Code in DiagnosticCode]: DiagnosticOf<Code> }[DiagnosticCode];

/**
 * The boundary. Node i is at points[3i..3i+2] of the mesh; triangle t has the nodes
 * triangles[3t..3t+2], counter-clockwise seen from outside. A wall between two regions is there once,
 * turned either way.
 */
export interface SurfaceMesh {
  readonly points: Float64Array;
  readonly triangles: Uint32Array;
  /** Per triangle: position of its patch in the project; for a given surface, its shell. */
  readonly trianglePatch: Uint32Array;
  /**
   * Two per triangle: the region from which its nodes are seen clockwise, and the one from which they
   * are seen counter-clockwise, `NO_REGION` but for walls. Empty until the boundary is known to
   * close.
   */
  readonly triangleRegions: Uint32Array;
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

/** Wall-clock seconds. `check` includes the verification of the result; `total` includes copying it,
 * and is all that is known of a run that had to be ended by force: the phases are 0 then. */
export interface Seconds {
  readonly total: number;
  readonly check: number;
  readonly sides: number;
  readonly surface: number;
  readonly volume: number;
  readonly optimize: number;
}

/** The triangulation of one patch of a project. */
export interface PatchQuality {
  /** Position in the project. */
  readonly patch: number;
  readonly triangles: number;
  /** Degrees, in space. */
  readonly minAngle: number;
  /** 2 × inradius / circumradius, 1 for the equilateral triangle. */
  readonly meanRadiusRatio: number;
  /** Length over the wanted one, in the metric: 1 is as asked for. */
  readonly meanEdge: number;
  /** Largest distance between a triangle and the true patch, in model units. */
  readonly chordDeviation: number;
}

/** One tetrahedron of the report. Shapes are those the size field sees (see `QualityReport`). */
export interface ElementQuality {
  /** Position in the volume mesh. */
  readonly tetrahedron: number;
  /** Its centroid. */
  readonly centroid: readonly [number, number, number];
  /** In cubed model units. */
  readonly volume: number;
  /** Degrees. */
  readonly dihedral: { readonly min: number; readonly max: number };
  readonly radiusRatio: number;
}

/** Histograms over one region; bin i counts what is in [i, i + 1) bin widths. */
export interface RegionQuality {
  /** As in `VolumeMesh.regions`. */
  readonly region: number;
  readonly tetrahedra: number;
  readonly volume: number;
  /** Of all six dihedral angles of each tetrahedron. */
  readonly dihedral: readonly number[];
  /** Of the smallest of each. */
  readonly smallestDihedral: readonly number[];
  readonly radiusRatio: readonly number[];
  /** Of each edge's length by the wanted one; the last bin also counts all longer ones. */
  readonly edge: readonly number[];
}

/** Each tetrahedron counts under the first of the three reasons that applies. */
export interface LimitedByBoundary {
  readonly count: number;
  /**
   * Forced by an edge of the boundary: the inside takes less than 30° there, or less than 60°, which
   * one tetrahedron only can fill, and that one has other angles beyond.
   */
  readonly edges: number;
  /** With an edge of a needle or cap among the boundary's triangles: experience, not proof. */
  readonly needles: number;
  /**
   * Between two parts of the boundary nearer to each other than 0.6 wanted lengths, without a node
   * inside: neither a proof.
   */
  readonly narrowGaps: number;
  readonly worst: readonly ElementQuality[];
}

/** Lengths of edges. Wanted are those asked for, whether a given surface allows them or not. */
export interface EdgeStatistics {
  /** The mean of length by wanted length. */
  readonly mean: number;
  /**
   * The mean of length by the length wanted of the front: longer beside triangles of a given surface that
   * are too large (`coarse-surface`), the same everywhere else.
   */
  readonly meanOfAchievable: number;
  /** The share of edges between 0.6 and 1.5 wanted lengths. */
  readonly nearTarget: number;
}

/**
 * The elements of a finished mesh. Shapes and lengths are those the size field sees: where it is
 * stretched, in the space where the wanted element is regular with edge 1.
 */
export interface QualityReport {
  /** Degrees for angles. */
  readonly binWidths: { readonly dihedral: number; readonly radiusRatio: number; readonly edge: number };
  readonly regions: readonly RegionQuality[];
  /** Up to ten, worst first, by their angles. */
  readonly worst: readonly ElementQuality[];
  /** By volume. */
  readonly smallest: ElementQuality | null;
  /** Largest by smallest volume. */
  readonly volumeRatio: number;
  /** Of all edges. */
  readonly edges: EdgeStatistics;
  /** Tetrahedra with an angle below 30° or above 135° which the boundary does not excuse. */
  readonly outOfRange: number;
  /** Those it does. */
  readonly limitedByBoundary: LimitedByBoundary;
}

/** The figures of a run, and all it has to say. */
export interface MeshReport {
  readonly status: MeshStatus;
  readonly nodes: number;
  readonly tetrahedra: number;
  readonly triangles: number;
  readonly seconds: Seconds;
  /** Degrees, over all tetrahedra as they lie in space, stretched or not; 0 without any. */
  readonly dihedral: { readonly min: number; readonly max: number };
  /** 3 × inradius / circumradius, 1 for the regular tetrahedron, in space too; 0 without any. */
  readonly radiusRatio: { readonly min: number; readonly mean: number };
  /** Sum over the tetrahedra, in cubed model units. */
  readonly volume: number;
  /** Empty unless the mesh is finished. */
  readonly quality: QualityReport;
  /** By position of the patch; of a given surface none. */
  readonly patches: readonly PatchQuality[];
  /** How the front was brought to an end. */
  readonly recovery: {
    /** Elements accepted by a relaxed rule. */
    readonly relaxed: number;
    /** Pockets filled from one interior point. */
    readonly starred: number;
    /** Pockets filled after elements around them were removed. */
    readonly remeshed: number;
    /** Pockets given to the exact fill, which comes last. */
    readonly filled: number;
    /** Interior points that the exact fill has made. */
    readonly steinerPoints: number;
  };
  /** How hard the front worked. */
  readonly front: {
    readonly pops: number;
    readonly gatheredFaces: number;
    readonly candidatesTried: number;
    readonly facesTested: number;
    readonly facesAnalysed: number;
    readonly exactPredicates: number;
  };
  /**
   * 16 hexadecimal digits: a hash over coordinates and indices, equal on every platform for the same
   * input and options. Empty where the run was cancelled or never began.
   */
  readonly fingerprint: string;
  readonly diagnostics: readonly Diagnostic[];
}

/** A mesh with its boundary and its report; after a run that ended early, what exists. */
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

/** One mesher: an engine in a worker of its own (browser and Node). Runs are queued. */
export interface Mesher {
  /**
   * Meshes a drawn project: lines, patches, closed boundary, volume. Bad input is a result with status
   * `invalid-input` and diagnostics. Rejects with a `MesherError` when memory runs out, when the
   * mesher is disposed of, or when the engine itself fails.
   */
  meshProject(project: Project, options?: MeshOptions, control?: RunControl): Promise<MeshResult>;
  /**
   * Fills a closed surface, kept triangle for triangle: nothing is repaired, which is for `repairSurface`. Only in
   * what is returned all triangles face outward, also where a whole part of the surface was given inside out, which is
   * said. Without `size` the sizes come from the surface's own edges. Ends and rejects as `meshProject` does.
   */
  fillSurface(surface: SurfaceInput, options?: MeshOptions, control?: RunControl): Promise<MeshResult>;
  /**
   * Samples lines and patches for display and checks the project; tolerates broken input. Answered
   * between the slices of a run, so that editing goes on while a mesh is made. Options that make no
   * sense are among the diagnostics.
   */
  previewProject(project: Project, options?: PreviewOptions, control?: RunControl): Promise<ProjectPreview>;
  /**
   * A background grid of one size around the points, lines and patches, which keeps the project's
   * sources. Answered as `previewProject`. Rejects with `invalid-input` where there is nothing to cover.
   */
  coverProject(project: Project, options?: CoverOptions, control?: RunControl): Promise<ProjectBackground>;
  /**
   * Sizes from the model's shape: a uniform one, and sources where lines and patches bend or come near
   * each other. A proposal, not a promise. Answered as `previewProject`.
   */
  proposeSizes(project: Project, options?: ProposalOptions, control?: RunControl): Promise<SizeProposal>;
  /**
   * A generated mesh as background grid: with one size per node, else with sizes from its own edges,
   * which ask for about as many elements as it has. Nodes of no tetrahedron are left out. Rejects with
   * `invalid-input` where the arrays do not fit together.
   */
  backgroundFromMesh(
    mesh: Pick<VolumeMesh, "points" | "tetrahedra">,
    options?: { readonly sizes?: Float64Array | undefined },
    control?: RunControl,
  ): Promise<BackgroundArrays>;
  /**
   * Everything about a given surface, by the checks that filling begins with: whether it is closed,
   * manifold and free of crossings, its bodies and cavities, its figures, and all that is wrong with ids
   * and places. Rejects with `invalid-input` only where the arrays are none. O(n log n); about a
   * microsecond per triangle. Works in slices beside a run.
   */
  inspectSurface(
    surface: SurfaceInput,
    options?: InspectionOptions,
    control?: RunControl,
  ): Promise<SurfaceInspection>;
  /**
   * Makes the repairs that are asked for, in a copy, and lists every one; `inspectSurface` then tells what
   * they were good for. Rejects with `invalid-input` where coordinates or indices are broken. Works in steps
   * beside a run.
   */
  repairSurface(surface: SurfaceInput, options?: RepairOptions, control?: RunControl): Promise<SurfaceRepair>;
  /**
   * Divides the triangles of a surface that are larger than the elements wanted there, so that `fillSurface`
   * with the same options can have these (otherwise it warns with `coarse-surface`). Edges longer than 1.41
   * wanted lengths are halved in all their triangles, the longest of a triangle first: no angle falls below
   * half of what it was, and the shape stays the same up to the rounding of middles. Patches follow by
   * `repairedSurface(file, refinement)`. Rejects with `invalid-input` where numbers are broken, no sizes are
   * given, or the triangles would be too many; with the enclosed `volume`, also where the inside would have more
   * tetrahedra than a run makes, before anything is divided. O(n log n) for n triangles of the result; about 2 µs for each.
   * Works in slices beside a run.
   */
  refineSurface(
    surface: SurfaceInput,
    options: RefineOptions,
    control?: RunControl,
  ): Promise<SurfaceRefinement>;
  /**
   * Whether a mesh is sound, how good its elements are, and its boundary. Rejects with `invalid-input`
   * where coordinates or indices are broken. O(n log n); about a microsecond per element. Works in slices beside
   * a run.
   */
  inspectMesh(mesh: MeshInput, control?: RunControl): Promise<MeshInspection>;
  /** Ends the worker; runs under way are rejected. */
  dispose(): void;
}
