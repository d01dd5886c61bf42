import { MessageChannel } from "node:worker_threads";
import { expect, it } from "vitest";
import { handedOver } from "../../../web/workers/transfer";

it("hands over copies of typed arrays, whatever part of a buffer they are, and keeps the caller's own", async () => {
  const all = Float64Array.from({ length: 100 }, (_, i) => i / 7);
  const holder = { points: all.subarray(10, 40), tetrahedra: Uint32Array.from([3, 1, 4, 1, 5]), name: "π" };
  const { copy, buffers } = handedOver(holder);
  expect(copy).toEqual(holder);
  expect(buffers.map(({ byteLength }) => byteLength)).toEqual([30 * 8, 5 * 4]);

  const { port1, port2 } = new MessageChannel();
  const received = new Promise((resolve) => port2.once("message", resolve));
  port1.postMessage(copy, buffers);
  expect(await received).toEqual(holder);
  port1.close();
  expect(copy.points).toHaveLength(0);
  expect(holder.points).toHaveLength(30);
  expect(holder.tetrahedra).toHaveLength(5);
});
