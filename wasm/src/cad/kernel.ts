/**
 * Reads STEP and BREP files. The kernel is `replicad-opencascadejs`: OpenCascade in WebAssembly with the
 * kernel's own classes. It reads a file, triangulates its faces, and hands out both as the text of a BREP file, which we read
 * ourselves. docs/CAD.md says why.
 */
import { trimmedModelOfBrep } from "./brep-model.js";
import { fusedSolids } from "./fused-solids.js";
import type { CadKernel, Held, Hold, Shape } from "./kernel-classes.js";
import type { Deflection, FileTexts } from "./protocol.js";
import { withLooks } from "./step-looks.js";
import { CadFileError, type TrimmedModel } from "./trimmed-model.js";

export interface ModelRequest {
  readonly format: "step" | "brep";
  readonly bytes: Uint8Array;
  /** Begins the messages of errors. */
  readonly fileName: string;
  /** Whether faces that two solids share, or parts of faces, become one: the kernel's general fuse, which takes seconds. */
  readonly sharesFaces?: boolean;
}

const PATH = "/part";

/**
 * Reads a file as a model of trimmed surfaces, in millimetres; BREP files have no unit. `kernel` is loaded only if it is needed.
 * Throws a CadFileError if the file cannot be read; then the kernel must not be used again.
 */
export async function readTrimmedModel(
  kernel: () => Promise<CadKernel>,
  { format, bytes, fileName, sharesFaces = false }: ModelRequest,
): Promise<TrimmedModel> {
  if (format === "brep" && !sharesFaces) return trimmedModelOfBrep(textOf(bytes), fileName);
  const loaded = await kernel();
  const text = withSentences(fileName, () =>
    withHeld((hold) => {
      const shape = shapeIn(loaded, { format, bytes }, hold);
      if (shape === undefined) throw new CadFileError(fileName, CANNOT_READ, REMEDY);
      const shared = sharesFaces ? fusedSolids(loaded, shape, hold)?.shape : undefined;
      return loaded.BRepToolsWrapper.Write(shared ?? shape);
    }),
  );
  const model = trimmedModelOfBrep(text, fileName);
  return format === "step" ? withLooks(model, textOf(bytes)) : model;
}

interface TextOptions {
  /** Called before the search for what solids share, which may take long or fail; without it, there is none. */
  readonly onSharing?: (() => void) | undefined;
  /** Whether the texts are returned without triangles, too. */
  readonly keepsBare?: boolean | undefined;
}

/**
 * Returns the shape of a file; undefined if the kernel rejects the file. Throws what the kernel throws; then it must not be used again.
 */
export function fileTexts(
  kernel: CadKernel,
  file: Pick<ModelRequest, "format" | "bytes">,
  deflection: Deflection,
  { onSharing, keepsBare = false }: TextOptions = {},
): (FileTexts & { readonly bare: FileTexts | undefined }) | undefined {
  return withHeld((hold) => {
    const shape = shapeIn(kernel, file, hold);
    if (shape === undefined) return undefined;
    const fused = onSharing === undefined ? undefined : fusedSolids(kernel, shape, hold, onSharing);
    const write = (one: Shape) => kernel.BRepToolsWrapper.Write(one);
    const given = fused && { text: write(shape), origins: fused.origins };
    const made = fused?.shape ?? shape;
    const bare = keepsBare ? { text: write(made), given } : undefined;
    return { text: textOfShape(kernel, made, deflection, hold), given, bare };
  });
}

/** Returns texts without triangles with some. Throws what the kernel throws. */
export function triangulatedTexts(kernel: CadKernel, bare: FileTexts, deflection: Deflection): FileTexts {
  return withHeld((hold) => {
    const shape = hold(kernel.BRepToolsWrapper.Read(bare.text));
    return { ...bare, text: textOfShape(kernel, shape, deflection, hold) };
  });
}

/** Returns a shape of the kernel as the text of a BREP file, with triangles within a distance of its faces. */
export function triangulatedShape(kernel: CadKernel, shape: Shape, deflection: Deflection): string {
  return withHeld((hold) => textOfShape(kernel, shape, deflection, hold));
}

