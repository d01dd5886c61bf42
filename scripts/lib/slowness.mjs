import { performance } from "node:perf_hooks";

/** Milliseconds of the loop below on a quiet core of the server (AMD EPYC) on which the waits were tried. */
const usualMs = 17;
const maxSlowness = 6;

/** A fixed amount of work, as a page does it: numbers in typed arrays. */
function work() {
  const values = new Float64Array(4096);
  let sum = 0;
  for (let i = 0; i < 8_000_000; i++) {
    values[i & 4095] += Math.sqrt(i);
    sum += values[(i * 31) & 4095];
  }
  return sum;
}

/**
 * Returns how many times as long as usual a fixed amount of work takes now, from 1 to 6: a machine may be slow, or busy. The median
 * of several measurements, because one may be interrupted.
 */
export function slowness() {
  const times = Array.from({ length: 5 }, () => {
    const begin = performance.now();
    work();
    return performance.now() - begin;
  }).sort((a, b) => a - b);
  return Math.min(maxSlowness, Math.max(1, times[2] / usualMs));
}
