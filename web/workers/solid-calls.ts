/** Makes solids of features by the kernel. */
import { drawnSolid, featureSolid, partOfFile, type FeatureKernel } from "tetrafront/internal";
import { createBodies, type ProjectBody, type ProjectBodyPatch } from "tetrafront/project";
import { faceLabel, faceLook } from "../document/operations/feature-names";
import { buffersOfNew, newBody } from "./new-bodies";
import type { Handlers } from "./serve-calls";
import type { SolidProtocol, SolidRequest } from "./solids";

/** Returns the handlers of the worker. `load` is called for the first solid, and again after a failure. */
export function solidCalls(load: () => Promise<FeatureKernel>): Handlers<SolidProtocol> {
  let loading: Promise<FeatureKernel> | null = null;
  const loadedKernel = async (): Promise<FeatureKernel> => {
    loading ??= load();
    try {
      return await loading;
    } catch (failure) {
      loading = null;
      throw failure;
    }
  };
  return {
    import: async (file) => ({ answer: partOfFile(await loadedKernel(), file) }),
    draw: async (features) => {
      const answer = drawnSolid(await loadedKernel(), features);
      if (answer.isKernelSpent) loading = null;
      return { answer };
    },
    evaluate: async (request) => {
      const kernel = await loadedKernel();
      const { surface, origins, edges, failures, isKernelSpent } = await featureSolid(
        kernel,
        request.features,
      );
      if (isKernelSpent) loading = null;
      const made = surface ? newBody(bodyOf(request, surface, origins)) : null;
      const named = edges.map(({ name, faces }) => ({ name, faces }));
      return { answer: { made, edges: named, failures }, transfer: made ? buffersOfNew(made) : [] };
    },
  };
}

/** Returns the body of features. Patches of an origin that the body had before keep their ids, names and colours. */
function bodyOf(
  { features, body: { id, name, patches: before = [] }, nextPatchId }: SolidRequest,
  surface: Parameters<typeof createBodies>[0],
  origins: readonly (string | undefined)[],
): ProjectBody {
  // Solids of one list are one body, also where they do not touch.
  const { surfaceRegions: _, ...one } = surface;
  const [made] = createBodies(one, { id, firstPatchId: nextPatchId, name: name ?? "" });
  if (!made) throw new Error("The features give no body");
  const known = new Map(before.map((patch) => [patch.origin, patch]));
  const names = new Set(origins.map((origin) => known.get(origin)?.name));
  const labelOf = (origin: string): string => {
    const full = faceLabel(features, origin, true);
    let label = faceLabel(features, origin);
    for (let number = 1; names.has(label); number++) label = number === 1 ? full : `${full} ${number}`;
    names.add(label);
    return label;
  };
  let next = nextPatchId;
  const patches = surface.patches.map((patch, p): ProjectBodyPatch => {
    const origin = origins[p];
    if (origin === undefined) return { id: next++, name: patch.name };
    const { color } = faceLook(features, origin) ?? {};
    return known.get(origin) ?? { id: next++, name: labelOf(origin), origin, ...(color && { color }) };
  });
  return { ...made, patches, features };
}
