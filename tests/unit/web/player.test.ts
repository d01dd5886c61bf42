import { playerOf } from "../../../web/teach/commands/player-of";
import { replayOf } from "../../../web/teach/commands/replay";
/** The player of the front: states, buffers, jumps, and the independent check of the decisions. */
import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import type { Mesher } from "tetrafront";
import { readTrace, type Trace } from "tetrafront/trace";
import { App } from "../../../web/app/app";
import { alphasOf, excessOf } from "../../../web/teach/player/crossing";
import { ElementBuffers } from "../../../web/teach/player/element-buffers";
import { FrontBuffers } from "../../../web/teach/player/front-buffers";
import {
  cornersOf,
  crossedFaces,
  crossesFace,
  frontChange,
  isBehind,
  newElement,
  touching,
} from "../../../web/teach/player/judge";
import type { Player } from "../../../web/teach/player/player";
import { nextStop, stopKinds, stopKindsOf } from "../../../web/teach/player/stops";
import { newDocument } from "../../../web/session/document-store";
import { cubeProject } from "../../support/projects";
import { randomSource } from "../../support/random";
import { boxSurface } from "../../support/surfaces";
import { starSurface, starTrace, traceBytes, TraceBytes, writeFirstFaces } from "../../support/traces";
import { SilentWorker } from "../../support/silent-worker";

const { bytes } = starTrace({
  ...starSurface(boxSurface(3, [-1, -1, -1], [1, 1, 1])),
  postponeEvery: 6,
  reopenAfter: 20,
});

function readStar(): Trace {
  const read = readTrace(bytes);
  if (!read.success) throw new Error(read.errors[0].message);
  return read.value;
}

const trace = readStar();

/** A mesher whose calls never end. */
const busyMesher = Promise.resolve({
  meshProject: () => new Promise(() => undefined),
  previewProject: () => new Promise(() => undefined),
} as unknown as Mesher);

function newApp(): App {
  const first = { document: newDocument(cubeProject()) };
  return new App(
    { first, mesher: busyMesher, previewMesher: busyMesher, library: null },
    { gallery: { opening: "", models: [] }, generate: false, still: true, replayOf },
  );
}

/** Frames that the test draws. */
let frames: ((now: number) => void)[] = [];
let now = 0;

function drawFrame(milliseconds: number): void {
  now += milliseconds;
  const due = frames;
  frames = [];
  for (const draw of due) draw(now);
}

beforeEach(() => {
  frames = [];
  vi.stubGlobal("requestAnimationFrame", (draw: (now: number) => void) => frames.push(draw));
  vi.stubGlobal("cancelAnimationFrame", () => {
    frames = [];
  });
  vi.stubGlobal("matchMedia", () => ({ matches: false }));
  vi.stubGlobal("Worker", SilentWorker);
});

afterEach(() => vi.unstubAllGlobals());

describe("the buffers of the front", () => {
  /** The triangles of the buffers, without free slots, in a canonical order. */
  const triangles = ({ positions, slotCount }: FrontBuffers): string[] =>
    Array.from({ length: slotCount }, (_, slot) => positions.slice(9 * slot, 9 * slot + 9))
      .filter((corners) => corners.some((coordinate) => coordinate !== 0))
      .map((corners) => corners.join(" "))
      .sort();

  const written = (state: number): string[] =>
    Array.from(trace.frontAt(state), (face) =>
      Float32Array.from(cornersOf(trace, face).flat()).join(" "),
    ).sort();

  it("hold the front after 200 random jumps and steps", () => {
    const buffers = new FrontBuffers(trace);
    const random = randomSource(20);
    for (let i = 0; i < 200; i++) {
      const state = random() % (trace.stepCount + 1);
      buffers.show(state);
      expect(triangles(buffers)).toEqual(written(state));
    }
  });

  it("leave faces out, and have them again in other states", () => {
    const buffers = new FrontBuffers(trace);
    const random = randomSource(21);
    for (let i = 0; i < 200; i++) {
      const state = random() % (trace.stepCount + 1);
      const front = [...trace.frontAt(state)];
      const leftOut = i % 3 === 0 ? [] : front.slice(0, 3);
      const kept = front.slice(leftOut.length).map((face) => cornersOf(trace, face).flat());
      buffers.show(state, leftOut);
      expect(triangles(buffers)).toEqual(kept.map((face) => Float32Array.from(face).join(" ")).sort());
    }
  });

  it("are written in place: a step changes few slots", () => {
    const buffers = new FrontBuffers(trace);
    buffers.show(40);
    expect(buffers.written()?.[0]).toBe(0);
    expect(buffers.written()).toBeNull();
    buffers.show(41);
    expect(buffers.written()).not.toBeNull();
    buffers.show(41);
    expect(buffers.written()).toBeNull();
    expect(buffers.slotCount).toBeLessThanOrEqual(buffers.positions.length / 9);
  });

  it("hold the last elements that still exist", () => {
    const elements = new ElementBuffers(trace);
    elements.show(trace.stepCount, "last", [0, 0, 0]);
    expect(elements.cornerCount).toBe(12);
    elements.show(0, "recent", [0, 0, 0]);
    expect(elements.cornerCount).toBe(0);
    elements.show(10, "none", [0, 0, 0]);
    expect(elements.cornerCount).toBe(0);
  });
});

