import { createBody, type ProjectBody } from "tetrafront/project";
import type { ReplacedSurface } from "./surface-files";

/**
 * Returns a body with other triangles. What is known of the given ones, such as their repairs and the deviation of these,
 * stays: callers that make triangles of another origin must omit it.
 */
export function replacedBody({ body, surface, patches }: ReplacedSurface): ProjectBody {
  const groups = patches.map(({ id, name = "" }) => ({ name, tag: id }));
  const made = createBody({ ...surface, patches: groups }, { id: body.id, firstPatchId: 1, name: "" });
  const { trianglePatch, points, triangles } = made;
  // The given triangles may have had several patches, and the new ones a single one.
  const { trianglePatch: _, ...others } = body;
  return { ...others, points, triangles, ...(trianglePatch !== undefined && { trianglePatch }), patches };
}
