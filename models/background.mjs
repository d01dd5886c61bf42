/** Background grids with few tetrahedra. */

/** Faces of a box by their corners; bits 0, 1, 2 of a corner mean high in x, y, z. */
const boxCorners = [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]]; // prettier-ignore

/**
 * Prisms of three tetrahedra between sections of corresponding nodes. A section is a list of { position, size }
 * (optionally stretching and direction). `triangles` holds ascending indices in it, so that neighbouring prisms
 * divide their common face in the same way.
 */
export const prisms = (builder, sections, triangles) => {
  const ids = sections.map((section) =>
    section.map(({ position, size, ...more }) => builder.node(position, size, more)),
  );
  for (let cell = 0; cell + 1 < ids.length; ++cell) {
    const [low, high] = [ids[cell], ids[cell + 1]];
    for (const [a, b, c] of triangles) {
      builder.tetrahedron(low[a], low[b], low[c], high[c]);
      builder.tetrahedron(low[a], low[b], high[b], high[c]);
      builder.tetrahedron(low[a], high[a], high[b], high[c]);
    }
  }
};

/**
 * A row of boxes along x, each of six tetrahedra. Each station is { x, size } (optionally stretching and
 * direction); the boxes cover the given ranges of y and z.
 */
export const boxRow = (builder, stations, [y0, y1], [z0, z1]) => {
  const corners = [[y0, z0], [y1, z0], [y0, z1], [y1, z1]]; // prettier-ignore
  const sections = stations.map(({ x, ...station }) =>
    corners.map(([y, z]) => ({ ...station, position: [x, y, z] })),
  );
  prisms(builder, sections, [[0, 1, 3], [0, 2, 3]]); // prettier-ignore
};

/**
 * Half a row of prisms along an axis at y = 0. Each station is { x, z, inner, outer, reach }: the size on the
 * axis, and the size at distance `reach` below, beside and above it.
 */
export const halfPrismsAlongAxis = (builder, stations) => {
  const sections = stations.map(({ x, z = 0, inner, outer, reach }) => [
    { position: [x, 0, z], size: inner },
    { position: [x, 0, z - reach], size: outer },
    { position: [x, reach, z], size: outer },
    { position: [x, 0, z + reach], size: outer },
  ]);
  prisms(builder, sections, [[0, 1, 2], [0, 2, 3]]); // prettier-ignore
};

/** One tetrahedron: four nodes { position, size }. */
export const singleTetrahedron = (builder, nodes) => {
  builder.tetrahedron(...nodes.map(({ position, size, ...more }) => builder.node(position, size, more)));
};

/** One tetrahedron of uniform size, with its right-angled corner below the origin of the first octant. */
export const uniform = (builder, corner, reach, size) => {
  const along = (k) => corner.map((c, i) => (i === k ? c + reach : c));
  singleTetrahedron(
    builder,
    [corner, along(0), along(1), along(2)].map((position) => ({ position, size })),
  );
};

/** Prisms along a centre line: each section has its node there first, then four nodes around it. */
export const fanPrisms = (builder, sections) =>
  prisms(builder, sections, [[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 1, 4]]); // prettier-ignore

/** Twelve tetrahedra from a node { position, size } within a box to the triangles of its faces. */
export const boxStar = (builder, low, high, middle, outerSize) => {
  const corner = (code) => [0, 1, 2].map((k) => ((code >> k) & 1 ? high[k] : low[k]));
  const corners = Array.from({ length: 8 }, (_, code) => builder.node(corner(code), outerSize));
  const { position, size, ...more } = middle;
  const hub = builder.node(position, size, more);
  for (const [a, b, c, d] of boxCorners) {
    builder.tetrahedron(corners[a], corners[b], corners[c], hub);
    builder.tetrahedron(corners[a], corners[c], corners[d], hub);
  }
};