describe("the player", () => {
  it("knows verdicts from the beat of the test on: a candidate that is chosen before leads there", async () => {
    const player = playerOf(newApp());
    await player.open(bytes);
    player.seek(1);
    for (const [beat, after] of [
      [2, 4],
      [4, 4],
      [null, null],
    ] as const) {
      player.showBeat(beat);
      player.choose(0);
      expect(player.state.getState()).toMatchObject({ candidate: 0, beat: after });
    }
  });

  it("moves within the trace, and forgets the chosen candidate", async () => {
    const player = playerOf(newApp());
    await player.open(bytes);
    const step = () => player.state.getState().step;
    player.move(5);
    player.state.setState({ candidate: 0 });
    player.move(-2);
    expect(step()).toBe(3);
    expect(player.state.getState().candidate).toBeNull();
    player.move(Infinity);
    expect(step()).toBe(trace.stepCount);
    player.move(-Infinity);
    expect(step()).toBe(0);
    player.seek(12.4);
    expect(step()).toBe(12);
  });

  it("shows every state at once, but the lens waits for the last of a scrub", async () => {
    const player = playerOf(newApp());
    await player.open(bytes);
    vi.useFakeTimers();
    const shown = () => {
      const { step, lensStep } = player.state.getState();
      return [step, lensStep];
    };
    vi.advanceTimersByTime(1000);
    player.seek(10);
    expect(shown()).toEqual([10, 10]);
    for (const step of [20, 30, 40]) {
      vi.advanceTimersByTime(40);
      player.seek(step);
      expect(shown()).toEqual([step, 10]);
    }
    vi.advanceTimersByTime(400);
    expect(shown()).toEqual([40, 40]);
    player.seek(50);
    player.jump("postponed", 1);
    expect(player.state.getState().lensStep).toBe(player.state.getState().step);
    // The first press on the slider begins a scrub: its frame has no time for the lens.
    vi.advanceTimersByTime(1000);
    const { lensStep } = player.state.getState();
    player.scrub(12);
    expect(shown()).toEqual([12, lensStep]);
    vi.advanceTimersByTime(400);
    expect(shown()).toEqual([12, 12]);
    vi.useRealTimers();
  });

  it("does not compute the lens of the states between which it is scrubbed or a key is held", async () => {
    const player = playerOf(newApp());
    await player.open(bytes);
    vi.useFakeTimers();
    vi.advanceTimersByTime(1000);
    player.move(1);
    const lensSteps = new Set<number>();
    const stop = player.state.subscribe(({ lensStep }) => lensSteps.add(lensStep));
    for (let repeat = 0; repeat < 5; repeat++) {
      vi.advanceTimersByTime(40);
      player.move(1);
    }
    for (const step of [30, 20, 25]) {
      vi.advanceTimersByTime(40);
      player.scrub(step);
    }
    expect([...lensSteps]).toEqual([1]);
    vi.advanceTimersByTime(400);
    expect([...lensSteps]).toEqual([1, 25]);
    // While the front is played, the lens waits too; a scrub pauses, and the lens follows then.
    player.play();
    player.scrub(10);
    expect(player.state.getState()).toMatchObject({ step: 10, lensStep: 25, isPlaying: false });
    vi.advanceTimersByTime(400);
    expect(player.state.getState().lensStep).toBe(10);
    stop();
    vi.useRealTimers();
  });

  it("plays at its speed, pauses at a kind of step, and repeats a range", async () => {
    const player = playerOf(newApp());
    await player.open(bytes);
    player.setSpeed(100);
    player.play();
    drawFrame(16);
    drawFrame(50);
    expect(player.state.getState()).toMatchObject({ step: 5, isPlaying: true });
    player.state.setState({ stopAt: "postponed" });
    drawFrame(200);
    expect(player.state.getState()).toMatchObject({ step: 6, isPlaying: false });
    player.state.setState({ stopAt: null, loop: { from: 2, to: 8 } });
    player.play();
    drawFrame(10);
    drawFrame(200);
    // The last step is shown before the first one comes again.
    expect(player.state.getState()).toMatchObject({ step: 8, isPlaying: true });
    drawFrame(10);
    expect(player.state.getState()).toMatchObject({ step: 2, isPlaying: true });
    player.toggle();
    drawFrame(200);
    expect(player.state.getState()).toMatchObject({ step: 2, isPlaying: false });
  });

  it("chooses the candidate because of which it pauses", async () => {
    const player = playerOf(newApp());
    await player.open(bytes);
    player.setSpeed(100);
    player.state.setState({ stopAt: "crosses" });
    player.play();
    for (let frame = 0; frame < 100 && player.state.getState().isPlaying; frame++) drawFrame(200);
    const { step, candidate, lensStep } = player.state.getState();
    const reached = trace.stepAt(step);
    expect(reached?.kind === "advance" && reached.candidates[candidate ?? -1]?.verdict).toBe("crosses");
    expect(lensStep).toBe(step);
  });

  it("shows one picture per second if the user prefers no motion, at the chosen speed", async () => {
    vi.stubGlobal("matchMedia", () => ({ matches: true }));
    const player = playerOf(newApp());
    await player.open(bytes);
    player.play();
    expect(player.state.getState()).toMatchObject({ step: 0, isPlaying: true, playsStills: true });
    const pictures = new Set<number>();
    for (let frame = 0; frame <= 18; frame++) {
      // Exact in binary, so that eight of them are a second.
      drawFrame(125);
      pictures.add(player.state.getState().step);
    }
    expect([...pictures]).toEqual([0, 25, 50]);
    player.pause();
    drawFrame(1000);
    expect(player.state.getState()).toMatchObject({ step: 50, isPlaying: false });
  });

  it("plays every beat of a step at slow speeds, and leaves the beats at fast ones", async () => {
    const player = playerOf(newApp());
    await player.open(bytes);
    const shown = () => {
      const { step, beat } = player.state.getState();
      return [step, beat];
    };
    player.setSpeed(1);
    player.play();
    drawFrame(10);
    const states: unknown[] = [];
    // Exact in binary: a fifth of a second and more is a beat.
    for (let frame = 0; frame < 6; frame++) {
      drawFrame(203.125);
      states.push(shown());
    }
    expect(states).toEqual([
      [1, 1],
      [1, 2],
      [1, 3],
      [1, 4],
      [1, null],
      [2, 1],
    ]);
    expect(player.state.getState().lensStep).toBe(2);
    player.setSpeed(100);
    expect(shown()).toEqual([2, null]);
    player.setSpeed(1);
    player.showBeat(3);
    expect(player.state.getState()).toMatchObject({ step: 2, beat: 3, isPlaying: false });
    player.play();
    drawFrame(10);
    drawFrame(203.125);
    expect(shown()).toEqual([2, 4]);
    player.move(1);
    expect(player.state.getState()).toMatchObject({ step: 3, beat: null, isPlaying: false });
    player.showBeat(5);
    expect(shown()).toEqual([3, null]);
    player.setFilm(false);
    player.play();
    for (let frame = 0; frame < 6; frame++) drawFrame(203.125);
    expect(shown()).toEqual([4, null]);
    player.pause();
  });

  it("shows the film of the last step to its end, and then pauses", async () => {
    const player = playerOf(newApp());
    await player.open(bytes);
    player.setSpeed(1);
    player.seek(trace.stepCount - 1);
    player.play();
    drawFrame(10);
    const beats: unknown[] = [];
    for (let frame = 0; frame < 20 && player.state.getState().isPlaying; frame++) {
      drawFrame(203.125);
      beats.push(player.state.getState().beat);
    }
    expect(beats.slice(0, 5)).toEqual([1, 2, 3, 4, null]);
    expect(player.state.getState()).toMatchObject({ step: trace.stepCount, isPlaying: false });
    // Playing goes on from a beat of the last step, and not from the beginning.
    player.showBeat(2);
    player.play();
    expect(player.state.getState().step).toBe(trace.stepCount);
    player.pause();
  });

  it("has the kinds of steps that a search from the first state finds", () => {
    const plain = starTrace(starSurface(boxSurface(3, [-1, -1, -1], [1, 1, 1]))).bytes;
    const read = readTrace(plain);
    if (!read.success) throw new Error(read.errors[0].message);
    for (const each of [trace, read.value])
      expect(stopKindsOf(each)).toEqual(stopKinds.filter((kind) => nextStop(each, 0, 1, kind) !== null));
    expect(stopKindsOf(trace)).toContain("recovery");
    expect(stopKindsOf(read.value)).not.toContain("recovery");
  });

  it("jumps to every kind of step and back", async () => {
    const player = playerOf(newApp());
    await player.open(bytes);
    // The surface of this trace was given: it has neither lines nor patches.
    for (const kind of stopKinds.filter((other) => other !== "line" && other !== "patch")) {
      player.seek(0);
      const stops: number[] = [];
      while (player.jump(kind, 1)) stops.push(player.state.getState().step);
      expect(stops.length, kind).toBeGreaterThan(0);
      expect(stops.every((stop) => nextStop(trace, stop - 1, 1, kind) === stop)).toBe(true);
      if (stops.length > 1) expect(nextStop(trace, stops[1] ?? 0, -1, kind)).toBe(stops[0]);
    }
    player.seek(0);
    player.jump("crosses", 1);
    const { step, candidate } = player.state.getState();
    const shown = trace.stepAt(step);
    expect(shown?.kind === "advance" && shown.candidates[candidate ?? -1]?.verdict).toBe("crosses");
  });

  it("says why a file is no trace, and closes with the document and with a run", async () => {
    const app = newApp();
    await playerOf(app).open(new Uint8Array(20));
    expect(playerOf(app).state.getState()).toMatchObject({ trace: null, failure: [/no trace/] });
    await playerOf(app).open(bytes);
    expect(playerOf(app).state.getState()).toMatchObject({ failure: null });
    app.showProject(cubeProject());
    expect(playerOf(app).state.getState().trace).toBeNull();
    await playerOf(app).open(bytes);
    void app.run.generate();
    expect(playerOf(app).state.getState().trace).toBeNull();
  });
});

