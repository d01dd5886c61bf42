/**
 * Reads STEP, IGES and BREP files by OpenCascade, which triangulates their faces. Each solid becomes a region, each
 * face a patch, in millimetres.
 */
import { askForCad, isSmallFile, notLoadedRemedy, secondsForFiner } from "../cad/cad-client.js";
import { cadLibrariesFor } from "../cad/cad-host.js";
import { DEFLECTION, PER_DIAGONAL } from "../cad/deflection.js";
import { GENERIC } from "../cad/opencascade.js";
import type { CadFormat, CadReply, CadShape } from "../cad/protocol.js";
import type { Steps } from "../base/steps.js";
import { inSteps } from "../calls/yielder.js";
import type { Mesh, TrueFaces } from "../mesh/mesh.js";
import { damagedBrep } from "./brep-counts.js";
import { allBytes, type ByteSource, piecesOf } from "./byte-source.js";
import type { MeshReader } from "./file-format.js";
import { differentNames } from "./groups.js";
import { diagonalOf } from "./near-points.js";
import { ReadFailure } from "./read-result.js";
import { joinedSurface } from "./shape-surface.js";
import { productSolids, productsOf } from "./step-products.js";
import { damagedStep, stepNotes, stepText } from "./step-text.js";
import { inUtf8 } from "./utf16.js";

const NAMES: Readonly<Record<CadFormat, string>> = { step: "STEP", iges: "IGES", brep: "BREP" };

export const readStep = readerOf("step");
export const readIges = readerOf("iges");
export const readBrep = readerOf("brep");

/** Distance of the triangles from the faces, relative to a target size: a fifth of the remesher's tolerance. */
const PER_SIZE = 1 / 100;

/** Smallest distance, relative to the diagonal of the largest part: finer triangles take minutes, or exhaust the memory. */
const FINEST = 1e-5;

function readerOf(format: CadFormat): MeshReader {
  return async (source: ByteSource, { signal, size, onWork }): Promise<Mesh> => {
    const bytes = await allBytes(inUtf8(piecesOf(source)));
    if (bytes.length === 0) throw new ReadFailure(EMPTY);
    const wrong = format === "brep" ? await inSteps(damagedBrep(bytes), signal) : undefined;
    if (wrong !== undefined) throw wrong;
    return meshOf({ format, bytes, size }, signal, onWork);
  };
}

interface CadSource {
  readonly format: CadFormat;
  readonly bytes: Uint8Array;
  readonly size: number | undefined;
}

type ReadShapes = Omit<Extract<CadReply, { readonly kind: "read" }>, "kind">;

async function meshOf(
  { format, bytes, size }: CadSource,
  signal: AbortSignal | undefined,
  onWork: ((fraction: number) => void) | undefined,
): Promise<Mesh> {
  const keepsBare = size !== undefined;
  const coarse = await shapesIn({ format, bytes, deflection: DEFLECTION, keepsBare }, signal);
  const isFine = size === undefined || coarse.shapes.every(({ points }) => isFineFor(size, points));
  const read = isFine ? coarse : await finer(coarse, { format, bytes, size }, signal);
  const { shapes: used, areApart } = read;
  const named = format === "step" ? await inSteps(namedByProducts(used, bytes), signal) : used;
  const { mesh: made, closedShapes } = await inSteps(joinedSurface(named), signal);
  const damage = format === "step" ? stepNotes(await inSteps(stepText(bytes), signal), closedShapes) : [];
  const tooSmall = isFine || read !== coarse ? [] : [TOO_SMALL];
  const apart = areApart === true ? [NOT_SHARED] : [];
  const notes = [...damage, ...(made.notes ?? []), ...tooSmall, ...apart, ...missingFaces(used, format)];
  const trueFaces = trueFacesOf(used);
  const mesh = { ...made, ...(notes.length > 0 && { notes }), ...(trueFaces && { trueFaces }) };
  onWork?.(1);
  return format === "brep" ? mesh : { ...mesh, unit: "mm" };
}

