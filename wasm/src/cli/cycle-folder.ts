/** The folder of an adaptation with a solver: the files of each cycle, and the list of finished cycles. */
import { createHash } from "node:crypto";
import { createReadStream } from "node:fs";
import { mkdir, stat } from "node:fs/promises";
import path from "node:path";
import * as v from "valibot";
import { parsedBy } from "../calls/schemas.js";
import { packageDiagnostic } from "../diagnostics/package-diagnostic.js";
import { FileError, readInput, writeOutput } from "./files.js";
import { InvalidInput } from "./messages.js";

const statistics = v.object({
  nodes: v.number(),
  tetrahedra: v.number(),
  edges: v.number(),
  unitEdges: v.number(),
  peakedEdges: v.number(),
  shortest: v.number(),
  longest: v.number(),
  leastQuality: v.number(),
  meanQuality: v.number(),
});
const reportSchema = v.object({
  cycle: v.number(),
  // The mesh that was solved.
  nodes: v.number(),
  elements: v.number(),
  // Per field that decides the sizes: estimated error on the mesh, and the one to expect on the next mesh.
  estimatedErrors: v.record(v.string(), v.number()),
  expectedErrors: v.record(v.string(), v.number()),
  // Number of elements that the metric asks for.
  targetElements: v.number(),
  // The next mesh in the metric.
  adapted: statistics,
  layers: v.optional(
    v.array(
      v.object({
        patch: v.string(),
        triangles: v.number(),
        meanFirstHeight: v.number(),
        thickness: v.number(),
      }),
    ),
  ),
  largestAspect: v.optional(v.number()),
  seconds: v.object({ solver: v.number(), adaptation: v.number() }),
});
const listSchema = v.object({
  format: v.literal("tetrafront-cycles"),
  version: v.literal(1),
  model: v.string(),
  modelHash: v.string(),
  solver: v.string(),
  cycles: v.pipe(v.array(reportSchema), v.readonly()),
});

/** What is reported about a cycle. */
export type CycleReport = Readonly<v.InferOutput<typeof reportSchema>>;

/** What the list in a folder holds. */
export type CycleList = Readonly<v.InferOutput<typeof listSchema>>;

const LIST = "cycles.json";

/** Names of the files in a folder. */
export class CycleFolder {
  constructor(readonly folder: string) {}

  get list(): string {
    return path.join(this.folder, LIST);
  }

  /** Returns the file of one kind of a cycle. `extension` with its dot. */
  file(kind: "mesh" | "solution" | "background" | "solver", cycle: number, extension: string): string {
    return path.join(this.folder, `${kind}-${cycle}${extension}`);
  }

  async create(): Promise<void> {
    try {
      await mkdir(this.folder, { recursive: true });
    } catch (failure) {
      const code = failure instanceof Error && "code" in failure ? String(failure.code) : String(failure);
      const remedy = "Choose another with --folder, or change the permissions.";
      throw new FileError(this.folder, `the folder cannot be created (${code})`, remedy);
    }
  }

  /** Writes the list; until then, the folder is that of the cycles before. */
  async write(list: CycleList): Promise<void> {
    await writeOutput(this.list, `${JSON.stringify(list, null, 2)}\n`);
  }

  /** Returns the list; undefined if there is none. Throws an InvalidInput if it is none of this program. */
  async read(): Promise<CycleList | undefined> {
    if (
      await stat(this.list).then(
        () => false,
        () => true,
      )
    )
      return undefined;
    const text = new TextDecoder().decode(await readInput(this.list));
    const parsed = parsedBy(listSchema, jsonOf(text));
    if ("value" in parsed) return parsed.value;
    const [problem] = parsed.problems;
    const message = `the list of cycles is damaged: ${problem?.path ?? ""} ${problem?.message ?? ""}`;
    throw new InvalidInput(this.list, [
      packageDiagnostic("unreadable-input", message, "Delete the folder and begin again."),
    ]);
  }
}

function jsonOf(text: string): unknown {
  try {
    return JSON.parse(text);
  } catch {
    return undefined;
  }
}

/** Returns a hash of the content of a file. */
export async function hashOf(file: string): Promise<string> {
  const hash = createHash("sha256");
  for await (const piece of createReadStream(file)) hash.update(piece as Buffer);
  return hash.digest("hex");
}
