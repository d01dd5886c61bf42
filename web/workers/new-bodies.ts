import type { SurfaceInput } from "tetrafront";
import { bodySurface, type ProjectBody } from "tetrafront/project";
import { buffersOfDrawn, drawnSurface, withoutInnerEdges } from "../document/drawn-surface";
import type { PatchArrays } from "../document/patch-arrays";
import { meaningOf, patchValues, type PatchMeaning } from "../document/patch-colors";
import { buffersOfPacked, packedBody } from "./packed-bodies";
import type { LoadedSurface, PackedNewBody } from "./surface-files";

/** Returns a body on its way to the page, with its arrays. */
export function newBody(body: ProjectBody): PackedNewBody {
  return { packed: packedBody(body), loaded: loadedFrom(body) };
}

/** Returns the arrays of a body where they were given: the view moves them. */
export function loadedFrom(
  { placement: _, ...body }: ProjectBody,
  meaning: PatchMeaning = meaningOf(body.patches),
): LoadedSurface {
  const { patches } = body;
  const surface = withPatches(bodySurface(body));
  const values = patchValues(surface.trianglePatch, patches, meaning);
  const drawn = drawnSurface(surface, patches.length, values);
  return { surface, drawn: body.features ? withoutInnerEdges(drawn, surface) : drawn };
}

function withPatches({ points, triangles, trianglePatch }: SurfaceInput): PatchArrays {
  return { points, triangles, trianglePatch: trianglePatch ?? new Uint32Array(triangles.length / 3) };
}

/** Returns the buffers of a new body, for the transfer list of a message. */
export function buffersOfNew({ packed, loaded: { surface, drawn } }: PackedNewBody): ArrayBuffer[] {
  const arrays = [surface.points, surface.triangles, surface.trianglePatch];
  return [
    ...arrays.map(({ buffer }) => buffer as ArrayBuffer),
    ...buffersOfDrawn(drawn),
    ...buffersOfPacked([packed]),
  ];
}
