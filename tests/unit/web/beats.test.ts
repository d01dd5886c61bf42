/** The film of a step: its beats, how they are played, and what is drawn in each. */
import { readTrace, type AdvanceStep, type RecoveryStep, type Trace } from "tetrafront/trace";
import { beforeAll, describe, expect, it } from "vitest";
import { beatsOf, knownBeat, playsBeats } from "../../../web/teach/player/beats";
import { beatAt, elementsShown, isFilled } from "../../../web/teach/player/film-state";
import { lensMarks, pointedMarks } from "../../../web/teach/player/lens-marks";
import { sceneOf } from "../../../web/teach/player/lens-scene";
import { nearFaces, neighbourhoodOf } from "../../../web/teach/player/near-faces";
import { firstState } from "../../../web/teach/player/phases";
import { initialPlayerState, type PlayerState } from "../../../web/teach/player/player";
import { recoveryMarks } from "../../../web/teach/player/recovery-marks";
import { galleryProject, recordFront } from "../../support/recorded-models";
import { boxSurface } from "../../support/surfaces";
import { starSurface, starTrace } from "../../support/traces";

let trace: Trace;
let recovered: Trace;
beforeAll(async () => {
  trace = await recordFront(galleryProject("unit-cube"));
  const { bytes } = starTrace({
    ...starSurface(boxSurface(3, [0, 0, 0], [1, 1, 1])),
    postponeEvery: 7,
    reopenAfter: 20,
  });
  const read = readTrace(bytes);
  if (!read.success) throw new Error("the trace is valid");
  recovered = read.value;
});

/** The first step of the volume with a refused candidate and an accepted one. */
function refusedStep(): AdvanceStep {
  for (let number = 1; number <= trace.stepCount; number++) {
    const step = trace.stepAt(number);
    if (step?.kind === "advance" && step.outcome === "accepted" && step.candidates.length > 1) return step;
  }
  throw new Error("no candidate was refused");
}

const stateAt = (step: number, more: Partial<PlayerState> = {}): PlayerState => ({
  ...initialPlayerState,
  trace,
  step,
  lensStep: step,
  ...more,
});

it("has five beats for faces and edges, three for stations and stars, and none for a whole line or patch", () => {
  expect(beatsOf(trace, 0)).toEqual([]);
  expect(beatsOf(trace, refusedStep().step)).toEqual(["base", "ideal", "candidates", "test", "element"]);
  const kinds = new Map<string, number>();
  for (let step = firstState(trace) + 1; step < 0; step++) {
    const kind = trace.surface?.kindAt(step - firstState(trace)) ?? "";
    kinds.set(kind, beatsOf(trace, step).length);
  }
  expect(kinds.get("station")).toBe(3);
  expect(kinds.get("accepted")).toBe(5);
  expect(kinds.get("divided")).toBe(0);
  expect(kinds.get("patch")).toBe(0);
  const recovery = Array.from({ length: recovered.stepCount }, (_, i) => recovered.stepAt(i + 1)).filter(
    (step) => step?.kind === "recovery",
  );
  expect(recovery.length).toBeGreaterThan(0);
  for (const step of recovery) expect(["pocket", "attempt"]).toContain(beatsOf(recovered, step.step)[0]);
});

it("keeps beats that the step has; the last one is the state after the step", () => {
  const { step } = refusedStep();
  expect([null, 0, 1, 4, 5, 9].map((beat) => knownBeat(trace, step, beat))).toEqual([
    null,
    1,
    1,
    4,
    null,
    null,
  ]);
  expect(beatAt(stateAt(step))).toBe("element");
  expect(beatAt(stateAt(step, { beat: 2 }))).toBe("ideal");
  expect(beatAt(stateAt(step, { beat: 2, film: false }))).toBeNull();
  expect(playsBeats({ film: true, speed: 1 })).toBe(true);
  expect(playsBeats({ film: true, speed: 5 })).toBe(false);
  expect(playsBeats({ film: false, speed: 1 })).toBe(false);
});

