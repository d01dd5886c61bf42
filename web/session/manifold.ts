import type { ManifoldToplevel } from "manifold-3d";

let loading: Promise<ManifoldToplevel> | null = null;

/** Loads the library of Boolean operations when it is first used. After a failure, the next call tries again. */
export function loadManifold(): Promise<ManifoldToplevel> {
  loading ??= load().catch((error: unknown) => {
    loading = null;
    throw error;
  });
  return loading;
}

async function load(): Promise<ManifoldToplevel> {
  const [{ default: start }, { default: wasm }] = await Promise.all([
    import("manifold-3d"),
    import("manifold-3d/manifold.wasm?url"),
  ]);
  const library = await start({ locateFile: () => wasm });
  library.setup();
  return library;
}
