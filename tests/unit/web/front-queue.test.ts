/** The heap of the front that a lesson draws, checked against the recorded steps. */
import type { FrontOrder } from "tetrafront";
import type { Trace } from "tetrafront/trace";
import { describe, expect, it } from "vitest";
import { FrontQueue } from "../../../web/teach/lessons/front-queue";
import { randomSource } from "../../support/random";
import { galleryProject, recordFront } from "../../support/recorded-models";

const record = (model: string, order: FrontOrder): Promise<Trace> =>
  recordFront(galleryProject(model), { order });

const comparable = (queue: FrontQueue, face: number): readonly number[] => {
  const { ruleClass, size, layers } = queue.rankOf(face);
  return [ruleClass, size, layers];
};
const isBefore = (a: readonly number[], b: readonly number[]): boolean => {
  const i = a.findIndex((value, k) => value !== b[k]);
  return i >= 0 && (a[i] ?? 0) < (b[i] ?? 0);
};

describe.each(["layered", "smallest-first", "first-in", "random"] as const)("the queue, %s", (order) => {
  it("has the recorded base face on top, with its recorded rank, until a pocket stalls", async () => {
    const trace = await record("unit-cube", order);
    const queue = new FrontQueue(trace);
    let checked = 0;
    for (let step = 1; step <= trace.stepCount; step++) {
      const recorded = trace.stepAt(step);
      // Recovery takes faces in another order.
      if (recorded?.kind !== "advance" || recorded.isRemeshing) break;
      queue.show(step - 1);
      const [top = -1] = queue.faces;
      expect(top, `step ${step}`).toBe(recorded.face);
      if (order === "layered")
        expect(comparable(queue, top)).toEqual([recorded.ruleClass, recorded.bucket, recorded.layers]);
      checked++;
    }
    expect(checked).toBeGreaterThan(200);
  });

  it("has all faces of the front, none before its parent, wherever it goes", async () => {
    const trace = await record("unit-cube", order);
    const queue = new FrontQueue(trace);
    const random = randomSource(8);
    for (let i = 0; i < 40; i++) {
      const step = random() % (trace.stepCount + 1);
      queue.show(step);
      const front = new Set(trace.frontAt(step));
      expect(new Set(queue.faces).size).toBe(queue.faces.length);
      expect(queue.faces.every((face) => front.has(face))).toBe(true);
      queue.faces.forEach((face, slot) => {
        const parent = queue.faces[(slot - 1) >> 1];
        if (slot > 0 && parent !== undefined)
          expect(isBefore(comparable(queue, face), comparable(queue, parent))).toBe(false);
      });
    }
  });

  it("needs few comparisons for a step", async () => {
    const trace = await record("unit-cube", order);
    const queue = new FrontQueue(trace);
    for (let step = 1; step <= 200; step++) {
      queue.show(step);
      const levels = Math.ceil(Math.log2(queue.faces.length + 2));
      const { joined = [], left = 0, comparisons = 0 } = queue.work ?? {};
      // Taking or removing a face compares twice per level, adding one compares once.
      expect(comparisons).toBeLessThanOrEqual((2 * levels + 1) * (left + 1) + levels * (joined.length + 1));
    }
  });
});
