/** What the lens marks in the view: the part of a face in a new element, and the labels. */
import type { Mesh } from "three";
import { beforeAll, describe, expect, it } from "vitest";
import { readTrace, type AdvanceStep, type Trace } from "tetrafront/trace";
import type { Position } from "../../../web/document/position";
import { areaVector, distance } from "../../../web/document/vectors";
import type { Triangle } from "../../../web/teach/player/crossing";
import { frontDrawing } from "../../../web/teach/player/front-drawing";
import { cornersOf, weightsOf, type NewElement } from "../../../web/teach/player/judge";
import { examine } from "../../../web/teach/player/lens";
import { legendOf, lensMarks } from "../../../web/teach/player/lens-marks";
import { lensSceneOf, type LensScene } from "../../../web/teach/player/lens-scene";
import { supposedFrontText } from "../../../web/teach/panels/player/supposed-front";
import { initialPlayerState, type PlayerState } from "../../../web/teach/player/player";
import { nearestOnFace, partInElement } from "../../../web/teach/player/overlap";
import { ReplayLayer } from "../../../web/teach/player/replay-layer";
import { nextStop } from "../../../web/teach/player/stops";
import { galleryProject, recordFront } from "../../support/recorded-models";
import { randomSource } from "../../support/random";
import { boxSurface } from "../../support/surfaces";
import { starSurface, starTrace } from "../../support/traces";

const random = randomSource(2027);
const unit = (): number => random() / 2 ** 32;
const anywhere = (): Position => [unit(), unit(), unit()];

function readStar(): Trace {
  const { bytes } = starTrace({
    ...starSurface(boxSurface(3, [-1, -1, -1], [1, 1, 1])),
    postponeEvery: 6,
    reopenAfter: 20,
  });
  const read = readTrace(bytes);
  if (!read.success) throw new Error(read.errors[0].message);
  return read.value;
}

describe("the part of a face in an element", () => {
  it("has the area that random positions of the face find in the element", () => {
    for (let round = 0; round < 20; round++) {
      const corners: NewElement["corners"] = [anywhere(), anywhere(), anywhere(), anywhere()];
      const face: Triangle = [anywhere(), anywhere(), anywhere()];
      const whole = Math.hypot(...areaVector(face));
      const part = partInElement(corners, face);
      const share = part.length < 3 ? 0 : Math.hypot(...areaVector(part)) / whole;
      let inside = 0;
      const samples = 4000;
      for (let i = 0; i < samples; i++) {
        const [r, s] = [Math.sqrt(unit()), unit()];
        const weights = [1 - r, r * (1 - s), r * s];
        const position = [0, 1, 2].map((axis) =>
          face.reduce((sum, corner, k) => sum + (weights[k] ?? 0) * (corner[axis] ?? 0), 0),
        );
        const [x = 0, y = 0, z = 0] = position;
        if (weightsOf(corners, [x, y, z]).every((weight) => weight >= 0)) inside++;
      }
      expect(Math.abs(share - inside / samples), `round ${round}`).toBeLessThan(0.04);
    }
  });

  it("is the whole face inside, and nothing apart from it", () => {
    const corners: NewElement["corners"] = [
      [0, 0, 0],
      [3, 0, 0],
      [0, 3, 0],
      [0, 0, 3],
    ];
    const inside: Triangle = [
      [0.1, 0.1, 0.1],
      [0.5, 0.1, 0.1],
      [0.1, 0.5, 0.2],
    ];
    const beyond = inside.map(([x, y, z]): Position => [x + 9, y, z]) as unknown as Triangle;
    expect(partInElement(corners, inside)).toEqual(inside);
    expect(partInElement(corners, beyond)).toEqual([]);
  });
});

it("no position of a face is nearer than the nearest one", () => {
  for (let round = 0; round < 50; round++) {
    const face: Triangle = [anywhere(), anywhere(), anywhere()];
    const from = anywhere();
    const nearest = distance(from, nearestOnFace(face, from));
    for (let i = 0; i < 50; i++) {
      const [r, s] = [Math.sqrt(unit()), unit()];
      const at = [0, 1, 2].map(
        (axis) =>
          (1 - r) * (face[0][axis] ?? 0) + r * (1 - s) * (face[1][axis] ?? 0) + r * s * (face[2][axis] ?? 0),
      );
      const [x = 0, y = 0, z = 0] = at;
      expect(distance(from, [x, y, z])).toBeGreaterThanOrEqual(nearest - 1e-12);
    }
  }
});

