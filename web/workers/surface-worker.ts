/** Reads surface files and converts the surfaces of bodies, so that no step of it blocks the page. */
import {
  formatOf,
  measureTriangles,
  readMesh,
  readSurface,
  type Mesh,
  type SurfaceInput,
  type ReadError,
} from "tetrafront";
import {
  createUnitBodies,
  meshWithBoundary,
  sharedPairs,
  solidUnits,
  withSolidsOfPatches,
} from "tetrafront/internal";
import {
  bodyWithPatches,
  mergePatches,
  createBodies,
  createBody,
  type ProjectBody,
} from "tetrafront/project";
import { buffersOfDrawn, drawnSurface } from "../document/drawn-surface";
import { hasInnerSolid } from "../document/inner-solids";
import type { PatchMeaning } from "../document/patch-colors";
import { strings } from "../strings";
import "./cad-library";
import { buffersOfNew, loadedFrom, newBody } from "./new-bodies";
import { packedBody } from "./packed-bodies";
import { replacedBody } from "./replaced-body";
import { serveCalls, type Answer } from "./serve-calls";
import type { PackedNewBody, SurfaceProtocol } from "./surface-files";

serveCalls<SurfaceProtocol>({
  read: async ({ file, others, head }) => {
    const { name: fileName } = file;
    const openOther = (name: string) =>
      Promise.resolve(others.find((other) => other.name === name)?.stream());
    if (formatOf(fileName)?.readable.includes("volume") === true) {
      const mesh = await readMesh(file.stream(), { fileName, openOther });
      if (!mesh.success) return refusal(mesh.errors);
      if (mesh.value.tetrahedra.length > 0) return readVolume(mesh.value, fileName, head);
    }
    const read = await readSurface(file.stream(), { fileName, openOther });
    if (!read.success) return refusal(read.errors);
    const { unit } = read.value;
    const { treatment, note } = await treatmentOf(read.value, fileName);
    const notes = [...notesOf(read.value), ...note];
    const { bodies, surfaceRegions } = await bodiesIn(read.value, head);
    const made = bodies.map((body) => newBody({ ...body, ...treatment }));
    const solids = made.map(({ loaded }) => loaded.surface);
    const isInner = hasInnerSolid(solids, surfaceRegions);
    return {
      answer: { success: true, made, unit, hasInnerSolid: isInner, notes, mesh: null },
      transfer: made.flatMap(buffersOfNew),
    };
  },
  load: (body) => {
    const answer = newBody(body);
    return { answer, transfer: buffersOfNew(answer) };
  },
  replace: (given) => {
    const replaced = newBody(replacedBody(given));
    return { answer: replaced, transfer: buffersOfNew(replaced) };
  },
  split: ({ body, split, nextPatchId, isPreview }) =>
    withSameTriangles(bodyWithPatches(body, split, nextPatchId), isPreview ? "patch" : undefined),
  merge: ({ body, ids }) => withSameTriangles(mergePatches(body, ids)),
  draw: ({ surface, patchCount, values }) => {
    const answer = drawnSurface(surface, patchCount, values);
    return { answer, transfer: buffersOfDrawn(answer) };
  },
});

/**
 * Returns the bodies of a file, and the regions of its solids if it states them. Solids of an STL file that cannot touch are
 * one body, with common sizes, as in the package.
 */
async function bodiesIn(
  file: Mesh,
  head: SurfaceProtocol["read"]["argument"]["head"],
): Promise<{ readonly bodies: readonly ProjectBody[] } & Pick<Mesh, "surfaceRegions">> {
  const { surfaceRegions, ...divided } = await withSolidsOfPatches(file);
  if (file.surfaceRegions || !surfaceRegions)
    return { bodies: createBodies(file, head), surfaceRegions: file.surfaceRegions };
  const solids = { ...divided, surfaceRegions };
  const units = solidUnits(solids);
  return units.length < 2 && sharedPairs(surfaceRegions.triangleRegions).length === 0
    ? { bodies: createBodies(file, head) }
    : { bodies: createUnitBodies(solids, units, head), surfaceRegions };
}

/**
 * Returns what meshing will do with the triangles of a file, as the package does by default: those that are fit are kept.
 * CAD programs triangulate faces to be remeshed.
 */
async function treatmentOf(
  file: SurfaceInput,
  fileName: string,
): Promise<{ readonly treatment: Pick<ProjectBody, "surface" | "remeshing">; readonly note: string[] }> {
  if (formatOf(fileName)?.isCad === true) return { treatment: {}, note: [] };
  const { isFit, needles, triangles, statedSize } = await measureTriangles(file);
  if (isFit) return { treatment: { surface: "refine" }, note: [strings.files.keptTriangles] };
  // A few needles among good triangles: these state the size that is wanted.
  const treatment = statedSize === undefined ? {} : { remeshing: { maxSize: statedSize } };
  return { treatment, note: [strings.files.needles(needles, triangles)] };
}

/** Bodies have no points that mark regions and holes. */
function notesOf({ notes = [], regionPoints }: Mesh): string[] {
  const count = (regionPoints?.holes.length ?? 0) + (regionPoints?.regions.length ?? 0);
  return count === 0 ? [...notes] : [...notes, strings.files.regionPointsUnused(count)];
}

/** Returns why a file cannot be read, one sentence each. */
function refusal(errors: readonly ReadError[]): Answer<SurfaceProtocol["read"]["answer"]> {
  // Without a network, the library for CAD files is there only if this browser keeps it.
  if (!navigator.onLine && errors.some(({ code }) => code === "missing-library"))
    return { answer: { success: false, reasons: [strings.files.noCadLibrary] } };
  const reasons = errors.map(({ message, remedy, line }) =>
    [line === undefined || /^line \d/i.test(message) ? message : `Line ${line}: ${message}`, remedy]
      .filter((text) => text !== "")
      .join(". "),
  );
  return { answer: { success: false, reasons } };
}

const none: Mesh["nodeData"] = new Map();

/** Reads the mesh of a file, with the values at its nodes and of its elements; its boundary is the surface of a body. */
async function readVolume(
  file: Mesh,
  fileName: string,
  head: SurfaceProtocol["read"]["argument"]["head"],
): Promise<Answer<SurfaceProtocol["read"]["answer"]>> {
  const { mesh, patchShapes, outer } = await meshWithBoundary(file);
  const { notes = [] } = file;
  // Nothing is said of the triangles: the mesh itself is shown.
  const { treatment } = await treatmentOf(outer, fileName);
  const made = newBody({ ...createBody(outer, head), ...treatment });
  const { nodeData, elementData = none } = mesh;
  const values = [...nodeData.values(), ...elementData.values()].map((data) => data.values);
  const parts: readonly unknown[] = Object.values(mesh);
  const arrays = [...parts, ...values].filter((part) => ArrayBuffer.isView(part));
  const buffers = new Set(arrays.map(({ buffer }) => buffer as ArrayBuffer));
  return {
    answer: {
      success: true,
      made: [made],
      unit: file.unit,
      hasInnerSolid: false,
      notes,
      mesh: { mesh, patchShapes },
    },
    transfer: [...buffersOfNew(made), ...buffers],
  };
}

/** Omits the texts of points and triangles, which the page has. */
function withSameTriangles(body: ProjectBody, meaning?: PatchMeaning): Answer<PackedNewBody> {
  const { trueFaces: _, ...others } = body;
  const packed = packedBody({ ...others, points: "", triangles: "" });
  const answer = { packed, loaded: loadedFrom(body, meaning) };
  return { answer, transfer: buffersOfNew(answer) };
}