/** Returns the true faces of each shape; undefined if the library has handed out none. */
function trueFacesOf(shapes: readonly CadShape[]): TrueFaces[] | undefined {
  const all = shapes.flatMap(({ trueFaces }) => trueFaces ?? []);
  if (all.length < shapes.length || all.every(({ faceCount }) => faceCount === 0)) return undefined;
  return all.map(({ missing: _, ...faces }) => faces);
}

/** Returns why nodes will not be on true faces. */
function missingFaces(shapes: readonly CadShape[], format: CadFormat): string[] {
  const isRead = shapes.every(({ trueFaces }) => trueFaces !== undefined);
  if (!isRead && format !== "iges")
    return [`${NO_KERNEL}, and not on the faces: ${KERNEL} could not be loaded`];
  const reasons = new Set(shapes.flatMap(({ trueFaces }) => trueFaces?.missing ?? []));
  return [...reasons].map((reason) => `${NO_KERNEL} where a face cannot be described; ${reason}`);
}

const NO_KERNEL = "nodes are on triangles near its faces";
const KERNEL = "replicad-opencascadejs";

/** Returns the solids of a file with the names of the parts that they are, where OpenCascade knows only the assembly. */
function* namedByProducts(shapes: readonly CadShape[], bytes: Uint8Array): Steps<readonly CadShape[]> {
  if (shapes.every(({ hasOwnName }) => hasOwnName)) return shapes;
  const faces = shapes.map((shape) => shape.faces.length);
  const products = productsOf(faces, yield* productSolids(bytes));
  const own = shapes.map(({ name }) => (GENERIC.test(name) ? "" : name));
  const namesOf = new Map<string, Set<string>>();
  const counts = new Map<string, number>();
  own.forEach((name, s) => {
    const product = products[s] ?? "";
    counts.set(product, (counts.get(product) ?? 0) + 1);
    namesOf.set(product, (namesOf.get(product) ?? new Set()).add(name));
  });
  return shapes.map((shape, s) => {
    if (shape.hasOwnName) return shape;
    const product = products[s] ?? "";
    // The solids of a part of several have names of their own.
    const count = counts.get(product) ?? 1;
    const areNamed = count > 1 && namesOf.get(product)?.size === count && own[s] !== "";
    return {
      ...shape,
      ...withFaceNames(shape),
      name: GENERIC.test(product) || areNamed ? (own[s] ?? "") : product,
    };
  });
}

/** Returns the faces of a shape with names that tell them from each other. A name that all have is none. */
function withFaceNames({ faces }: CadShape): Pick<CadShape, "faces"> {
  const names = faces.map(({ name }) => name);
  const areNamed = new Set(names).size > 1;
  const different = areNamed ? differentNames(names) : [];
  return { faces: faces.map((face, f) => ({ ...face, name: different[f] })) };
}

const NOT_SHARED =
  "OpenCascade could not find the faces that solids share; they are found among the triangles";

const TOO_SMALL = "OpenCascade could not triangulate the faces as finely as the size asks; they are coarser";

interface FineRequest {
  readonly format: CadFormat;
  readonly bytes: Uint8Array;
  readonly size: number;
}

/** Returns the shapes of a file, finely enough for a target size; the coarse shapes if OpenCascade fails. */
async function finer(
  coarse: ReadShapes,
  { format, bytes, size }: FineRequest,
  signal: AbortSignal | undefined,
): Promise<ReadShapes> {
  const largest = coarse.shapes.reduce((most, { points }) => Math.max(most, diagonalOf(points)), 0);
  const distance = Math.max(PER_SIZE * size, FINEST * largest);
  const deflection = { distance, isRelative: false, angle: DEFLECTION.angle };
  const limits = { reading: secondsForFiner(bytes.length) };
  const reply = await askForCad({ format, bytes, deflection, bare: coarse.bare }, signal, limits);
  if (reply.kind !== "read") return coarse;
  const shapes = reply.shapes.filter(hasTriangles);
  return shapes.length > 0 ? { ...coarse, shapes } : coarse;
}

