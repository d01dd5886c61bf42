/** Reads surface files and converts the surfaces of bodies, so that no step of it blocks the page. */
import {
  bodySurface,
  bodyWithPatches,
  createBody,
  mergePatches,
  readSurface,
  type PatchedSurface,
  type ProjectBody,
} from "tetrafront";
import { buffersOfDrawn, drawnSurface } from "../document/drawn-surface";
import { buffersOfPacked, packedBody } from "./packed-bodies";
import { serveCalls, type Answer } from "./serve-calls";
import type { LoadedSurface, PackedNewBody, PatchArrays, SurfaceProtocol } from "./surface-files";

serveCalls<SurfaceProtocol>({
  read: async ({ file, fileName, head }) => {
    const read = await readSurface(file.stream(), { fileName });
    if (!read.success) {
      const reasons = read.errors.map(({ message, remedy, line }) =>
        [line === undefined || /^line \d/i.test(message) ? message : `Line ${line}: ${message}`, remedy]
          .filter((text) => text !== "")
          .join(". "),
      );
      return { answer: { success: false, reasons } };
    }
    const made = newBody(createBody(read.value, head));
    return {
      answer: { success: true, ...made, notes: read.value.notes ?? [] },
      transfer: buffersOf(made),
    };
  },
  load: (body) => {
    const answer = newBody(body);
    return { answer, transfer: buffersOf(answer) };
  },
  replace: ({ body, surface, patches }) => {
    const groups = patches.map(({ id, name = "" }) => ({ name, tag: id }));
    const made = createBody({ ...surface, patches: groups }, { id: body.id, firstPatchId: 1, name: "" });
    const { trianglePatch, points, triangles } = made;
    const replaced = newBody({
      ...body,
      points,
      triangles,
      ...(trianglePatch !== undefined && { trianglePatch }),
      patches,
    });
    return { answer: replaced, transfer: buffersOf(replaced) };
  },
  split: ({ body, split, nextPatchId }) => withSameTriangles(bodyWithPatches(body, split, nextPatchId)),
  merge: ({ body, ids }) => withSameTriangles(mergePatches(body, ids)),
  draw: ({ surface, patchCount, values }) => {
    const answer = drawnSurface(surface, patchCount, values);
    return { answer, transfer: buffersOfDrawn(answer) };
  },
});

function newBody(body: ProjectBody): PackedNewBody {
  return { packed: packedBody(body), loaded: loadedFrom(body) };
}

/** Omits the texts of points and triangles, which the page has. */
function withSameTriangles(body: ProjectBody): Answer<PackedNewBody> {
  const answer = { packed: packedBody({ ...body, points: "", triangles: "" }), loaded: loadedFrom(body) };
  return { answer, transfer: buffersOf(answer) };
}

/** Returns the arrays of a body where they were given: the view moves them. */
function loadedFrom({ placement: _, ...body }: ProjectBody): LoadedSurface {
  const surface = withPatches(bodySurface(body));
  // One patch needs no colour of its own.
  const values = body.patches.length > 1 ? surface.trianglePatch : null;
  return { surface, drawn: drawnSurface(surface, body.patches.length, values) };
}

function withPatches({ points, triangles, trianglePatch }: PatchedSurface): PatchArrays {
  return { points, triangles, trianglePatch: trianglePatch ?? new Uint32Array(triangles.length / 3) };
}

function buffersOf({ packed, loaded: { surface, drawn } }: PackedNewBody): ArrayBuffer[] {
  const arrays = [surface.points, surface.triangles, surface.trianglePatch];
  return [
    ...arrays.map(({ buffer }) => buffer as ArrayBuffer),
    ...buffersOfDrawn(drawn),
    ...buffersOfPacked([packed]),
  ];
}