describe("the marks of a step", () => {
  const trace = readStar();
  const stateAt = (step: number, change: Partial<PlayerState> = {}): PlayerState => ({
    ...initialPlayerState,
    trace,
    step,
    lensStep: step,
    ...change,
  });
  const stepWith = (verdict: string): readonly [AdvanceStep, number] => {
    for (let number = 1; number <= trace.stepCount; number++) {
      const step = trace.stepAt(number);
      const index = step?.kind === "advance" ? step.candidates.findIndex((c) => c.verdict === verdict) : -1;
      if (step?.kind === "advance" && index >= 0) return [step, index];
    }
    throw new Error(`No candidate is ${verdict}`);
  };

  it("name the base face, the candidate and the face it would cross by the numbers of the sentence", () => {
    const [step, candidate] = stepWith("crosses");
    const scene = lensSceneOf(stateAt(step.step, { candidate }));
    if (!scene) throw new Error("The lens shows nothing");
    const marks = lensMarks(scene);
    const { node, culprit } = step.candidates[candidate] ?? {};
    const texts = marks.labels.map(({ text }) => text.replace(/,/g, ""));
    expect(texts).toContain(`base ${step.face}`);
    expect(texts).toContain(`node ${node}`);
    expect(texts).toContain(`face ${culprit}`);
    expect(marks.base).toEqual(cornersOf(trace, step.face));
    expect(marks.culprit).toEqual(cornersOf(trace, culprit ?? 0));
    expect(marks.isAccepted).toBe(false);
    expect(marks.ideal).toEqual([step.idealPoint]);
    expect(marks.others).toHaveLength(step.candidates.length - 1);
  });

  it("are in the legend as far as the beat shows them", () => {
    const [step, candidate] = stepWith("crosses");
    const kindsAt = (change: Partial<PlayerState>): string[] => {
      const scene = lensSceneOf(stateAt(step.step, { candidate, ...change }));
      return scene ? Object.keys(legendOf(lensMarks(scene))) : [];
    };
    const beats = [1, 2, 3, 4].map((beat) => kindsAt({ film: true, beat }));
    expect(beats).toEqual([
      ["base"],
      ["base", "ideal"],
      ["base", "ideal", "candidate"],
      ["base", "ideal", "candidate", "failing"],
    ]);
    expect(kindsAt({ film: false })).toEqual(beats[3]);
  });

  it("of an accepted candidate show the element, and nothing that fails", () => {
    const [step, candidate] = stepWith("accepted");
    const scene = lensSceneOf(stateAt(step.step, { candidate }));
    if (!scene) throw new Error("The lens shows nothing");
    const marks = lensMarks(scene);
    expect(marks.isAccepted).toBe(true);
    expect(marks.newFaces).toHaveLength(9);
    expect(marks.labels.filter(({ kind }) => kind === "failing")).toEqual([]);
    for (const nothing of [marks.culprit, marks.failingSide, marks.overlap, marks.crossing])
      expect(nothing).toEqual([]);
  });

  it("are the same object for the same state, and none while the front is played", () => {
    const [step] = stepWith("accepted");
    const scene = lensSceneOf(stateAt(step.step));
    expect(lensSceneOf(stateAt(step.step))).toBe(scene);
    expect(lensSceneOf(stateAt(step.step, { isPlaying: true }))).toBeNull();
    expect(lensSceneOf(stateAt(step.step, { lensStep: step.step - 1 }))).toBeNull();
  });

  it("are in drawings with their labels, and fade the front if that is chosen", () => {
    const [step, candidate] = stepWith("crosses");
    const state = stateAt(step.step, { candidate, faces: "all" });
    const scene = lensSceneOf(state);
    const view = {
      width: 300,
      height: 300,
      eye: [0, 0, 1000] as Position,
      toScreen: ([x, y]: Position) => ({ x: 150 + 80 * x, y: 150 - 80 * y }),
    };
    const drawing = frontDrawing(trace, { ...state, scene, fades: true }, view);
    for (const { text } of scene ? lensMarks(scene).labels : []) expect(drawing).toContain(`>${text}</text>`);
    const beside = { ...view, toScreen: ([x, y]: Position) => ({ x: 900 + 80 * x, y: 150 - 80 * y }) };
    expect(frontDrawing(trace, { ...state, scene, fades: true }, beside)).not.toContain(
      'text-anchor="middle"',
    );
    expect(drawing).not.toMatch(/NaN|undefined|null/);
    const fills = (text: string) =>
      [...text.matchAll(/<polygon points="[^"]*" fill="(#\w{6})"/g)].map(([, color]) => color);
    const plain = frontDrawing(trace, { ...state, scene, fades: false }, view);
    expect(fills(drawing)).not.toEqual(fills(plain));
    expect(fills(plain).slice(0, 5)).toEqual(
      fills(frontDrawing(trace, { ...state, scene: null, fades: true }, view)).slice(0, 5),
    );
  });
});

describe("the front of a candidate, of a real model", () => {
  let trace: Trace;
  beforeAll(async () => {
    trace = await recordFront(galleryProject("unit-cube"));
  });

  it("changes as it was recorded", () => {
    let count = 0;
    for (let number = 1; number <= trace.stepCount; number++) {
      const step = trace.stepAt(number);
      const accepted =
        step?.kind === "advance" && step.candidates.find(({ verdict }) => verdict === "accepted");
      if (!accepted) continue;
      const { left, joined } = examine(trace, step, accepted).change;
      expect(left, `step ${number}`).toEqual([...step.removedFaces].sort((a, b) => a - b));
      const corners = [...step.addedFaces].map((face) => cornersOf(trace, face).map(String).sort());
      expect(joined.map((face) => face.map(String).sort()).sort()).toEqual(corners.sort());
      count++;
    }
    expect(count).toBeGreaterThan(100);
  });

  it("is shown as it would be if a candidate that was refused is chosen", () => {
    const at = nextStop(trace, 0, 1, "crosses") ?? 0;
    const step = trace.stepAt(at);
    if (step?.kind !== "advance") throw new Error("No candidate crosses a face");
    const candidate = step.candidates.findIndex(({ verdict }) => verdict === "crosses");
    const state: PlayerState = {
      ...initialPlayerState,
      trace,
      step: at,
      lensStep: at,
      candidate,
      faces: "all",
    };
    expect(lensSceneOf({ ...state, candidate: null })?.supposed).toBeNull();
    const scene = lensSceneOf(state);
    if (!scene?.supposed) throw new Error("The lens shows no front as it would be");
    expect(supposedFrontText(state)).toMatch(/was refused: .* The view shows the front with it: face/);
    expect(supposedFrontText({ ...state, candidate: null })).toBeNull();
    expect(supposedFrontText({ ...state, candidate: step.candidates.length - 1 })).toBeNull();
    const { left, joined } = scene.supposed;
    expect(left).toContain(step.face);
    expect(lensMarks(scene).supposed).toEqual(joined.flat());
    // Faces that join lie between the base and the candidate.
    expect(joined.every((face) => face.includes(scene.examined?.candidate.position ?? face[0]))).toBe(true);
    const before = trace.frontAt(step.step - 1).length;
    const view = {
      width: 300,
      height: 300,
      eye: [0, 0, 1000] as Position,
      toScreen: ([x, y]: Position) => ({ x: 150 + 80 * x, y: 150 - 80 * y }),
    };
    expect(frontDrawing(trace, { ...state, scene }, view).match(/<polygon/g)).toHaveLength(
      before - left.length,
    );
    const layer = new ReplayLayer(trace);
    const drawnFaces = (supposed: LensScene["supposed"]): number => {
      layer.show(state, { isFaded: false, isNear: false, supposed });
      const [front] = layer.root.children as Mesh[];
      const corners = front?.geometry.getAttribute("position").array ?? [];
      return Array.from({ length: corners.length / 9 }, (_, i) => corners.slice(9 * i, 9 * i + 9)).filter(
        (face) => [...face].some((x) => x !== 0),
      ).length;
    };
    expect(drawnFaces(scene.supposed)).toBe(before - left.length);
    expect(drawnFaces(null)).toBe(trace.frontAt(step.step).length);
    layer.dispose();
  });
});
