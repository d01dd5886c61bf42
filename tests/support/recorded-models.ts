/** Recorded runs of the models of the gallery. */
import { readdirSync, readFileSync } from "node:fs";
import { createMesher, type Mesher, type MeshResult } from "tetrafront";
import { type Project, readProject } from "tetrafront/project";
import { readTrace, recordTrace, type RecordingOptions, type Trace } from "tetrafront/trace";

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

/** Returns a model of the gallery. */
export function galleryProject(id: string): Project {
  const project = readProject(readFileSync(new URL(`${id}.json`, models), "utf8"));
  if (!project.success) throw new Error(project.errors[0].message);
  return project.value;
}

/** Reads a trace that was recorded, and fails if there is none. */
export function tracedIn(bytes: Uint8Array | undefined): Trace {
  const read = readTrace(bytes ?? new Uint8Array());
  if (!read.success) throw new Error(read.errors[0].message);
  return read.value;
}

/** Records the front of a project, by default without the optimizer, and with a mesher of its own if none is given. */
export async function recordFront(
  project: Project,
  options: RecordingOptions = {},
  given?: Mesher,
): Promise<Trace> {
  const mesher = given ?? (await createMesher());
  try {
    const { trace } = await recordTrace(mesher, project, { optimization: "none", ...options });
    return tracedIn(trace);
  } finally {
    if (given === undefined) mesher.dispose();
  }
}

/** Records a model until the front of its volume begins. */
export async function recordSurface(mesher: Mesher, id: string): Promise<RecordedModel> {
  const stop = new AbortController();
  const { result, trace: bytes } = await recordTrace(
    mesher,
    galleryProject(id),
    { optimization: "none" },
    {
      signal: stop.signal,
      onProgress: ({ phase, tetrahedra }) => {
        if (phase === "volume" && tetrahedra > 0) stop.abort();
      },
    },
  );
  if (bytes === undefined) throw new Error(`nothing was recorded of ${id}`);
  return { bytes, trace: tracedIn(bytes), result };
}
