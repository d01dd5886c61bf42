/** Workers that optimize tiles of a run in this thread: the same mesh whatever they do, and none is left behind. */
import { readFile } from "node:fs/promises";

import { afterEach, beforeAll, beforeEach, describe, expect, test, vi } from "vitest";

import { engineOptions } from "../../../wasm/dist/api/mesh-options.js";
import { type Engine, loadEngine } from "../../../wasm/dist/engine/loader.js";
import { RunClock } from "../../../wasm/dist/engine/run-clock.js";
import { runInSlices } from "../../../wasm/dist/engine/slices.js";
import { TilePool, usableThreads } from "../../../wasm/dist/engine/tile-pool.js";
import { emptyGrid } from "../../../wasm/dist/project/grid-arrays.js";
import type { TileHost, TileWorker, TileWorkerEvents } from "../../../wasm/src/engine/tile-host.js";
import type { TileReply, TileRequest } from "../../../wasm/src/engine/tile-protocol.js";
import { randomSource } from "../../support/random.js";
import { sphereSurface } from "../../support/surfaces.js";

/** A worker as the pool sees it. */
interface Started {
  readonly events: TileWorkerEvents;
  readonly worker: TileWorker;
  /** Ids of the tiles that it was given. */
  readonly tiles: number[];
  isTerminated: boolean;
}

type StartWorker = TileHost["start"];

const host = vi.hoisted(() => ({
  started: [] as Started[],
  /** Starts workers in place of the real host. */
  start: undefined as StartWorker | undefined,
  startReal: undefined as StartWorker | undefined,
  isAvailable: true,
}));
const { started } = host;

vi.mock("../../../wasm/dist/engine/tile-host-node.js", async (importOriginal) => {
  const { tileHost } = await importOriginal<{ readonly tileHost: TileHost }>();
  host.startReal = (events) => tileHost.start(events);
  return {
    tileHost: {
      get isAvailable() {
        return host.isAvailable;
      },
      cores: () => 12,
      start: (events: TileWorkerEvents) => recorded(events, host.start ?? startReal),
    },
  };
});

/** Starts a worker as the package does. */
function startReal(events: TileWorkerEvents): TileWorker {
  if (host.startReal === undefined) throw new Error("the host is not loaded");
  return host.startReal(events);
}

/** Returns a generator of numbers from 0 to 1. */
function fractions(seed: number): () => number {
  const next = randomSource(seed);
  return () => next() / 2 ** 32;
}

/** Starts a worker and records what becomes of it. */
function recorded(events: TileWorkerEvents, start: StartWorker): TileWorker {
  const worker = start(events);
  const own: Started = { events, worker, tiles: [], isTerminated: false };
  started.push(own);
  return {
    post: (request, transfer) => {
      if (request.kind === "tile") own.tiles.push(request.id);
      worker.post(request, transfer);
    },
    terminate: () => {
      own.isTerminated = true;
      worker.terminate();
    },
  };
}

const surface = sphereSurface(22);
const options = engineOptions({ optimization: "fast", interior: "front" });
let engine: Engine;
let code: object;
let alone: string;

beforeAll(async () => {
  const compile = async (address: URL) => WebAssembly.compile(await readFile(address));
  ({ instance: engine, module: code } = await loadEngine(undefined, compile));
  alone = (await meshed(1)).fingerprint;
});

beforeEach(() => {
  started.splice(0);
  host.start = undefined;
  host.isAvailable = true;
});
afterEach(() => {
  vi.restoreAllMocks();
  expect(started.every(({ isTerminated }) => isTerminated)).toBe(true);
});

interface Meshing {
  /** Called after each slice in which tiles were lent. */
  readonly onShared?: () => void;
  readonly isCancelled?: () => boolean;
}

/** Meshes the sphere with so many threads. */
async function meshed(threads: number, { onShared, isCancelled = () => false }: Meshing = {}) {
  const regions = { triangleRegions: new Uint32Array(), maxVolumes: new Float64Array() };
  const run = engine.fillSurface(surface.points, surface.triangles, regions, emptyGrid(), options);
  if (run === null) throw new Error("there is no memory");
  const tiles = threads === 1 ? undefined : new TilePool(run, threads, code);
  const control = {
    isCancelled,
    onProgress: () => undefined,
    letRequestsIn: async () => {
      if (started.length > 0) onShared?.();
      await new Promise((resolve) => setImmediate(resolve));
    },
    onFront: undefined,
    onTrace: undefined,
    onUnoptimized: undefined,
    tiles,
  };
  try {
    const status = await runInSlices(run, new RunClock(), control);
    const { tetrahedra, points } = run.volume();
    return { status, fingerprint: run.fingerprint(), tetrahedra, points, quality: run.quality() };
  } finally {
    tiles?.close();
    run.delete();
  }
}

