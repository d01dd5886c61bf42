/**
 * Random bodies, damaged at random: Booleans of spheres, boxes and cylinders (Manifold), at random scales and distances from the
 * origin. Damages: flipped, missing and duplicate triangles, noise, needles, bodies in bodies, overlaps, single precision.
 */
import Module from "manifold-3d";

/** A generator of numbers from 0 to 1 (mulberry32). */
function randomOf(seed) {
  let state = (seed * 2654435761) >>> 0;
  return () => {
    state = (state + 0x6d2b79f5) >>> 0;
    let t = state;
    t = Math.imul(t ^ (t >>> 15), t | 1);
    t ^= t + Math.imul(t ^ (t >>> 7), t | 61);
    return ((t ^ (t >>> 14)) >>> 0) / 4294967296;
  };
}

const library = await Module();
library.setup();
const { Manifold } = library;

function pieceOf(random) {
  const size = () => 0.3 + random();
  const shapes = [
    () => Manifold.sphere(size(), 8 + 4 * Math.floor(8 * random())),
    () => Manifold.cube([size(), size(), size()], true),
    () => Manifold.cylinder(2 * size(), 0.5 * size(), 0.5 * size(), 6 + Math.floor(30 * random()), true),
    () => Manifold.tetrahedron(),
  ];
  return shapes[Math.floor(random() * shapes.length)]()
    .rotate([360 * random(), 360 * random(), 360 * random()])
    .translate([random(), random(), random()]);
}

/** Returns a closed body as arrays. */
function bodyOf(random) {
  let body = pieceOf(random);
  for (let i = Math.floor(4 * random()); i > 0; i--) {
    const other = pieceOf(random);
    const kind = random();
    const made = kind < 0.5 ? body.add(other) : kind < 0.85 ? body.subtract(other) : body.intersect(other);
    if (made.numTri() > 0) body = made;
  }
  const { vertProperties, triVerts, numProp } = body.getMesh();
  const count = vertProperties.length / numProp;
  const points = Array.from(
    { length: 3 * count },
    (_, i) => vertProperties[numProp * Math.floor(i / 3) + (i % 3)],
  );
  return { points, triangles: [...triVerts] };
}

function append(to, { points, triangles }, scale, shift) {
  const nodes = to.points.length / 3;
  points.forEach((x, i) => to.points.push(x * scale + shift[i % 3]));
  triangles.forEach((node) => to.triangles.push(node + nodes));
}

const damages = {
  none: () => undefined,
  flips({ triangles }, random) {
    for (let t = 0; t < triangles.length; t += 3)
      if (random() < 0.05) [triangles[t], triangles[t + 1]] = [triangles[t + 1], triangles[t]];
  },
  inverted({ triangles }) {
    for (let t = 0; t < triangles.length; t += 3)
      [triangles[t], triangles[t + 1]] = [triangles[t + 1], triangles[t]];
  },
  holes(body, random) {
    body.triangles = body.triangles.filter((_, i, all) => {
      if (i % 3 === 0) all.drop = random() < 0.03;
      return !all.drop;
    });
  },
  duplicates({ triangles }, random) {
    for (let t = triangles.length - 3; t >= 0; t -= 3)
      if (random() < 0.05) triangles.push(...triangles.slice(t, t + 3));
  },
  noise({ points }, random) {
    const size = 10 ** (-16 + 14 * random());
    points.forEach((x, i) => (points[i] = x + size * (random() - 0.5)));
  },
  soup(body, random) {
    const noise = random() < 0.5 ? 0 : 1e-7;
    const points = body.triangles.flatMap((node) =>
      body.points.slice(3 * node, 3 * node + 3).map((x) => x + noise * (random() - 0.5)),
    );
    body.points = points;
    body.triangles = body.triangles.map((_, i) => i);
  },
  needles({ points }, random) {
    const by = 10 ** (-4 * random());
    points.forEach((x, i) => (points[i] = i % 3 === 0 ? x * by : x));
  },
  nested(body, random) {
    const inner = structuredClone(body);
    if (random() < 0.5) damages.inverted(inner);
    append(body, inner, 0.3 + 0.3 * random(), [0.2, 0.2, 0.2]);
  },
  overlap(body, random) {
    append(body, structuredClone(body), 1, [0.3 * random(), 0.3 * random(), 0.3 * random()]);
  },
  tiny(body, random) {
    append(body, structuredClone(body), 10 ** (-6 * random()), [5, 5, 5]);
  },
};

function placed({ points, triangles }, random) {
  const kind = random();
  const scale = random() < 0.5 ? 1 : 10 ** (60 * random() - 30);
  const far = kind < 0.5 ? 0 : 10 ** (15 * random()) * scale;
  const isSingle = random() < 0.2;
  const moved = points.map((x, i) => x * scale + far * [1, -0.7, 0.3][i % 3]);
  return {
    points: Float64Array.from(moved, (x) => (isSingle ? Math.fround(x) : x)),
    triangles: Uint32Array.from(triangles),
    place: `scale ${scale.toPrecision(2)}, distance ${(far / scale).toPrecision(2)}${isSingle ? ", single" : ""}`,
  };
}

/** Returns a surface, and words for what it is. */
export function randomBody(seed) {
  const random = randomOf(seed + 1);
  const body = bodyOf(random);
  const names = Object.keys(damages);
  const chosen = [names[Math.floor(random() * names.length)], names[Math.floor(random() * names.length)]];
  for (const name of chosen) damages[name](body, random);
  const { place, ...surface } = placed(body, random);
  return { surface, words: `${chosen.join(" + ")}, ${place}, ${surface.triangles.length / 3} triangles` };
}
