/** Solids of a shape that touch each other, cut along common parts of their faces by the kernel's general fuse. */
import { nearPairs } from "../base/boxes.js";
import { connectedGroups } from "../base/connected-groups.js";
import type { CadKernel, EnumEntry, Hold, Shape, ShapeList } from "./kernel-classes.js";

/** A shape whose solids share what they have in common: faces, edges and vertices. */
export interface FusedShape {
  /** The solids, in the order of the given shape. */
  readonly shape: Shape;
  /** Per solid, per face in the order of an explorer: index of the given face of which it is a part. */
  readonly origins: readonly (readonly number[])[];
}

/** A given solid, or what the fuse has made of it. */
interface Solid {
  readonly shape: Shape;
  readonly origins: readonly number[];
}

/**
 * Returns a shape with its solids fused; undefined if it has fewer than two, faces without a solid, or no solids that share
 * anything. Solids that are inside out are turned. Solids that overlap keep their faces, with those that touch them: the fuse would divide them. `hold` frees the result;
 * `onSharing` is called before the first fuse.
 */
export function fusedSolids(
  kernel: CadKernel,
  shape: Shape,
  hold: Hold,
  onSharing?: () => void,
): FusedShape | undefined {
  const { TopAbs_SOLID, TopAbs_FACE } = kernel.TopAbs_ShapeEnum;
  const given = shapesIn(kernel, shape, TopAbs_SOLID, hold);
  if (given.length < 2 || shapesIn(kernel, shape, TopAbs_FACE, hold, TopAbs_SOLID).length > 0)
    return undefined;
  const solids = given.map((one): Solid => ({ shape: one, origins: [...facesOf(kernel, one, hold).keys()] }));
  let isChanged = false;
  onSharing?.();
  const groups = connectedGroups(given.length, nearShapes(kernel, given, hold)).filter(
    (group) => group.length > 1,
  );
  for (const group of groups) {
    const made = fusedGroup(
      kernel,
      group.map((s) => outward(kernel, given[s] as Shape, hold)),
      hold,
    );
    for (const [k, solid] of (made ?? []).entries()) {
      solids[group[k] ?? 0] = solid;
      isChanged = true;
    }
  }
  if (!isChanged) return undefined;
  const [builder, whole] = [hold(new kernel.TopoDS_Builder()), hold(new kernel.TopoDS_Compound())];
  builder.MakeCompound(whole);
  for (const solid of solids) builder.Add(whole, solid.shape);
  return { shape: whole, origins: solids.map(({ origins }) => origins) };
}

/** Returns the solids that the fuse makes of some; undefined if they share nothing, or if they are not one each. Throws if the kernel fails. */
function fusedGroup(kernel: CadKernel, given: readonly Shape[], hold: Hold): Solid[] | undefined {
  const list = hold(new kernel.NCollection_List_TopoDS_Shape());
  for (const shape of given) append(list, shape, hold);
  const fuse = hold(new kernel.BRepAlgoAPI_BuilderAlgo());
  fuse.SetArguments(list);
  fuse.SetNonDestructive(true);
  // Gluing would assume that solids do not overlap.
  fuse.SetGlue(kernel.BOPAlgo_GlueEnum.BOPAlgo_GlueOff);
  fuse.Build(hold(new kernel.Message_ProgressRange()));
  if (fuse.HasErrors()) throw new Error("OpenCascade cannot find what solids share");
  if (!fuse.HasModified()) return undefined;
  const after = (shape: Shape): Shape[] => {
    const made = entriesOf(kernel, hold(fuse.Modified(shape)), hold);
    return made.length > 0 || fuse.IsDeleted(shape) ? made : [shape];
  };
  const solids = given.map((solid): Solid | undefined => {
    const [made, ...others] = after(solid);
    if (made === undefined || others.length > 0) return undefined;
    const parts = new Map<number, { readonly part: Shape; readonly face: number }[]>();
    facesOf(kernel, solid, hold).forEach((one, face) => {
      for (const part of after(one)) {
        const hash = hashOf(kernel, part);
        parts.set(hash, [...(parts.get(hash) ?? []), { part, face }]);
      }
    });
    const faces = facesOf(kernel, made, hold);
    const origins = faces.flatMap(
      (face) => parts.get(hashOf(kernel, face))?.find(({ part }) => part.IsSame(face))?.face ?? [],
    );
    return origins.length === faces.length ? { shape: made, origins } : undefined;
  });
  const areDifferent = solids.every(
    (solid, s) =>
      !solids.slice(0, s).some((other) => other !== undefined && solid?.shape.IsSame(other.shape)),
  );
  return areDifferent && solids.every((solid) => solid !== undefined) ? solids : undefined;
}

const hashOf = (kernel: CadKernel, shape: Shape): number =>
  kernel.ReplicadShapeHasher.HashCode(shape, 0x7fffffff);

/** Returns pairs of shapes whose boxes, with their tolerances, touch. */
function nearShapes(kernel: CadKernel, shapes: readonly Shape[], hold: Hold) {
  const boxes = shapes.map((shape) => {
    const box = hold(new kernel.Bnd_Box());
    kernel.BRepBndLib.Add(shape, box, false);
    if (box.IsVoid()) return { low: [Infinity], high: [-Infinity] };
    return {
      low: [box.GetXMin(), box.GetYMin(), box.GetZMin()],
      high: [box.GetXMax(), box.GetYMax(), box.GetZMax()],
    };
  });
  return nearPairs(boxes);
}

/** Returns a solid with its faces outward: inside out, it would be all of space but itself, and overlap all others. */
function outward(kernel: CadKernel, solid: Shape, hold: Hold): Shape {
  const properties = hold(new kernel.GProp_GProps());
  kernel.BRepGProp.VolumeProperties(solid, properties, false, false, false);
  return properties.Mass() < 0 ? hold(solid.Reversed()) : solid;
}

function facesOf(kernel: CadKernel, shape: Shape, hold: Hold): Shape[] {
  return shapesIn(kernel, shape, kernel.TopAbs_ShapeEnum.TopAbs_FACE, hold);
}

function shapesIn(
  kernel: CadKernel,
  shape: Shape,
  kind: EnumEntry,
  hold: Hold,
  avoid = kernel.TopAbs_ShapeEnum.TopAbs_SHAPE,
): Shape[] {
  const explorer = hold(new kernel.TopExp_Explorer(shape, kind, avoid));
  const shapes: Shape[] = [];
  for (; explorer.More(); explorer.Next()) shapes.push(hold(explorer.Current()));
  return shapes;
}

function append(list: ShapeList, shape: Shape, hold: Hold): void {
  // The list has a copy of its own.
  const added = list.Append(shape);
  if (added !== undefined) hold(added);
}

function entriesOf(kernel: CadKernel, list: ShapeList, hold: Hold): Shape[] {
  const rest = hold(new kernel.NCollection_List_TopoDS_Shape(list));
  const entries: Shape[] = [];
  for (; rest.Size() > 0; rest.RemoveFirst()) entries.push(hold(rest.First()));
  return entries;
}
