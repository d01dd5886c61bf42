/** The kernel during one evaluation: all its objects that are made on the way are freed at the end. */
import type {
  BRepAlgoAPI_Common,
  BRepAlgoAPI_Cut,
  BRepAlgoAPI_Fuse,
  BRepCheck_Analyzer,
  GCPnts_TangentialDeflection,
  NCollection_List_TopoDS_Shape,
  OpenCascadeInstance,
  TopAbs_ShapeEnum,
  TopoDS_Edge,
  TopoDS_Shape,
} from "replicad-opencascadejs";

import type { Vector } from "../../base/vectors.js";

/** The kernel's classes, and how it reads the type and the message of a C++ exception. */
export type FeatureKernel = OpenCascadeInstance & {
  getExceptionMessage(exception: unknown): readonly [type: string, message: string];
  decrementExceptionRefcount(exception: unknown): void;
};

interface Held {
  delete(): void;
}

/** Why a feature is left out: a sentence, and one on what to do about it. */
export class FeatureError extends Error {
  readonly remedy: string | undefined;

  /** Without a remedy, that of the kind of feature applies. */
  constructor(message: string, remedy?: string) {
    super(message);
    this.remedy = remedy;
  }
}

type Part = "solid" | "shell" | "face" | "edge" | "vertex";

/** Objects of each kernel that are used again and again: the kernel loses 50 to 400 kB with each that is freed. */
const kept = new WeakMap<FeatureKernel, Partial<Reusable>>();

interface Reusable {
  readonly analyzer: BRepCheck_Analyzer;
  readonly divider: GCPnts_TangentialDeflection;
  readonly join: BRepAlgoAPI_Fuse;
  readonly cut: BRepAlgoAPI_Cut;
  readonly intersect: BRepAlgoAPI_Common;
}

export class Session {
  readonly kernel: FeatureKernel;
  readonly #held: Held[] = [];

  constructor(kernel: FeatureKernel) {
    this.kernel = kernel;
  }

  /** Returns an object of the kernel, which is freed at the end. */
  hold<Kept extends Held>(object: Kept): Kept {
    this.#held.push(object);
    return object;
  }

