/** Recorded runs of the models of the gallery. */
import { readdirSync, readFileSync } from "node:fs";
import { type Mesher, type MeshResult, readProject, readTrace, recordTrace, type Trace } from "tetrafront";

const models = new URL("../../public/models/", import.meta.url);

/** The ids of all models. */
export const modelIds: readonly string[] = readdirSync(models)
  .filter((name) => name.endsWith(".json"))
  .map((name) => name.slice(0, -".json".length));

export interface RecordedModel {
  readonly bytes: Uint8Array;
  readonly trace: Trace;
  readonly result: MeshResult;
}

/** Records a model until the front of its volume begins. */
export async function recordSurface(mesher: Mesher, id: string): Promise<RecordedModel> {
  const project = readProject(readFileSync(new URL(`${id}.json`, models), "utf8"));
  if (!project.success) throw new Error(project.errors[0].message);
  const stop = new AbortController();
  const { result, trace: bytes } = await recordTrace(
    mesher,
    project.value,
    { optimization: "none" },
    {
      signal: stop.signal,
      onProgress: ({ phase, tetrahedra }) => {
        if (phase === "volume" && tetrahedra > 0) stop.abort();
      },
    },
  );
  if (bytes === undefined) throw new Error(`nothing was recorded of ${id}`);
  const read = readTrace(bytes);
  if (!read.success) throw new Error(read.errors[0].message);
  return { bytes, trace: read.value, result };
}