/** Waits until a trace is being read; a quick machine may have read it all before a poll sees that. */
function untilReading({ state }: Player): Promise<void> {
  return new Promise((resolve) => {
    const stop = state.subscribe(({ reading }) => {
      if (reading === null) return;
      stop();
      resolve();
    });
  });
}

describe("reading a trace", () => {
  const large = starTrace(starSurface(boxSurface(20, [-1, -1, -1], [1, 1, 1]))).bytes;

  it("shows the trace at once when it is read: never an empty panel between them", async () => {
    const player = playerOf(newApp());
    const seen: string[] = [];
    player.state.subscribe(({ reading, trace: shown }) =>
      seen.push(reading !== null ? "reading" : shown ? "trace" : "nothing"),
    );
    await player.open(large);
    expect(seen.filter((state, i) => state !== seen[i - 1]).slice(-2)).toEqual(["reading", "trace"]);
  });

  it("can be cancelled; the model stays", async () => {
    const player = playerOf(newApp());
    const begun = untilReading(player);
    const opened = player.open(large);
    await begun;
    player.stopReading();
    await opened;
    expect(player.state.getState()).toMatchObject({ reading: null, trace: null, failure: null });
  });

  it("keeps the trace that is shown until another one is read, and if it cannot be read", async () => {
    const player = playerOf(newApp());
    await player.open(bytes);
    const shown = player.state.getState().trace;
    const begun = untilReading(player);
    const opened = player.open(large);
    await begun;
    expect(player.state.getState().trace).toBe(shown);
    player.stopReading();
    await opened;
    expect(player.state.getState()).toMatchObject({ reading: null, trace: shown, failure: null });
    await player.open(new Uint8Array(20));
    expect(player.state.getState()).toMatchObject({ reading: null, trace: shown, failure: [/no trace/] });
  });

  it("ends with a message after a failure that no reader foresees", async () => {
    const player = playerOf(newApp());
    const detached = Uint8Array.from(bytes);
    structuredClone(detached.buffer, { transfer: [detached.buffer] });
    await player.open(detached);
    expect(player.state.getState()).toMatchObject({ reading: null, trace: null, failure: [/detached/] });
    await player.open(bytes);
    expect(player.state.getState()).toMatchObject({ failure: null, trace: { stepCount: trace.stepCount } });
  });

  it("says that a trace does not fit into memory", async () => {
    const player = playerOf(newApp());
    const slice = vi.spyOn(Uint32Array.prototype, "slice").mockImplementation(() => {
      throw new RangeError("Array buffer allocation failed");
    });
    await player.open(bytes);
    slice.mockRestore();
    expect(player.state.getState()).toMatchObject({ reading: null, failure: [/do not fit into memory/] });
  });

  it("ends if another trace or another document is opened", async () => {
    const app = newApp();
    const first = playerOf(app).open(large);
    await playerOf(app).open(bytes);
    await first;
    expect(playerOf(app).state.getState().trace?.stepCount).toBe(trace.stepCount);
    const last = playerOf(app).open(large);
    app.showProject(cubeProject());
    await last;
    expect(playerOf(app).state.getState()).toMatchObject({ reading: null, trace: null });
  });
});