describe("the marks of a beat", () => {
  const marksOf = (beat: number | null, more: Partial<PlayerState> = {}) => {
    const scene = sceneOf(trace, stateAt(refusedStep().step, { beat, ...more }));
    if (!scene) throw new Error("the step has a scene");
    return { scene, marks: lensMarks(scene) };
  };

  it("add the ideal point, the candidates, what was refused, and the element, one after the other", () => {
    const [base, ideal, candidates, test, element] = [1, 2, 3, 4, null].map((beat) => marksOf(beat).marks);
    const { candidates: tried } = refusedStep();
    expect([base?.ideal, base?.candidate, base?.fans, base?.culprit]).toEqual([[], [], [], []]);
    expect(base?.base).toHaveLength(3);
    expect(ideal?.ideal).toEqual([refusedStep().idealPoint]);
    expect(ideal?.rise[1]).toEqual(refusedStep().idealPoint);
    expect(ideal?.candidate).toEqual([]);
    expect(candidates?.fans).toHaveLength(6 * Math.min(9, tried.length));
    expect(candidates?.culprit).toEqual([]);
    expect(candidates?.labels.some(({ kind }) => kind === "failing")).toBe(false);
    const refused = tried.slice(0, 9).filter(({ verdict }) => verdict !== "accepted");
    expect(refused.length).toBeGreaterThan(0);
    expect(test?.refusedFans).toHaveLength(6 * refused.length);
    expect(test?.made).toEqual([]);
    expect(element?.made).toHaveLength(9);
    expect(element?.refusedFans).toEqual([]);
  });

  it("examine the first refused candidate in the test, unless another is chosen", () => {
    expect(marksOf(4).scene.examined?.candidate.verdict).not.toBe("accepted");
    expect(
      marksOf(4, { candidate: refusedStep().candidates.length - 1 }).scene.examined?.candidate.verdict,
    ).toBe("accepted");
    expect(marksOf(null).scene.examined?.candidate.verdict).toBe("accepted");
  });

  it("suppose no other front before the test", () => {
    const rank = refusedStep().candidates.findIndex(
      ({ verdict }) => verdict === "crosses" || verdict === "too-close",
    );
    expect(rank).toBeGreaterThanOrEqual(0);
    expect(marksOf(3, { candidate: rank }).scene.supposed).toBeNull();
    expect(marksOf(4, { candidate: rank }).scene.supposed).not.toBeNull();
  });

  it("highlight the candidate that is pointed at, once candidates are shown", () => {
    const scenes = [2, 3, 4].map((beat) => marksOf(beat).scene);
    const [ideal, candidates, test] = scenes.map((scene) => pointedMarks(scene, 0));
    expect(ideal).toBeNull();
    expect(candidates?.apex).toEqual([refusedStep().candidates[0]?.position]);
    expect(candidates?.culprit).toEqual([]);
    const { culprit } = refusedStep().candidates[0] ?? {};
    expect(test?.culprit).toHaveLength(culprit === null || culprit === undefined ? 0 : 3);
    expect(pointedMarks(scenes[2] ?? null, null)).toBeNull();
  });
});

it("shows a step of a film while it is played slowly, and nothing while it is played fast", () => {
  const { step } = refusedStep();
  expect(sceneOf(trace, stateAt(step, { isPlaying: true, speed: 1 }))).not.toBeNull();
  expect(sceneOf(trace, stateAt(step, { isPlaying: true, speed: 5 }))).toBeNull();
  expect(sceneOf(trace, stateAt(step, { isPlaying: true, speed: 1, film: false }))).toBeNull();
});

it("draws the faces of the front whose centroid is near, and only those", () => {
  const step = refusedStep();
  const near = neighbourhoodOf([step.idealPoint, ...step.candidates.map(({ position }) => position)]);
  if (!near) throw new Error("there are positions");
  const { positions, distances } = nearFaces(trace, step.step - 1, near, [0, 0, 0]);
  const front = trace.frontAt(step.step - 1);
  const isNear = (face: number): boolean => {
    const middle = [0, 1, 2].map((axis) => {
      const nodes = trace.faces.nodes.subarray(3 * face, 3 * face + 3);
      return [...nodes].reduce((sum, node) => sum + (trace.nodes.positions[3 * node + axis] ?? 0), 0) / 3;
    });
    return Math.hypot(...middle.map((x, axis) => x - (near.centre[axis] ?? 0))) < near.reach;
  };
  const expected = front.filter(isNear);
  expect(expected.length).toBeGreaterThan(0);
  expect(expected.length).toBeLessThan(front.length);
  expect(positions).toHaveLength(9 * expected.length);
  const at = 3 * Math.floor(distances.length / 2);
  const corner = [0, 1, 2].map((axis) => (positions[at + axis] ?? 0) - (near.centre[axis] ?? 0));
  expect(distances[at / 3]).toBeCloseTo(Math.hypot(...corner) / near.reach, 5);
  const without = nearFaces(trace, step.step - 1, near, [0, 0, 0], [expected[0] ?? -1]);
  expect(without.positions).toHaveLength(positions.length - 9);
  expect(neighbourhoodOf([])).toBeNull();
});

it("shows a pocket first, then the node, then the star between them", () => {
  const [apex = 0] = trace.elements.nodes.subarray(3, 4);
  const star: RecoveryStep = {
    kind: "recovery",
    change: "star",
    step: 1,
    removedFaces: [0, 1],
    addedFaces: [2],
    removedElements: [],
    addedElements: [0],
    addedNodes: [apex],
  };
  const [pocket, node, closed] = (["pocket", "node", "star"] as const).map((beat) =>
    recoveryMarks(trace, star, beat),
  );
  expect(pocket?.left).toHaveLength(6);
  expect([pocket?.nodes, pocket?.joined, pocket?.star]).toEqual([[], [], []]);
  expect(node?.nodes).toHaveLength(1);
  expect(node?.star).toEqual([]);
  // The node is joined to the three other corners of its element.
  expect(closed?.star).toHaveLength(6);
});

it("ends with the filled volume, cut open, unless no elements are wanted", () => {
  const end = stateAt(trace.stepCount);
  expect(isFilled(end)).toBe(true);
  expect(elementsShown(end)).toBe("cut");
  expect(elementsShown({ ...end, elements: "none" })).toBe("none");
  expect(elementsShown({ ...end, elements: "all" })).toBe("all");
  expect(isFilled({ ...end, beat: 4 })).toBe(false);
  expect(isFilled({ ...end, film: false })).toBe(false);
  expect(isFilled(stateAt(trace.stepCount - 1))).toBe(false);
});
