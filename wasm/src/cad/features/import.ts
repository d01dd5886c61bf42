/** A CAD file as the first feature of a solid. */
import { kindsOfBrep } from "../brep-model.js";
import { looksOf, ownName } from "../step-looks.js";
import type { FaceLook, PieceKinds } from "./feature.js";
import { FeatureError, type FeatureKernel, Session } from "./session.js";

export interface PartFile {
  readonly format: "step" | "brep";
  readonly bytes: Uint8Array;
  /** Length of the unit of the file in that of the project: STEP files are read in millimetres, BREP files have no unit. */
  readonly scale: number;
}

const PATH = "/part";

/** What a file gives to the feature. */
export type ImportedPart = PieceKinds["import"];

/** Returns the solids of a file, with the names and colours of their faces. Throws a FeatureError if it has none. */
export function partOfFile(kernel: FeatureKernel, file: PartFile): ImportedPart {
  const brep = brepOfFile(kernel, file);
  if (file.format !== "step") return { brep };
  const kinds = kindsOfBrep(brep, "");
  const found = looksOf(latin(file.bytes), kinds);
  const looks = kinds.flatMap((own, s) =>
    own.map((_, f): FaceLook => {
      const { name = "", color } = found[s]?.faces[f] ?? {};
      return { name: ownName(name), color };
    }),
  );
  const areKnown = looks.some(({ name, color }) => name !== undefined || color !== undefined);
  return areKnown ? { brep, looks } : { brep };
}

const latin = (bytes: Uint8Array): string => new TextDecoder("latin1").decode(bytes);

/** Returns the solids of a file as the text of a BREP file. */
function brepOfFile(kernel: FeatureKernel, file: PartFile): string {
  const session = new Session(kernel);
  try {
    const shape = session.hold(
      file.format === "step"
        ? stepShape(session, file.bytes)
        : kernel.BRepToolsWrapper.Read(latin(file.bytes)),
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
