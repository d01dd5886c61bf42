// Makes closed surfaces as CAD programs export them: flat faces and round walls in as few triangles as possible, so most
// of them are needles.

const TURN = 2 * Math.PI;

/** Points on a circle, counter-clockwise. */
const circle = (radius, sectors) =>
  Array.from({ length: sectors }, (_, i) => {
    const angle = (TURN * i) / sectors;
    return [radius * Math.cos(angle), radius * Math.sin(angle)];
  });

/** Joins rings of as many nodes each by two triangles per side; `isClosed`: also the last ring with the first. */
function joined(rings, isClosed) {
  const sectors = rings[0].length;
  const triangles = [];
  const steps = isClosed ? rings.length : rings.length - 1;
  for (let r = 0; r < steps; ++r) {
    const [low, high] = [r * sectors, ((r + 1) % rings.length) * sectors];
    for (let i = 0; i < sectors; ++i) {
      const j = (i + 1) % sectors;
      triangles.push(low + i, low + j, high + j, low + i, high + j, high + i);
    }
  }
  return { points: Float64Array.from(rings.flat(2)), triangles };
}

/** A solid of revolution: its section turns around the z axis. Entries are radius and height, counter-clockwise. */
function revolved(section, sectors) {
  const rings = section.map(([radius, z]) => circle(radius, sectors).map(([x, y]) => [x, y, z]));
  const { points, triangles } = joined(rings, true);
  return { points, triangles: Uint32Array.from(triangles) };
}

/** A prism over an outline that its first corner sees whole. */
function prism(outline, height) {
  const rings = [0, height].map((z) => outline.map(([x, y]) => [x, y, z]));
  const { points, triangles } = joined(rings, false);
  const corners = outline.length;
  for (let i = 1; i + 1 < corners; ++i) {
    triangles.push(0, i + 1, i, corners, corners + i, corners + i + 1);
  }
  return { points, triangles: Uint32Array.from(triangles) };
}

/** A ring of needles around a core: two triangles between the inner and the outer circle per sector. */
const tube = (inner, outer, height, sectors) =>
  revolved(
    [
      [inner, 0],
      [outer, 0],
      [outer, height],
      [inner, height],
    ],
    sectors,
  );

/** A wheel with a round rim, a thin web and a hub. */
function wheel(sectors) {
  const rim = Array.from({ length: 19 }, (_, i) => {
    const angle = (Math.PI * (i - 9)) / 10;
    return [1 + 0.12 * Math.cos(angle), 0.12 * Math.sin(angle)];
  });
  const hub = [[0.35, 0.15], [0.2, 0.15], [0.2, -0.15], [0.35, -0.15]]; // prettier-ignore
  return revolved([...hub, [0.35, -0.02], [0.88, -0.02], ...rim, [0.88, 0.02], [0.35, 0.02]], sectors);
}

/** The named parts. */
export const NEEDLE_PARTS = {
  "round bar, 200 sectors": () => prism(circle(1, 200), 6),
  "thin tube": () => tube(0.95, 1, 3, 120),
  "flat washer": () => tube(0.4, 1, 0.08, 160),
  "wheel with a thin web": () => wheel(90),
  "block with a low step": () =>
    prism([[0, 0], [4, 0], [4, 1], [2, 1], [2, 1.002], [0, 1.002]], 2), // prettier-ignore
  "sharp wedge": () => prism([[0, 0], [4, 0], [4, 0.5]], 1), // prettier-ignore
};

/** The surface as a binary STL file. */
export function toStl({ points, triangles }) {
  const count = triangles.length / 3;
  const bytes = Buffer.alloc(84 + 50 * count);
  // Gmsh does not read a small binary file if its header is empty.
  bytes.write("binary STL of a part");
  bytes.writeUInt32LE(count, 80);
  for (let t = 0; t < count; ++t) {
    for (let k = 0; k < 9; ++k) {
      const node = triangles[3 * t + Math.floor(k / 3)];
      bytes.writeFloatLE(points[3 * node + (k % 3)], 84 + 50 * t + 12 + 4 * k);
    }
  }
  return bytes;
}