  free(): void {
    for (const object of this.#held.splice(0).toReversed()) object.delete();
  }

  point(position: Vector) {
    return this.hold(new this.kernel.gp_Pnt(...position));
  }

  vector(vector: Vector) {
    return this.hold(new this.kernel.gp_Vec(...vector));
  }

  direction(vector: Vector) {
    return this.hold(new this.kernel.gp_Dir(...vector));
  }

  axis(position: Vector, direction: Vector) {
    return this.hold(new this.kernel.gp_Ax1(this.point(position), this.direction(direction)));
  }

  axes(position: Vector, axis: Vector, x?: Vector) {
    const [origin, z] = [this.point(position), this.direction(axis)];
    const { gp_Ax2 } = this.kernel;
    return this.hold(x === undefined ? new gp_Ax2(origin, z) : new gp_Ax2(origin, z, this.direction(x)));
  }

  progress() {
    return this.hold(new this.kernel.Message_ProgressRange());
  }

  list(shapes: readonly TopoDS_Shape[]): NCollection_List_TopoDS_Shape {
    const list = this.hold(new this.kernel.NCollection_List_TopoDS_Shape());
    for (const shape of shapes) {
      const added = list.Append(shape) as Held | undefined;
      if (added !== undefined) this.hold(added);
    }
    return list;
  }

  /** Returns the shapes of a list that the kernel returned. */
  shapes(list: NCollection_List_TopoDS_Shape): TopoDS_Shape[] {
    this.hold(list);
    const rest = this.hold(new this.kernel.NCollection_List_TopoDS_Shape(list));
    const shapes: TopoDS_Shape[] = [];
    for (; rest.Size() > 0; rest.RemoveFirst()) shapes.push(this.hold(rest.First()));
    return shapes;
  }

  /** Returns the parts of a shape in the order of the kernel, each once. */
  parts(shape: TopoDS_Shape, part: Part): TopoDS_Shape[] {
    const found = new ShapeIndex(this);
    for (const one of this.uses(shape, part)) found.add(one);
    return found.shapes;
  }

  /** The same, with parts that occur several times. */
  uses(shape: TopoDS_Shape, part: Part): TopoDS_Shape[] {
    const { TopAbs_ShapeEnum: kinds, TopExp_Explorer } = this.kernel;
    const kind = kinds[`TopAbs_${part.toUpperCase()}` as TopAbs_ShapeEnum];
    const explorer = this.hold(new TopExp_Explorer(shape, kind, kinds.TopAbs_SHAPE));
    const uses: TopoDS_Shape[] = [];
    for (; explorer.More(); explorer.Next()) uses.push(this.hold(explorer.Current()));
    return uses;
  }

  face(shape: TopoDS_Shape) {
    return this.hold(this.kernel.TopoDS.Face(shape));
  }

  edge(shape: TopoDS_Shape) {
    return this.hold(this.kernel.TopoDS.Edge(shape));
  }

  /** Returns solids as one shape: the solid itself if there is one. */
  together(solids: readonly TopoDS_Shape[]): TopoDS_Shape {
    const [only] = solids;
    if (only !== undefined && solids.length === 1) return only;
    const builder = this.hold(new this.kernel.TopoDS_Builder());
    const compound = this.hold(new this.kernel.TopoDS_Compound());
    builder.MakeCompound(compound);
    for (const solid of solids) builder.Add(compound, solid);
    return compound;
  }

  volume(shape: TopoDS_Shape): number {
    const properties = this.hold(new this.kernel.GProp_GProps());
    this.kernel.BRepGProp.VolumeProperties(shape, properties, false, false, false);
    return properties.Mass();
  }

  /** Returns an object that is used again and again; it has the state in which it was left. */
  reused<Name extends keyof Reusable>(name: Name, make: () => Reusable[Name]): Reusable[Name] {
    const objects = kept.get(this.kernel) ?? {};
    const object = objects[name] ?? make();
    kept.set(this.kernel, { ...objects, [name]: object });
    return object;
  }

  /** Leaves behind the objects that are used again, whose state is unknown after an exception. */
  forgetReused(): void {
    kept.delete(this.kernel);
  }

  /** Returns whether the kernel finds no error in a shape, such as faces that intersect themselves. */
  isValid(shape: TopoDS_Shape): boolean {
    const { BRepCheck_Analyzer } = this.kernel;
    const analyzer = this.reused("analyzer", () => new BRepCheck_Analyzer(shape, true, false, false));
    analyzer.Init(shape, true);
    return analyzer.IsValid();
  }

  /** Returns positions along an edge, x y z each, so that straight lines between them are within an angle and a distance. */
  positionsOn(edge: TopoDS_Edge, angle: number, distance: number): Float64Array {
    const { BRepAdaptor_Curve, GCPnts_TangentialDeflection } = this.kernel;
    const divider = this.reused("divider", () => new GCPnts_TangentialDeflection());
    divider.Initialize(this.hold(new BRepAdaptor_Curve(edge)), angle, distance, 2, 1e-9, 1e-7);
    const points = new Float64Array(3 * divider.NbPoints());
    for (let p = 0; p < divider.NbPoints(); p++) {
      const point = this.hold(divider.Value(p + 1));
      points.set([point.X(), point.Y(), point.Z()], 3 * p);
    }
    return points;
  }

  /** Returns the lowest and the highest coordinates of a shape, with some margin. */
  bounds(shape: TopoDS_Shape): readonly [Vector, Vector] {
    const box = this.hold(new this.kernel.Bnd_Box());
    this.kernel.BRepBndLib.Add(shape, box, false);
    return [
      [box.GetXMin(), box.GetYMin(), box.GetZMin()],
      [box.GetXMax(), box.GetYMax(), box.GetZMax()],
    ];
  }
}

/** Shapes by identity: the same shape at the same location, in either orientation. */
export class ShapeIndex {
  readonly #session: Session;
  readonly #slots = new Map<number, number[]>();
  readonly shapes: TopoDS_Shape[] = [];

  constructor(session: Session, shapes: readonly TopoDS_Shape[] = []) {
    this.#session = session;
    for (const shape of shapes) this.add(shape);
  }

  /** Returns the index of a shape; undefined if it is not there. */
  find(shape: TopoDS_Shape): number | undefined {
    return this.#slots.get(this.#hash(shape))?.find((index) => this.shapes[index]?.IsSame(shape));
  }

  /** Returns the index of a shape, which is added if it is not there. */
  add(shape: TopoDS_Shape): number {
    const known = this.find(shape);
    if (known !== undefined) return known;
    const index = this.shapes.push(shape) - 1;
    const hash = this.#hash(shape);
    this.#slots.set(hash, [...(this.#slots.get(hash) ?? []), index]);
    return index;
  }

  #hash(shape: TopoDS_Shape): number {
    return this.#session.kernel.ReplicadShapeHasher.HashCode(shape, 0x7fffffff);
  }
}
