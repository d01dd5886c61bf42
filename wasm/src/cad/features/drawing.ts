/**
 * The faces of a solid as lines and patches that can be drawn. A face becomes one patch if a kind of patch fits its loops: plane
 * faces, faces with three or four edges, cylinders and cones between two rims. Full turns of spheres, cones with an apex and tori
 * become several, between quarters of circles.
 */
import { trimmedModelOfBrep } from "../brep-model.js";
import { evaluate } from "./evaluate.js";
import type { Feature, FeatureFailure } from "./feature.js";
import type { FeatureKernel } from "./session.js";
import { cross, dot, lengthOf, minus, plus, type Vector } from "../../base/vectors.js";
import { isRound, positionOnCurve, positionOnRound, type RoundSurface } from "../curve-positions.js";
import type { Coedge, FaceSurface, TrimmedEdge, TrimmedFace, TrimmedModel } from "../trimmed-model.js";

type DrawnLineType = "straight" | "arc" | "circle" | "spline";
type DrawnPatchType = "planar" | "coons" | "gregory" | "nielson" | "barnhill-gregory-nielson" | "tube";

/** Patches in the terms of a project; lines and points are referred to by their numbers: those of lines begin with 1. */
export interface SolidDrawing {
  readonly points: readonly Vector[];
  readonly lines: readonly { readonly type: DrawnLineType; readonly points: readonly number[] }[];
  readonly patches: readonly DrawnPatch[];
  /** Indices of the faces that no patch fits. */
  readonly left: readonly number[];
}

export interface DrawnPatch {
  readonly type: DrawnPatchType;
  /** A negative number traverses a line backwards. */
  readonly loops: readonly (readonly number[])[];
  /** Index of its face in the model. */
  readonly face: number;
  /** Whether the patch is the face itself; else both have the same edges, or nearly. */
  readonly isExact: boolean;
}

const QUARTER = Math.PI / 2;
/** Angles and distances that differ by less, as a part of a turn or of a size, are the same. */
const SAME = 1e-9;
/** A patch whose edges turn by more is far from the face: edges of a quarter turn, measured along chords, do not. */
const MAX_TURN = QUARTER + 1e-6;
/** Positions on a curve of the kernel by which a spline of ours goes: for each turn of an ellipse, and for each piece of a spline. */
const PER_TURN = 32;
const PER_PIECE = 4;

export interface DrawnSolid {
  /** Undefined if the features give no solid. */
  readonly drawing: SolidDrawing | undefined;
  /** The name of each face by origin. */
  readonly faces: readonly string[];
  readonly failures: readonly FeatureFailure[];
  /** Whether the kernel must not be used again. */
  readonly isKernelSpent: boolean;
}

/** Draws the solid of features. */
export function drawnSolid(kernel: FeatureKernel, features: readonly Feature[]): DrawnSolid {
  const { brep, faces, failures, isKernelSpent } = evaluate(kernel, features);
  const rest = { faces, failures, isKernelSpent };
  if (brep === "") return { drawing: undefined, ...rest };
  const model = trimmedModelOfBrep(brep, "solid");
  if (model.faces.length !== faces.length)
    throw new Error("Solids that share faces, or have faces of other kinds of surfaces, cannot be drawn.");
  return { drawing: drawingOf(model), ...rest };
}

/** Draws a model of solids. */
export function drawingOf(model: TrimmedModel): SolidDrawing {
  return new Drawing(model).drawn();
}

type LoopSteps = number[];
type AddPatch = (type: DrawnPatchType, loops: readonly LoopSteps[], isExact: boolean) => void;

class Drawing {
  readonly #model: TrimmedModel;
  readonly #points: Vector[] = [];
  readonly #lines: { readonly type: DrawnLineType; readonly points: readonly number[] }[] = [];
  readonly #patches: DrawnPatch[] = [];
  readonly #vertices = new Map<number, number>();
  /** The lines of each edge, from its start to its end. */
  readonly #edges = new Map<number, LoopSteps>();
  /** Circles that are divided into quarters, because the patches of a sphere or torus end there. */
  readonly #divided = new Set<number>();