describe("the paper's crossing test", () => {
  const face = [
    [0, 0, 0],
    [1, 0, 0],
    [0, 1, 0],
  ] as const;

  it("gives the coordinates of the point where side and plane meet", () => {
    const alphas = alphasOf(
      [
        [0.25, 0.5, -1],
        [0.25, 0.5, 3],
      ],
      face,
    );
    expect(alphas).toEqual([0.25, 0.5, 0.25, 0.25]);
    expect(excessOf([0.25, 0.5, 0.25, 0.25])).toBe(-0.25);
  });

  it("has no result for a side in parallel, and a positive excess beside the face", () => {
    expect(
      alphasOf(
        [
          [0, 0, 1],
          [1, 0, 1],
        ],
        face,
      ),
    ).toBeNull();
    const beside = alphasOf(
      [
        [2, 0, -1],
        [2, 0, 1],
      ],
      face,
    );
    expect(beside && excessOf(beside)).toBe(1);
  });
});

describe("the independent check", () => {
  it("finds no crossing for accepted candidates, and the front's own faces do not count", () => {
    for (let i = 1; i <= trace.stepCount; i++) {
      const step = trace.stepAt(i);
      if (step?.kind !== "advance" || step.outcome !== "accepted") continue;
      const accepted = step.candidates.at(-1);
      if (!accepted) throw new Error(`step ${i} has no candidate`);
      const element = newElement(trace, step.face, accepted.position, accepted.isNew ? null : accepted.node);
      expect(isBehind(element)).toBe(false);
      expect(crossedFaces(trace, i - 1, element)).toEqual([]);
    }
  });

  it("takes the face of a dangling sheet that is on the element's side, of two with the same nodes", () => {
    const points = [0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1];
    const events = new TraceBytes();
    writeFirstFaces(events, [0, 1, 2, 0, 1, 3, 1, 0, 3]);
    const read = readTrace(traceBytes({ points, steps: 0, events: events.event(6) }));
    if (!read.success) throw new Error(read.errors[0].message);
    const element = newElement(read.value, 0, [0, 0, 1], 3);
    expect(isBehind(element)).toBe(false);
    const { left, joined } = frontChange(read.value, 0, 0, element);
    expect(left).toEqual([0, 2]);
    expect(joined).toEqual([
      element.corners.slice(1),
      [element.corners[2], element.corners[0], element.corners[3]],
    ]);
  });

  it("finds the walls that an element leaves the box through, and apexes behind the base", () => {
    const step = trace.stepAt(1);
    if (step?.kind !== "advance") throw new Error("step 1 is no advance");
    const [a] = cornersOf(trace, step.face);
    const beyond = newElement(trace, step.face, [-4 * a[0], -3 * a[1], -2.5 * a[2]], null);
    const crossed = crossedFaces(trace, 0, beyond);
    expect(crossed.length).toBeGreaterThan(0);
    expect(crossed.every((face) => crossesFace(trace, beyond, face, touching))).toBe(true);
    expect(isBehind(newElement(trace, step.face, [2 * a[0], 2 * a[1], 2 * a[2]], null))).toBe(true);
  });
});
