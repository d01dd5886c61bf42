/** What the view marks of a step of recovery. */
import { expect, it } from "vitest";
import { readTrace, type Trace } from "tetrafront/trace";
import { cornersOf } from "../../../web/teach/player/judge";
import { initialPlayerState } from "../../../web/teach/player/player";
import { beatAt } from "../../../web/teach/player/film-state";
import { recoveryMarks, recoveryMarksOf } from "../../../web/teach/player/recovery-marks";
import { boxSurface } from "../../support/surfaces";
import { starSurface, starTrace } from "../../support/traces";

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

const trace = readStar();
const steps = Array.from({ length: trace.stepCount }, (_, i) => trace.stepAt(i + 1)).flatMap((step) =>
  step?.kind === "recovery" ? [step] : [],
);

it("are the faces that leave the front, those that join it, and the new nodes", () => {
  expect(steps.length).toBeGreaterThan(0);
  for (const step of steps) {
    const { left, joined, nodes, labels } = recoveryMarks(trace, step);
    const [before, after] = [step.step - 1, step.step].map((state) => new Set(trace.frontAt(state)));
    const gone = [...(before ?? [])].filter((face) => !after?.has(face));
    const come = [...(after ?? [])].filter((face) => !before?.has(face));
    const sorted = (corners: readonly unknown[]): string[] => corners.map(String).sort();
    expect(sorted(left)).toEqual(sorted(gone.flatMap((face) => cornersOf(trace, face))));
    expect(sorted(joined)).toEqual(sorted(come.flatMap((face) => cornersOf(trace, face))));
    expect(nodes).toHaveLength(step.addedNodes.length);
    expect(labels[0]?.text).toMatch(/pocket|attempt/);
  }
});

it("are shown while the front rests at such a step, as the same object", () => {
  const [first] = steps;
  const state = { ...initialPlayerState, trace, step: first?.step ?? 0, lensStep: first?.step ?? 0 };
  const marks = recoveryMarksOf(state);
  // What an opened place has lost would hide it.
  expect(beatAt(state)).toBe("opened");
  expect(marks?.joined.length).toBeGreaterThan(0);
  expect(marks?.left).toEqual([]);
  expect(recoveryMarksOf({ ...state, film: false })?.left.length).toBeGreaterThan(0);
  expect(recoveryMarksOf({ ...state, isPlaying: true })).toBeNull();
  expect(recoveryMarksOf({ ...state, lensStep: state.step - 1 })).toBeNull();
  expect(recoveryMarksOf({ ...state, step: 1, lensStep: 1 })).toBeNull();
  expect(recoveryMarksOf(state)).toBe(recoveryMarksOf(state));
});