function textOfShape(kernel: CadKernel, shape: Shape, deflection: Deflection, hold: Hold): string {
  triangulate(kernel, shape, deflection, hold);
  return kernel.BRepToolsWrapper.Write(shape);
}

/** Triangulates each solid by itself, and the faces that bound none: a relative distance depends on the box of each. */
function triangulate(kernel: CadKernel, shape: Shape, deflection: Deflection, hold: Hold): void {
  const { TopAbs_SOLID, TopAbs_FACE, TopAbs_SHAPE } = kernel.TopAbs_ShapeEnum;
  const parts: { readonly part: Shape; readonly distance: number }[] = [];
  const add = (part: Shape) => {
    const distance = deflection.distance * (deflection.isRelative ? meanSide(kernel, part, hold) : 1);
    parts.push({ part, distance });
  };
  const solids = hold(new kernel.TopExp_Explorer(shape, TopAbs_SOLID, TopAbs_SHAPE));
  for (; solids.More(); solids.Next()) add(hold(solids.Current()));
  // Faces that have triangles, which are finer, keep them: those that a smaller solid shares.
  parts.sort((one, other) => one.distance - other.distance);
  if (hold(new kernel.TopExp_Explorer(shape, TopAbs_FACE, TopAbs_SOLID)).More()) add(shape);
  for (const { part, distance } of parts)
    hold(new kernel.BRepMesh_IncrementalMesh(part, distance, false, deflection.angle, false));
}

/** Returns the mean side of the box around a shape. */
function meanSide(kernel: CadKernel, shape: Shape, hold: Hold): number {
  const box = hold(new kernel.Bnd_Box());
  kernel.BRepBndLib.Add(shape, box, false);
  if (box.IsVoid()) return 1;
  const sides =
    box.GetXMax() - box.GetXMin() + (box.GetYMax() - box.GetYMin()) + (box.GetZMax() - box.GetZMin());
  return sides / 3;
}

const CANNOT_READ = "OpenCascade cannot read the file";
const REMEDY = "Export the part again, or in another format; the file is damaged.";

const textOf = (bytes: Uint8Array): string => new TextDecoder("latin1").decode(bytes);

/** Runs a task; all objects that it holds are freed at its end. */
function withHeld<Result>(task: (hold: Hold) => Result): Result {
  const held: Held[] = [];
  const hold: Hold = (object) => {
    held.push(object);
    return object;
  };
  try {
    return task(hold);
  } finally {
    for (const object of held.toReversed()) object.delete();
  }
}

/** Runs a task; exceptions of the kernel become errors. */
function withSentences<Result>(fileName: string, task: () => Result): Result {
  try {
    return task();
  } catch (failure) {
    if (failure instanceof CadFileError) throw failure;
    const cause = failure instanceof Error ? ` (${failure.message})` : "";
    throw new CadFileError(fileName, `OpenCascade ended with an error in the file${cause}`, REMEDY);
  }
}

/** Returns the shape of a file; undefined if the kernel rejects it. */
function shapeIn(
  kernel: CadKernel,
  { format, bytes }: Pick<ModelRequest, "format" | "bytes">,
  hold: Hold,
): Shape | undefined {
  const shape = hold(
    format === "brep" ? kernel.BRepToolsWrapper.Read(textOf(bytes)) : stepShape(kernel, bytes, hold),
  );
  return shape.IsNull() ? undefined : shape;
}

function stepShape(kernel: CadKernel, bytes: Uint8Array, hold: Hold): Shape {
  kernel.FS.writeFile(PATH, bytes);
  try {
    const reader = hold(new kernel.STEPControl_Reader());
    if (reader.ReadFile(PATH) === kernel.IFSelect_ReturnStatus.IFSelect_RetDone)
      reader.TransferRoots(hold(new kernel.Message_ProgressRange()));
    return reader.OneShape();
  } finally {
    kernel.FS.unlink(PATH);
  }
}