describe("a mesh in tiles", () => {
  test("is the same if workers do some of them, of which each has one at a time", async () => {
    const { status, fingerprint, tetrahedra } = await meshed(3);
    expect(status).toBe("done");
    expect(tetrahedra.length / 4).toBeGreaterThan(60_000);
    expect(fingerprint).toBe(alone);
    const done = started.flatMap(({ tiles }) => tiles);
    expect(new Set(done).size).toBe(done.length);
    expect(done.length).toBeGreaterThan(2);
    expect(started.length).toBeLessThanOrEqual(2);
  });

  test("is the same if workers die in the middle of a tile, or cannot begin", async () => {
    const random = fractions(5);
    let left = 3;
    const onShared = () => {
      const victim = started.find(({ isTerminated, tiles }) => !isTerminated && tiles.length > 0);
      if (victim === undefined || left === 0 || random() < 0.8) return;
      --left;
      // As the host reports a worker that ended by itself.
      victim.worker.terminate();
      victim.events.onCrash("the worker ended with code 1");
    };
    host.start = (events: TileWorkerEvents): TileWorker => {
      const worker = startReal(events);
      // The second worker gets a tile before the engine.
      if (started.length === 1) worker.post({ kind: "tile", id: 1, mesh: noTile() }, []);
      return worker;
    };
    const { status, fingerprint } = await meshed(3, { onShared });
    expect(status).toBe("done");
    expect(fingerprint).toBe(alone);
    expect(left).toBeLessThan(3);
  });

  test("is the same if no worker can be started", async () => {
    host.start = () => {
      throw new Error("workers are forbidden");
    };
    expect((await meshed(4)).fingerprint).toBe(alone);
    expect(started).toEqual([]);
  });

  test("is cancelled while workers hold tiles, and valid then", async () => {
    for (const slices of [1, 4]) {
      started.splice(0);
      let shared = 0;
      const isCancelled = () => shared >= slices;
      const { status, tetrahedra, quality } = await meshed(3, { onShared: () => ++shared, isCancelled });
      expect(status).toBe("cancelled");
      expect(tetrahedra.length / 4).toBeGreaterThan(50_000);
      expect(quality.volume).toBeGreaterThan(4);
      expect(quality.minDihedral).toBeGreaterThan(0);
      expect(shared).toBeLessThan(slices + 3);
      expect(started.every(({ isTerminated }) => isTerminated)).toBe(true);
    }
  });
});

/** What a run lends of twenty tiles; one step of its own work does a third of a tile. */
class FakeRun {
  readonly states: ("waiting" | "home" | "lent" | "done")[] = Array.from({ length: 20 }, () => "waiting");
  maxLent = 0;
  isCancelled = false;
  #steps = 0;

  count = (state: string) => this.states.filter((one) => one === state).length;
  waitingTiles = () => this.count("waiting");
  waitsForTiles = () => this.count("lent") > 0 && this.count("waiting") + this.count("home") === 0;
  tileSteps = () => new Uint8Array(8);
  lendTile = () => {
    const index = this.states.indexOf("waiting");
    if (index >= 0) this.states[index] = "lent";
    this.maxLent = Math.max(this.maxLent, this.count("lent"));
    return { id: index + 1, mesh: noTile() };
  };
  returnTile = (id: number) => {
    expect(this.states[id - 1]).toBe("lent");
    this.states[id - 1] = "done";
    return true;
  };
  withdrawTile = (id: number) => {
    expect(this.states[id - 1]).toBe("lent");
    this.states[id - 1] = "waiting";
  };
  advance = () => {
    if (this.isCancelled) return 3;
    const home = this.states.indexOf("home");
    if (home < 0) {
      const next = this.states.indexOf("waiting");
      if (next >= 0) this.states[next] = "home";
    } else if (++this.#steps % 3 === 0) this.states[home] = "done";
    return this.count("done") === this.states.length ? 1 : 0;
  };
  cancel = () => (this.isCancelled = true);
  phase = () => 4;
  progress = () => ({ fraction: 0 });
  failure = () => 0;
}

const noTile = () => ({
  points: new Float64Array(3),
  tetrahedra: new Uint32Array(4),
  regions: new Uint32Array(1),
  isFixed: new Uint8Array(1),
});

/** A worker that answers after a random number of turns; some fail or end by themselves. */
function unreliable(random: () => number): StartWorker {
  return (events) => {
    let isEnded = false;
    const later = (act: () => void): void => {
      setImmediate(() => (random() < 0.5 ? later(act) : isEnded || act()));
    };
    const reply = (made: TileReply): void => later(() => events.onReply(made));
    const post = (request: TileRequest): void => {
      if (request.kind !== "tile") return;
      const fate = random();
      if (fate < 0.7) reply({ kind: "done", id: request.id, mesh: request.mesh });
      else if (fate < 0.8) reply({ kind: "failed", message: "out of memory" });
      else later(() => events.onCrash("the worker ended with code 1"));
    };
    return { post, terminate: () => (isEnded = true) };
  };
}

describe("a pool of unreliable workers", () => {
  test("never loses a tile, nor lends more than one to each worker, and ends at 200 random moments", async () => {
    vi.spyOn(performance, "now").mockImplementation(
      (
        (now) => () =>
          (now += 5)
      )(0),
    );
    const random = fractions(11);
    let cancelled = 0;
    for (let trial = 0; trial < 200; ++trial) {
      started.splice(0);
      host.start = unreliable(random);
      const run = new FakeRun();
      const threads = 2 + Math.floor(4 * random());
      const pool = new TilePool(run, threads, {});
      let turns = Math.floor(40 * random());
      const status = await runInSlices(run as unknown as Parameters<typeof runInSlices>[0], new RunClock(), {
        isCancelled: () => turns-- <= 0,
        onProgress: () => undefined,
        letRequestsIn: () => new Promise((resolve) => setImmediate(resolve)),
        onFront: undefined,
        onTrace: undefined,
        onUnoptimized: undefined,
        tiles: pool,
      });
      pool.close();
      if (status === "cancelled") ++cancelled;
      else expect(run.count("done")).toBe(20);
      expect(run.maxLent).toBeLessThan(threads);
      expect(started.every(({ isTerminated }) => isTerminated)).toBe(true);
    }
    expect(cancelled).toBeGreaterThan(20);
    expect(cancelled).toBeLessThan(190);
  });
});

test("by default, a run uses the threads of the machine, at most 8; one where workers cannot start workers", () => {
  expect(usableThreads(undefined)).toBe(8);
  expect(usableThreads(12)).toBe(12);
  host.isAvailable = false;
  expect(usableThreads(undefined)).toBe(1);
  expect(usableThreads(3)).toBe(1);
});
