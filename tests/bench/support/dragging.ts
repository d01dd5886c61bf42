/** What the benchmark of dragging measures: all that a page does for one drag, except drawing and the engine's work. */
import { serialize } from "node:v8";
import type { Mesher } from "tetrafront";
import type { Project } from "tetrafront/project";
import { emptyProject } from "../../../web/document/create";
import { translation } from "../../../web/document/transforms/affine";
import { DocumentLibrary } from "../../../web/session/document-library";
import { newDocument } from "../../../web/session/document-store";
import { Session } from "../../../web/session/session";
import { Drawing } from "../../../web/tools/drawing/drawing";
import { makeMotion } from "../../support/motion";
import { MemoryLocks, MemoryStorage, MemoryTab } from "../../unit/web/storage-doubles";

/** Times in milliseconds, sizes in bytes. Of what is done once per drag, the shortest: other programs may interrupt one. */
interface Measurement {
  /** One move of the pointer. */
  readonly move: { readonly median: number; readonly most: number };
  /** The end of the drag. */
  readonly release: number;
  readonly undo: number;
  /** Estimated memory of the step of undo. */
  readonly step: number;
  /** What autosave writes after the drag, and how long this blocks the page. */
  readonly written: number;
  readonly blocking: number;
}

const moves = 200;
const drags = 5;

/** Notes the size of each write. */
class MeasuredStorage extends MemoryStorage {
  written = 0;

  override write(...parts: Parameters<MemoryStorage["write"]>): Promise<void> {
    this.written = parts.reduce((sum, part) => sum + serialize(part).length, 0);
    return Promise.resolve();
  }
}

export async function measureDragging(points: number): Promise<Measurement> {
  const storage = new MeasuredStorage();
  const never = new Promise<Mesher>(() => undefined);
  const library = new DocumentLibrary(storage, new MemoryLocks(), new MemoryTab());
  const document = newDocument(pointsInRows(points));
  const session = new Session({ first: { document }, mesher: never, previewMesher: never, library });
  const { documents, view, autosave } = session;
  const seenFrom = (): never => {
    throw new Error("No view");
  };
  const motion = makeMotion({ documents, view, drawing: new Drawing(), seenFrom });
  autosave?.follow();
  await autosave?.flush();
  const times: number[] = [];
  const [releases, undos, blocking]: [number[], number[], number[]] = [[], [], []];
  for (let drag = 0; drag < drags; ++drag) {
    const selection = [{ kind: "point", id: Math.floor(points / 2) + 2 * drag }] as const;
    motion.start({ mode: "translate", selection, base: [0, 0, 0], axis: null, isHeld: true });
    for (let move = 1; move <= moves; ++move) {
      const map = translation([move / 1000, 0.3, 0]);
      times.push(timeOf(() => motion.drag(map, "", { x: move, y: 0 })));
    }
    releases.push(timeOf(() => motion.release()));
    blocking.push(timeOf(() => void autosave?.flush()));
    await autosave?.flush();
    undos.push(timeOf(() => documents.undo()));
    documents.redo();
    await autosave?.flush();
  }
  const step = documents.state.getState().history.past.at(-1);
  const { written } = storage;
  const sorted = times.toSorted((a, b) => a - b);
  return {
    move: { median: sorted[times.length / 2] ?? 0, most: sorted[Math.floor(0.95 * sorted.length)] ?? 0 },
    release: Math.min(...releases),
    undo: Math.min(...undos),
    step: step?.bytes ?? 0,
    written,
    blocking: Math.min(...blocking),
  };
}

function timeOf(work: () => void): number {
  const begin = performance.now();
  work();
  return performance.now() - begin;
}

/** Points in rows of ten, each row with a line through it. All are in a group, and one has an expression. */
function pointsInRows(count: number): Project {
  return {
    ...emptyProject("Bench"),
    points: Array.from({ length: count }, (_, i) => ({
      id: i + 1,
      position: [(i % 10) / 10, Math.floor(i / 10) + 1 / 3, 0],
    })),
    groups: [
      {
        id: 1,
        name: "All",
        members: Array.from({ length: count }, (_, i) => ({ kind: "point", id: i + 1 })),
      },
    ],
    expressions: [{ kind: "point", id: 1, field: "position.1", expression: "1/3" }],
    lines: Array.from({ length: Math.floor(count / 10) }, (_, row) => ({
      id: row + 1,
      type: "spline",
      points: Array.from({ length: 10 }, (__, k) => 10 * row + k + 1),
    })),
  };
}
