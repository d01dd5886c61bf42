/** Returns the position of corner k of tetrahedron t of a mesh. */
const corner = ({ points, tetrahedra }, t, k) => {
  const at = 3 * tetrahedra[4 * t + k];
  return points.subarray(at, at + 3);
};

const minus = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];

function volumeOf(mesh, t) {
  const origin = corner(mesh, t, 0);
  const [a, b, c] = [1, 2, 3].map((k) => minus(corner(mesh, t, k), origin));
  return (
    (a[0] * (b[1] * c[2] - b[2] * c[1]) +
      a[1] * (b[2] * c[0] - b[0] * c[2]) +
      a[2] * (b[0] * c[1] - b[1] * c[0])) /
    6
  );
}

/** Returns the largest / smallest volume of a mesh's tetrahedra, and the centroid of the smallest one. */
export function volumeRange(mesh) {
  let smallest = 0;
  let least = Infinity;
  let most = 0;
  for (let t = 0; t < mesh.tetrahedra.length / 4; ++t) {
    const volume = volumeOf(mesh, t);
    most = Math.max(most, volume);
    if (volume >= least) continue;
    least = volume;
    smallest = t;
  }
  const corners = [0, 1, 2, 3].map((k) => corner(mesh, smallest, k));
  const centroid = [0, 1, 2].map((i) => corners.reduce((sum, at) => sum + at[i], 0) / 4);
  return { ratio: most / least, edge: Math.cbrt(6 * Math.SQRT2 * least), centroid };
}
