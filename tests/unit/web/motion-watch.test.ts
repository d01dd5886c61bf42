/** When the view counts as moving, and when it is at rest. */
import { beforeEach, describe, expect, it, vi } from "vitest";
import { MotionWatch } from "../../../web/viewer/motion-watch";

let scheduled: Map<number, () => void>;
let now: number;

beforeEach(() => {
  scheduled = new Map();
  // 0 is no handle of a browser.
  let handle = 0;
  now = 1000;
  vi.spyOn(performance, "now").mockImplementation(() => now);
  vi.stubGlobal("requestAnimationFrame", (callback: () => void) => {
    scheduled.set(++handle, callback);
    return handle;
  });
  vi.stubGlobal("cancelAnimationFrame", (cancelled: number) => scheduled.delete(cancelled));
  return () => {
    vi.restoreAllMocks();
    vi.unstubAllGlobals();
  };
});

/** Lets the page show a frame, after a time in milliseconds. */
function tick(ms: number): void {
  now += ms;
  const callbacks = [...scheduled.values()];
  scheduled.clear();
  for (const callback of callbacks) callback();
}

function watch() {
  const onRest = vi.fn();
  return { onRest, motion: new MotionWatch(onRest) };
}

/** Draws frames whose times are those of their pixels. Returns their shares of the full resolution. */
const move = (motion: MotionWatch, frames: number, ms: number): number[] =>
  Array.from({ length: frames }, () => {
    const share = motion.nextFrame();
    tick(ms * share ** 2);
    return share;
  });

describe("MotionWatch", () => {
  it("rests 300 ms after the last frame, once", () => {
    const { onRest, motion } = watch();
    expect(new Set(move(motion, 20, 16))).toEqual(new Set([1]));
    // The last tick was 16 ms after the last frame.
    for (let passed = 32; passed < 300; passed += 16) {
      tick(16);
      expect(onRest).not.toHaveBeenCalled();
    }
    tick(16);
    expect(onRest).toHaveBeenCalledTimes(1);
    tick(1000);
    expect(onRest).toHaveBeenCalledTimes(1);
    expect(scheduled.size).toBe(0);
  });

  it("does not take slow frames for rest", () => {
    const { onRest, motion } = watch();
    const shares = move(motion, 30, 400);
    expect(onRest).not.toHaveBeenCalled();
    // Slow frames are what the lower resolution is for.
    expect(Math.min(...shares)).toBeLessThan(1);
    tick(400);
    expect(onRest).not.toHaveBeenCalled();
    tick(400);
    expect(onRest).toHaveBeenCalledTimes(1);
  });

  it("waits for three frames of the page, however long they take", () => {
    const { onRest, motion } = watch();
    motion.nextFrame();
    tick(1000);
    tick(1000);
    expect(onRest).not.toHaveBeenCalled();
    tick(1000);
    expect(onRest).toHaveBeenCalledTimes(1);
  });

  it("does not take one frame alone for a motion, and draws it in full", () => {
    const { motion } = watch();
    for (let i = 0; i < 20; i++) {
      expect(motion.nextFrame()).toBe(1);
      // The times until it rests are not those of a motion, though they are long.
      for (let k = 0; k < 5; k++) tick(400);
    }
    expect(scheduled.size).toBe(0);
  });

  it("begins the next motion with the resolution of the last one", () => {
    const { onRest, motion } = watch();
    const slow = move(motion, 30, 100).at(-1) ?? 1;
    expect(slow).toBeLessThan(1);
    for (let k = 0; k < 5; k++) tick(100);
    expect(onRest).toHaveBeenCalledTimes(1);
    // The first frame may be the only one.
    expect(move(motion, 3, 100)).toEqual([1, slow, slow]);
  });

  it("says nothing after its stop", () => {
    const { onRest, motion } = watch();
    motion.nextFrame();
    motion.stop();
    for (let k = 0; k < 5; k++) tick(400);
    expect(onRest).not.toHaveBeenCalled();
  });
});