  constructor(model: TrimmedModel) {
    this.#model = model;
    for (const face of model.faces)
      if (this.#isTurned(face)) for (const { edge } of this.#rimsOf(face).flat()) this.#divided.add(edge);
  }

  drawn(): SolidDrawing {
    const left: number[] = [];
    this.#model.faces.forEach((face, index) => {
      const before = this.#patches.length;
      this.#draw(face, index);
      if (this.#patches.length === before) left.push(index);
    });
    return { points: this.#points, lines: this.#lines, patches: this.#patches, left };
  }

  #draw(face: TrimmedFace, index: number): void {
    const surface = this.#surfaceOf(face);
    if (!surface) return;
    const add: AddPatch = (type, loops, isExact) => {
      const turned = face.reversed ? loops.map((loop) => loop.toReversed().map((step) => -step)) : loops;
      this.#patches.push({ type, loops: turned, face: index, isExact });
    };
    if (surface.kind === "plane") {
      const byArea = face.loops.toSorted((a, b) => this.#areaOf(b) - this.#areaOf(a));
      const [outer, ...holes] = byArea.map((loop) => this.#steps(loop));
      if (outer) add("planar", [outer, ...holes], this.#isCircular(face.loops.flat()));
    } else if (this.#isTurned(face)) this.#drawTurned(face, add);
    else if (hasSeam(face)) this.#drawTube(face, surface, add);
    else if (face.loops.length === 1) this.#drawSided(face, surface, add);
  }

  #drawSided(face: TrimmedFace, surface: FaceSurface, add: AddPatch): void {
    const edges = face.loops.flat().filter(({ edge }) => this.#curveOf(edge) !== undefined);
    const kinds = edges.map(({ edge }) => this.#curveOf(edge)?.kind).join();
    const isRuled = /^line,(\w+),line,\1$|^(\w+),line,\2,line$/.test(kinds);
    const isExact =
      isRuled && (surface.kind === "cylinder" || surface.kind === "cone") && this.#isCircular(edges);
    // A patch between edges that turn far is not near the face, unless lines lead from one to the other.
    if (!isRuled && edges.some(({ edge }) => this.#turnOf(edge) > MAX_TURN)) return;
    const loop = this.#steps(edges);
    if (loop.length === 3 && edges.length === 3) add("nielson", [loop], false);
    if (loop.length === 4 && edges.length === 4) add(isRuled ? "coons" : "gregory", [loop], isExact);
  }

  /** A cylinder or cone between two rims. */
  #drawTube(face: TrimmedFace, surface: FaceSurface, add: AddPatch): void {
    const rims = this.#rimsOf(face);
    const [one, other] = rims.map((rim) => this.#steps(rim));
    if (surface.kind !== "cylinder" && surface.kind !== "cone") return;
    // A further loop is a hole.
    if (face.loops.length !== 1 || rims.length !== 2 || !one || !other) return;
    add(
      "tube",
      [one, other],
      rims.every((rim) => this.#isCircular(rim)),
    );
  }

  /** Returns whether a face is a full turn of a sphere, of a torus, or of a cone up to its apex, with whole circles as rims. */
  #isTurned(face: TrimmedFace): boolean {
    const surface = this.#surfaceOf(face);
    if (!surface || !isRound(surface) || surface.kind === "cylinder" || !hasSeam(face)) return false;
    if (surface.kind === "cone" && this.#rimsOf(face).length !== 1) return false;
    if (face.loops.length !== 1) return false;
    // A bent pipe is closed too, around itself.
    const { turn } = this.#rangeOf(face);
    return (
      Math.abs(turn - 4 * QUARTER) < 1e-6 &&
      this.#rimsOf(face).every((rim) => rim.length === 1 && this.#isWhole(rim))
    );
  }

  #drawTurned(face: TrimmedFace, add: AddPatch): void {
    const surface = this.#surfaceOf(face) as RoundSurface;
    const { u, low, high } = this.#rangeOf(face);
    const rows = surface.kind === "cone" ? 1 : Math.max(1, Math.ceil((high - low) / QUARTER - SAME));
    const rings = Array.from({ length: rows + 1 }, (_, r) => low + ((high - low) * r) / rows);
    const isRing = surface.kind === "torus" && Math.abs(high - low - 4 * QUARTER) < SAME;
    const circles = rings.map((v, r) =>
      isRing && r === rows ? null : (this.#rimAt(face, surface, u, v) ?? this.#ring(surface, u, v)),
    );
    const circleAt = (r: number) => circles[r] ?? circles[0] ?? { points: [], lines: [] };
    const meridians = rings.slice(1).map((v, r) =>
      [0, 1, 2, 3].map((k) => {
        const [from, to] = [circleAt(r).points[k] ?? 0, circleAt(r + 1).points[k] ?? 0];
        if (surface.kind === "cone") return this.#line("straight", [from, to]);
        const middle = positionOnRound(surface, u + k * QUARTER, ((rings[r] ?? 0) + v) / 2);
        return this.#line("arc", [from, this.#point(middle), to]);
      }),
    );
    meridians.forEach((own, r) => {
      for (let k = 0; k < 4; k++) {
        const [left = 0, right = 0] = [own[k], own[(k + 1) % 4]];
        const [bottom, top] = [circleAt(r).lines[k], circleAt(r + 1).lines[k]];
        const isFan = surface.kind === "cone";
        // The second line of a fan is its base.
        const loop = isFan
          ? [-left, bottom ?? [], right, top === undefined ? [] : -top].flat()
          : [bottom ?? [], right, top === undefined ? [] : -top, -left].flat();
        const type = isFan ? "barnhill-gregory-nielson" : loop.length === 3 ? "nielson" : "gregory";
        add(type, [loop], false);
      }
    });
  }

  /** Returns the least angle of a face of a round surface, how far it turns from there, and the range of v. */
  #rangeOf(face: TrimmedFace): {
    readonly u: number;
    readonly turn: number;
    readonly low: number;
    readonly high: number;
  } {
    const coedges = face.loops.flat();
    const corners = coedges.flatMap(({ edge, inPlane }) => {
      const { first, last } = this.#edge(edge);
      if (inPlane.kind !== "line") return [];
      const { origin, x } = inPlane.frame;
      return [first, last].map((t) => [origin[0] + t * x[0], origin[1] + t * x[1]] as const);
    });
    const [us, vs] = [corners.map(([u]) => u), corners.map(([, v]) => v)];
    const u = Math.min(...us);
    return { u, turn: Math.max(...us) - u, low: Math.min(...vs), high: Math.max(...vs) };
  }

  /** Returns the points and lines of the rim of a full turn at v, from the seam on in the direction of u; null if there is none. */
  #rimAt(face: TrimmedFace, surface: RoundSurface, u: number, v: number) {
    const start = positionOnRound(surface, u, v);
    for (const [rim] of this.#rimsOf(face)) {
      if (!rim || rim.inPlane.kind !== "line") continue;
      const { origin, x } = rim.inPlane.frame;
      if (!(Math.abs(origin[1] - v) < 1e-6 * Math.max(1, Math.abs(v)))) continue;
      const along = this.#stepsOf(rim.edge);
      const lines = x[0] > 0 ? along : along.toReversed().map((step) => -step);
      const points = lines.map((step) => this.#endsOf(step)[0]);
      const first = this.#points[points[0] ?? 0] ?? start;
      if (lengthOf(minus(first, start)) > 1e-6 * (1 + lengthOf(start))) continue;
      return { points, lines };
    }
    return null;
  }

  /** Returns the points and lines of a circle at v, or of a pole, which has no lines. */
  #ring(surface: RoundSurface, u: number, v: number) {
    const at = (turns: number): Vector => positionOnRound(surface, u + turns * QUARTER, v);
    const isPole = lengthOf(minus(at(0), at(2))) <= 1e-9 * (1 + lengthOf(at(0)));
    if (isPole) {
      const pole = this.#point(at(0));
      return { points: [pole, pole, pole, pole], lines: [] };
    }
    const points = [0, 1, 2, 3].map((k) => this.#point(at(k)));
    const lines = points.map((from, k) =>
      this.#line("arc", [from, this.#point(at(k + 0.5)), points[(k + 1) % 4] ?? from]),
    );
    return { points, lines };
  }

  /** Returns whether the only edge of a rim is a whole circle. */
  #isWhole([only]: readonly Coedge[]): boolean {
    if (!only || this.#curveOf(only.edge)?.kind !== "circle") return false;
    const { start, end } = this.#edge(only.edge);
    return start === end;
  }

  #isCircular(coedges: readonly Coedge[]): boolean {
    return coedges.every(({ edge }) => ["line", "circle"].includes(this.#curveOf(edge)?.kind ?? ""));
  }

  /** Returns the rims of a closed face; poles are none. */
  #rimsOf(face: TrimmedFace): readonly (readonly Coedge[])[] {
    const hasLength = ({ edge }: Coedge): boolean => this.#curveOf(edge) !== undefined;
    return allRimsOf(face)
      .map((rim) => rim.filter(hasLength))
      .filter((rim) => rim.length > 0);
  }

  #surfaceOf = (face: TrimmedFace): FaceSurface | undefined => this.#model.surfaces[face.surface];

  #edge(edge: number): TrimmedEdge {
    const found = this.#model.edges[edge];
    if (!found) throw new Error(`There is no edge ${edge}`);
    return found;
  }

  #curveOf(edge: number) {
    const { curve } = this.#edge(edge);
    return curve === undefined ? undefined : this.#model.curves[curve];
  }

  #steps(coedges: readonly Coedge[]): LoopSteps {
    return coedges.flatMap(({ edge, reversed }) => {
      const steps = this.#stepsOf(edge);
      return reversed ? steps.toReversed().map((step) => -step) : steps;
    });
  }

  #stepsOf(edge: number): LoopSteps {
    const known = this.#edges.get(edge) ?? this.#newSteps(edge);
    this.#edges.set(edge, known);
    return known;
  }

  #newSteps(index: number): LoopSteps {
    const edge = this.#edge(index);
    const curve = this.#curveOf(index);
    if (!curve) return [];
    const { first, last } = edge;
    const [from, to] = [this.#vertex(edge.start), this.#vertex(edge.end)];
    const at = (share: number): number => this.#point(positionOnCurve(curve, first + (last - first) * share));
    if (curve.kind === "line") return [this.#line("straight", [from, to])];
    const isClosed = edge.start === edge.end;
    if (curve.kind === "circle" && isClosed && this.#divided.has(index)) {
      const quarters = [from, at(0.25), at(0.5), at(0.75), to];
      return [0, 1, 2, 3].map((k) =>
        this.#line("arc", [quarters[k] ?? from, at((k + 0.5) / 4), quarters[k + 1] ?? to]),
      );
    }
    if (curve.kind === "circle")
      return isClosed
        ? [this.#line("circle", [from, at(1 / 3), at(2 / 3), from])]
        : [this.#line("arc", [from, at(0.5), to])];
    const pieces =
      curve.kind === "ellipse"
        ? (PER_TURN * (last - first)) / (4 * QUARTER)
        : PER_PIECE * Math.max(2, curve.spline.poles.length / 3 - curve.spline.degree);
    const count = Math.max(4, Math.ceil(pieces - SAME));
    const inner = Array.from({ length: count - 1 }, (_, k) => at((k + 1) / count));
    return [this.#line("spline", [from, ...inner, to])];
  }

  #endsOf(step: number): readonly [number, number] {
    const points = this.#lines[Math.abs(step) - 1]?.points ?? [];
    const [start, end] = [points[0] ?? 0, points.at(-1) ?? 0];
    return step > 0 ? [start, end] : [end, start];
  }

  /** Returns positions along an edge, both ends included; none if it has no length. */
  #samplesOf(edge: number): Vector[] {
    const curve = this.#curveOf(edge);
    if (!curve) return [];
    const { first, last } = this.#edge(edge);
    return Array.from({ length: PER_TURN + 1 }, (_, k) =>
      positionOnCurve(curve, first + ((last - first) * k) / PER_TURN),
    );
  }

  /** Returns the sum of the angles between successive directions along an edge. */
  #turnOf(edge: number): number {
    const samples = this.#samplesOf(edge);
    const steps = samples.slice(1).map((to, k) => minus(to, samples[k] ?? to));
    return steps.slice(1).reduce((turn, step, k) => {
      const before = steps[k] ?? step;
      return turn + Math.atan2(lengthOf(cross(before, step)), dot(before, step));
    }, 0);
  }

  /** Returns twice the area that a loop in a plane encloses. */
  #areaOf(loop: readonly Coedge[]): number {
    const positions = loop.flatMap(({ edge, reversed }) => {
      const samples = this.#samplesOf(edge);
      return reversed ? samples.toReversed() : samples;
    });
    const [origin] = positions;
    if (!origin) return 0;
    const areas = positions
      .slice(1)
      .map((to, k) => cross(minus(positions[k] ?? to, origin), minus(to, origin)));
    return lengthOf(areas.reduce(plus, [0, 0, 0]));
  }

  #vertex(vertex: number): number {
    const known = this.#vertices.get(vertex);
    if (known !== undefined) return known;
    const [x = 0, y = 0, z = 0] = this.#model.vertices.subarray(3 * vertex, 3 * vertex + 3);
    const made = this.#point([x, y, z]);
    this.#vertices.set(vertex, made);
    return made;
  }

  #point(position: Vector): number {
    return this.#points.push(position) - 1;
  }

  #line(type: DrawnLineType, points: readonly number[]): number {
    return this.#lines.push({ type, points });
  }
}

/** Returns whether a face is closed: the edge of its seam occurs twice. */
function hasSeam({ loops }: TrimmedFace): boolean {
  const edges = loops.flat().map(({ edge }) => edge);
  return new Set(edges).size < edges.length;
}

/** Returns the edges of a closed face between its seams, and its further loops. */
function allRimsOf({ loops }: TrimmedFace): readonly (readonly Coedge[])[] {
  const uses = new Map<number, number>();
  for (const { edge } of loops.flat()) uses.set(edge, (uses.get(edge) ?? 0) + 1);
  const isSeam = ({ edge }: Coedge): boolean => uses.get(edge) === 2;
  return loops.flatMap((loop) => {
    const start = loop.findIndex(isSeam);
    const turned = start < 0 ? loop : [...loop.slice(start), ...loop.slice(0, start)];
    const runs: Coedge[][] = [[]];
    for (const coedge of turned) {
      if (isSeam(coedge)) runs.push([]);
      else runs.at(-1)?.push(coedge);
    }
    return runs.filter((run) => run.length > 0);
  });
}
