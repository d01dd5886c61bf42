/** Solids made by the CAD kernel, and STEP files of them. */
import type { gp_Ax2, OpenCascadeInstance, TopoDS_Shape } from "replicad-opencascadejs";

import { loadKernel } from "../../wasm/dist/cad/kernel-node.js";

export type Kernel = OpenCascadeInstance;

let kernel: Promise<Kernel> | undefined;

/** Returns the kernel of this process. Its memory never shrinks, so a test that spends much of it loads one of its own. */
export const testKernel = (): Promise<Kernel> => (kernel ??= loadKernel() as unknown as Promise<Kernel>);

const PATH = "/written.step";

/** Returns a STEP file of a shape. */
export function stepOf(kernel: Kernel, shape: TopoDS_Shape): Uint8Array {
  const writer = new kernel.STEPControl_Writer();
  const asIs = kernel.STEPControl_StepModelType.STEPControl_AsIs;
  writer.Transfer(shape, asIs, true, new kernel.Message_ProgressRange());
  writer.Write(PATH);
  return (kernel.FS as { readFile(path: string): Uint8Array }).readFile(PATH);
}

export function kernelVolume(kernel: Kernel, shape: TopoDS_Shape): number {
  const properties = new kernel.GProp_GProps();
  kernel.BRepGProp.VolumeProperties(shape, properties, false, false, false);
  return properties.Mass();
}

/** Returns shapes as one. */
export function together(kernel: Kernel, shapes: readonly TopoDS_Shape[]): TopoDS_Shape {
  const [builder, compound] = [new kernel.TopoDS_Builder(), new kernel.TopoDS_Compound()];
  builder.MakeCompound(compound);
  for (const shape of shapes) builder.Add(compound, shape);
  return compound;
}

export function boxAt(kernel: Kernel, corner: readonly [number, number, number], side: number): TopoDS_Shape {
  return new kernel.BRepPrimAPI_MakeBox(new kernel.gp_Pnt(...corner), side, side, side).Shape();
}

/** Returns functions that make solids of all kinds of surfaces. */
export function solidMakers(kernel: Kernel) {
  const axes = (x: number, y: number, z: number): gp_Ax2 =>
    new kernel.gp_Ax2(new kernel.gp_Pnt(x, y, z), new kernel.gp_Dir(0, 0, 1));
  const firstEdge = (shape: TopoDS_Shape) => {
    const { TopAbs_EDGE, TopAbs_SHAPE } = kernel.TopAbs_ShapeEnum;
    return kernel.TopoDS.Edge(new kernel.TopExp_Explorer(shape, TopAbs_EDGE, TopAbs_SHAPE).Current());
  };
  const filleted = (shape: TopoDS_Shape, radius: number) => {
    const fillet = new kernel.BRepFilletAPI_MakeFillet(shape);
    fillet.Add(radius, firstEdge(shape));
    return fillet.Shape();
  };
  const cylinder = (radius: number, height: number) =>
    new kernel.BRepPrimAPI_MakeCylinder(axes(5, 5, 0), radius, height).Shape();
  const ellipse = () => {
    const edge = new kernel.BRepBuilderAPI_MakeEdge(new kernel.gp_Elips(axes(8, 0, 0), 3, 2)).Edge();
    const wire = new kernel.BRepBuilderAPI_MakeWire(edge).Wire();
    return new kernel.BRepBuilderAPI_MakeFace(wire, true).Face();
  };
  const circle = (radius: number, z: number) => {
    const edge = new kernel.BRepBuilderAPI_MakeEdge(new kernel.gp_Circ(axes(0, 0, z), radius)).Edge();
    return new kernel.BRepBuilderAPI_MakeWire(edge).Wire();
  };
  const upright = new kernel.gp_Ax1(new kernel.gp_Pnt(0, 0, 0), new kernel.gp_Dir(0, 1, 0));
  const lofted = (isRuled: boolean) => {
    const loft = new kernel.BRepOffsetAPI_ThruSections(true, isRuled, 1e-6);
    for (const [radius, z] of isRuled
      ? ([
          [3, 0],
          [1, 4],
        ] as const)
      : ([
          [3, 0],
          [1, 3],
          [2, 6],
          [2, 8],
        ] as const))
      loft.AddWire(circle(radius, z));
    return loft.Shape();
  };
  const box = () => new kernel.BRepPrimAPI_MakeBox(10, 10, 4).Shape();
  return {
    "a drilled box": () =>
      new kernel.BRepAlgoAPI_Cut(box(), cylinder(2, 4), new kernel.Message_ProgressRange()).Shape(),
    "a box with a round edge": () => filleted(box(), 1.5),
    "a ball": () => new kernel.BRepPrimAPI_MakeSphere(3).Shape(),
    "a ring": () => new kernel.BRepPrimAPI_MakeTorus(5, 2).Shape(),
    "a cylinder with a round rim": () => filleted(cylinder(4, 6), 1),
    "a frustum": () => lofted(true),
    "a vase": () => lofted(false),
    "an extruded ellipse": () =>
      new kernel.BRepPrimAPI_MakePrism(ellipse(), new kernel.gp_Vec(0, 1, 4)).Shape(),
    "a turned ellipse": () => new kernel.BRepPrimAPI_MakeRevol(ellipse(), upright).Shape(),
  } satisfies Record<string, () => TopoDS_Shape>;
}
