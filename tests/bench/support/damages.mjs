// Damages closed surfaces as files from other programs are damaged; each damage is generated from a seed.
import { geodesicSphere } from "./geodesic-sphere.mjs";
import { NEEDLE_PARTS } from "./needle-parts.mjs";

/** Returns a source of numbers from 0 to 1 (a linear congruence of 32 bits). */
function numbersFrom(seed) {
  let state = (2654435761 * (seed + 1)) >>> 0;
  return () => {
    state = (1664525 * state + 1013904223) >>> 0;
    return state / 2 ** 32;
  };
}

function boxOf(points) {
  const low = [Infinity, Infinity, Infinity];
  const high = [-Infinity, -Infinity, -Infinity];
  points.forEach((x, i) => {
    low[i % 3] = Math.min(low[i % 3], x);
    high[i % 3] = Math.max(high[i % 3], x);
  });
  return { low, high, diagonal: Math.hypot(...high.map((x, k) => x - low[k])) };
}

/** Joins surfaces without welding. */
function joined(surfaces) {
  const points = [];
  const triangles = [];
  for (const surface of surfaces) {
    const first = points.length / 3;
    for (const x of surface.points) points.push(x);
    for (const node of surface.triangles) triangles.push(first + node);
  }
  return { points: Float64Array.from(points), triangles: Uint32Array.from(triangles) };
}

const movedBy = ({ points, triangles }, offset) => ({
  points: points.map((x, i) => x + offset[i % 3]),
  triangles,
});

const randomOffset = (random, length) => {
  const direction = [0, 1, 2].map(() => random() - 0.5);
  const size = Math.hypot(...direction) || 1;
  return direction.map((x) => (length * x) / size);
};

/** Corners of the given triangles, each with nodes of its own. */
function soupOf({ points, triangles }, isKept = () => true) {
  const corners = [];
  for (let t = 0; t < triangles.length / 3; ++t) {
    if (!isKept(t)) continue;
    for (let k = 0; k < 3; ++k) {
      const node = triangles[3 * t + k];
      corners.push(points[3 * node], points[3 * node + 1], points[3 * node + 2]);
    }
  }
  return { points: Float64Array.from(corners), triangles: Uint32Array.from(corners.keys()).slice(0, corners.length / 3) }; // prettier-ignore
}

/** Kinds of damage: each makes a broken surface of a closed one. */
export const DAMAGES = {
  /** A few triangles are missing. */
  cut: (surface, seed) => {
    const random = numbersFrom(seed);
    const count = surface.triangles.length / 3;
    const missing = new Set(Array.from({ length: 3 }, () => Math.floor(random() * count)));
    return soupOf(surface, (t) => !missing.has(t));
  },
  /** A copy crosses the body. */
  shifted: (surface, seed) => {
    const random = numbersFrom(seed);
    const { diagonal } = boxOf(surface.points);
    return joined([surface, movedBy(surface, randomOffset(random, (0.02 + 0.1 * random()) * diagonal))]);
  },
  /** A copy nearly coincides with the body: from the rounding of a file to 1e-4 of the diagonal. */
  doubled: (surface, seed) => {
    const random = numbersFrom(seed);
    const { diagonal } = boxOf(surface.points);
    return joined([surface, movedBy(surface, randomOffset(random, diagonal * 10 ** (-4 - 4 * random())))]);
  },
  /** Six spheres cross the body. */
  "spheres added": (surface, seed) => {
    const random = numbersFrom(seed);
    const { low, high, diagonal } = boxOf(surface.points);
    const ball = geodesicSphere(4);
    const balls = Array.from({ length: 6 }, () => {
      const radius = (0.04 + 0.08 * random()) * diagonal;
      const scaled = { ...ball, points: ball.points.map((x) => radius * x) };
      return movedBy(scaled, low.map((x, k) => x + (high[k] - x) * random())); // prettier-ignore
    });
    return joined([surface, ...balls]);
  },
};

/** A soup of spheres, without a body. */
export function sphereSoup(seed) {
  const random = numbersFrom(seed);
  const ball = geodesicSphere(4);
  const balls = Array.from({ length: 20 }, () => {
    const radius = 0.15 + 0.2 * random();
    const scaled = { ...ball, points: ball.points.map((x) => radius * x) };
    return movedBy(scaled, [random(), random(), random()]);
  });
  return soupOf(joined(balls));
}

/** The bodies that are damaged. */
export const BODIES = { ...NEEDLE_PARTS, sphere: () => geodesicSphere(8) };