const hasTriangles = ({ triangles }: CadShape) => triangles.length > 0;

/** Returns whether the default distance suffices for a target size. */
function isFineFor(size: number, points: Float64Array): boolean {
  return PER_SIZE * size >= diagonalOf(points) / PER_DIAGONAL;
}

/** Returns the shapes of a file. Throws a ReadFailure if there are none, or if OpenCascade cannot read them. */
async function shapesIn(
  request: Parameters<typeof askForCad>[0],
  signal: AbortSignal | undefined,
): Promise<ReadShapes> {
  const reply = await askForCad(request, signal);
  const { format, bytes } = request;
  const isDamaged = reply.kind === "rejected" || reply.kind === "failed";
  const damage = isDamaged && format === "step" ? damagedStep(bytes) : undefined;
  if (reply.kind !== "read") throw damage ?? failureOf(reply, format, bytes.length);
  const shapes = reply.shapes.filter(hasTriangles);
  if (shapes.length > 0) return { ...reply, shapes };
  const message = `the ${NAMES[format]} file contains no solids and no faces`;
  throw new ReadFailure({ code: "no-triangles", message, remedy: "Export the part as solids." });
}

/** Returns why a file of this many bytes could not be read. */
export function failureOf(
  reply: Exclude<CadReply, { readonly kind: "read" }>,
  format: CadFormat,
  bytes: number,
): ReadFailure {
  const name = NAMES[format];
  const remedy = `Export the part again as ${name}, or in another format; the file is damaged or not ${name}.`;
  switch (reply.kind) {
    case "not-loaded": {
      const message = `${name} files need the library ${cadLibrariesFor(format)}, which could not be loaded: ${reply.message}`;
      return new ReadFailure({ code: "missing-library", message, remedy: notLoadedRemedy(format) });
    }
    case "loading-timed-out": {
      const message = `${name} files need the library for CAD files, which could not be loaded within ${reply.seconds} s`;
      const again = "Check the connection, and read the file again.";
      return new ReadFailure({ code: "missing-library", message, remedy: again });
    }
    case "out-of-memory": {
      const message = `the memory does not suffice to read the ${name} file: ${reply.message}`;
      const smaller = "Export the parts one by one, or triangulate them in the CAD program and export STL.";
      return new ReadFailure({ code: "too-large-file", message, remedy: smaller });
    }
    case "ended": {
      const message = `the process that reads the ${name} file was ${reply.message}`;
      return new ReadFailure({ message, remedy: "Read the file again; if it fails again, export it again." });
    }
    case "timed-out": {
      const message = `the ${name} file seems to be damaged: OpenCascade was stopped after ${reply.seconds} s, far longer than files of this size take`;
      const simpler =
        "Export the part again. For an assembly, export the parts one by one, or triangulate them in the CAD program and export STL.";
      const isSmall = isSmallFile(bytes);
      const again = `Export the part again as ${name}, or in another format.`;
      return new ReadFailure({ message, remedy: isSmall ? again : simpler });
    }
    case "rejected":
      return new ReadFailure({ message: `OpenCascade cannot read the file as ${name}`, remedy });
    case "failed":
      return new ReadFailure({ message: failedMessage(name, reply.message), remedy });
  }
}

/** Errors of WebAssembly mean that OpenCascade has followed a wrong number in the file; the program's own have a sentence. */
function failedMessage(name: string, cause: string): string {
  const isKnown =
    !/^an exception$|unreachable|out of bounds|null function|signature mismatch|divide by zero|overflow|invalid conversion|recursion|call stack/i.test(
      cause,
    );
  return `OpenCascade ended with an error in the ${name} file, which is damaged or contains shapes that it cannot read${isKnown ? ` (${cause})` : ""}`;
}

const EMPTY = { code: "empty-file", message: "the file is empty", remedy: "Export the part again." } as const;
