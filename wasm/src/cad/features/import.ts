/** A CAD file as the first feature of a solid. */
import { FeatureError, type FeatureKernel, Session } from "./session.js";

export interface PartFile {
  readonly format: "step" | "brep";
  readonly bytes: Uint8Array;
  /** Length of the unit of the file in that of the project: STEP files are read in millimetres, BREP files have no unit. */
  readonly scale: number;
}

const PATH = "/part";

/** Returns the solids of a file as the text of a BREP file. Throws a FeatureError if it has none. */
export function brepOfFile(kernel: FeatureKernel, file: PartFile): string {
  const session = new Session(kernel);
  try {
    const shape = session.hold(
      file.format === "step"
        ? stepShape(session, file.bytes)
        : kernel.BRepToolsWrapper.Read(new TextDecoder("latin1").decode(file.bytes)),
    );
    const solids = shape.IsNull() ? [] : session.parts(shape, "solid");
    if (solids.length === 0)
      throw new FeatureError("The file has no solid.", "Export the part again, as a solid.");
    const whole = session.together(solids);
    if (file.scale === 1) return kernel.BRepToolsWrapper.Write(whole);
    const scaling = session.hold(new kernel.gp_Trsf());
    scaling.SetScaleFactor(file.scale);
    const maker = session.hold(new kernel.BRepBuilderAPI_Transform(whole, scaling, true, false));
    return kernel.BRepToolsWrapper.Write(session.hold(maker.Shape()));
  } finally {
    session.free();
  }
}

function stepShape(session: Session, bytes: Uint8Array) {
  const { FS, STEPControl_Reader, IFSelect_ReturnStatus } = session.kernel;
  FS.writeFile(PATH, bytes);
  try {
    const reader = session.hold(new STEPControl_Reader());
    if (reader.ReadFile(PATH) === IFSelect_ReturnStatus.IFSelect_RetDone)
      reader.TransferRoots(session.progress());
    return reader.OneShape();
  } finally {
    FS.unlink(PATH);
  }
}
