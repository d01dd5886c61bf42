import { beforeEach, expect, it, vi } from "vitest";
import { FrameLoop } from "../../../web/viewer/frame-loop";

let scheduled: Map<number, () => void>;

beforeEach(() => {
  scheduled = new Map();
  let handle = 0;
  vi.stubGlobal("requestAnimationFrame", (callback: () => void) => {
    scheduled.set(++handle, callback);
    return handle;
  });
  vi.stubGlobal("cancelAnimationFrame", (cancelled: number) => scheduled.delete(cancelled));
});

function nextFrame(): void {
  const callbacks = [...scheduled.values()];
  scheduled.clear();
  for (const callback of callbacks) callback();
}

it("the frame loop draws once per animation frame, however often a frame is requested", () => {
  const draw = vi.fn(() => false);
  const loop = new FrameLoop(draw);
  loop.start();
  loop.request();
  loop.request();
  nextFrame();
  expect(draw).toHaveBeenCalledTimes(1);
  expect(loop.frames).toBe(1);
  nextFrame();
  expect(draw).toHaveBeenCalledTimes(1);
});

it("the frame loop continues during a motion", () => {
  let left = 3;
  const loop = new FrameLoop(() => --left > 0);
  loop.start();
  for (let frame = 0; frame < 10; ++frame) nextFrame();
  expect(loop.frames).toBe(3);
});

it("the frame loop draws nothing before its start and after its stop", () => {
  const draw = vi.fn(() => true);
  const loop = new FrameLoop(draw);
  loop.request();
  loop.drawNow();
  nextFrame();
  expect(draw).not.toHaveBeenCalled();
  loop.start();
  loop.stop();
  nextFrame();
  loop.request();
  nextFrame();
  expect(draw).not.toHaveBeenCalled();
});

it("the frame loop can draw at once instead of at the next animation frame", () => {
  const draw = vi.fn(() => false);
  const loop = new FrameLoop(draw);
  loop.start();
  loop.drawNow();
  nextFrame();
  expect(draw).toHaveBeenCalledTimes(1);
});

it("the frame loop notifies its listeners of every frame until they unsubscribe", () => {
  const listener = vi.fn();
  const loop = new FrameLoop(() => false);
  loop.start();
  const stop = loop.onDrawn(listener);
  nextFrame();
  stop();
  loop.request();
  nextFrame();
  expect(listener).toHaveBeenCalledTimes(1);
});

it("the frame loop lets requested frames wait for some work, and draws them when it has ended", async () => {
  const draw = vi.fn(() => false);
  const loop = new FrameLoop(draw);
  loop.start();
  let end: () => void = () => undefined;
  const waiting = loop.waitFor(new Promise((resolve) => (end = resolve)));
  loop.request();
  nextFrame();
  expect(draw).not.toHaveBeenCalled();
  expect(loop.restedMs).toBe(0);
  end();
  await waiting;
  nextFrame();
  expect(draw).toHaveBeenCalledTimes(1);
  // Nothing is requested now.
  await loop.waitFor(Promise.resolve());
  nextFrame();
  expect(draw).toHaveBeenCalledTimes(1);
});
