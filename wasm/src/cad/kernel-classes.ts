/** The classes of the kernel that are used to read files. Classes for features of solids are in `features`. */

/** An object in the kernel's memory, which must be freed. */
export interface Held {
  delete(): void;
}

/** An entry of one of the kernel's enumerations. */
export type EnumEntry = string & { readonly isEnumEntry: true };

export type Shape = Held & { IsNull(): boolean; IsSame(other: Shape): boolean; Reversed(): Shape };

interface StepReader extends Held {
  ReadFile(path: string): EnumEntry;
  TransferRoots(progress: Held): number;
  OneShape(): Shape;
}

export interface ShapeList extends Held {
  Size(): number;
  First(): Shape;
  RemoveFirst(): void;
  Append(shape: Shape): Held | undefined;
}

interface Explorer extends Held {
  More(): boolean;
  Next(): void;
  Current(): Shape;
}

interface Box extends Held {
  IsVoid(): boolean;
  GetXMin(): number;
  GetXMax(): number;
  GetYMin(): number;
  GetYMax(): number;
  GetZMin(): number;
  GetZMax(): number;
}

interface Properties extends Held {
  Mass(): number;
}

interface GeneralFuse extends Held {
  SetArguments(shapes: ShapeList): void;
  SetNonDestructive(isOn: boolean): void;
  SetGlue(glue: EnumEntry): void;
  Build(progress: Held): void;
  HasErrors(): boolean;
  HasModified(): boolean;
  Modified(shape: Shape): ShapeList;
  IsDeleted(shape: Shape): boolean;
}

interface ShapeBuilder extends Held {
  MakeCompound(compound: Shape): void;
  Add(whole: Shape, part: Shape): void;
}

/** The part of the kernel that is used here. */
export interface CadKernel {
  readonly FS: {
    writeFile(path: string, bytes: Uint8Array): void;
    unlink(path: string): void;
  };
  readonly IFSelect_ReturnStatus: { readonly IFSelect_RetDone: EnumEntry };
  readonly TopAbs_ShapeEnum: Readonly<Record<"TopAbs_SOLID" | "TopAbs_FACE" | "TopAbs_SHAPE", EnumEntry>>;
  readonly BOPAlgo_GlueEnum: { readonly BOPAlgo_GlueOff: EnumEntry };
  readonly Message_ProgressRange: new () => Held;
  readonly STEPControl_Reader: new () => StepReader;
  readonly NCollection_List_TopoDS_Shape: new (other?: ShapeList) => ShapeList;
  readonly TopExp_Explorer: new (shape: Shape, find: EnumEntry, avoid: EnumEntry) => Explorer;
  readonly ReplicadShapeHasher: { HashCode(shape: Shape, limit: number): number };
  readonly TopoDS_Builder: new () => ShapeBuilder;
  readonly TopoDS_Compound: new () => Shape;
  readonly BRepAlgoAPI_BuilderAlgo: new () => GeneralFuse;
  readonly Bnd_Box: new () => Box;
  readonly GProp_GProps: new () => Properties;
  readonly BRepGProp: {
    VolumeProperties(
      shape: Shape,
      properties: Properties,
      isClosed: boolean,
      skipsShared: boolean,
      usesTriangles: boolean,
    ): void;
  };
  readonly BRepBndLib: { Add(shape: Shape, box: Box, usesTriangles: boolean): void };
  /** Triangulates a shape. The distance is relative to the size of each edge if `isRelative`. */
  readonly BRepMesh_IncrementalMesh: new (
    shape: Shape,
    distance: number,
    isRelative: boolean,
    angle: number,
    inParallel: boolean,
  ) => Held;
  readonly BRepToolsWrapper: { Write(shape: Shape): string; Read(text: string): Shape };
}

/** Makes an instance of the kernel. */
export type CreateKernel = (options: object) => Promise<CadKernel>;

/** Keeps an object of the kernel until the task that uses it has ended. */
export type Hold = <Kept extends Held>(object: Kept) => Kept;
