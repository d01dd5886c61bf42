// Functions in the unit cube that NASA's refine verifies its metrics with (Park et al. 2019), and the error of their linear
// interpolation.

function sinfun3([x, y, z]) {
  const product = (x - 0.4) * (y - 0.4) * (z - 0.4);
  const isMiddle = product > -Math.PI / 50 && product <= (2 * Math.PI) / 50;
  return (isMiddle ? 1 : 0.1) * Math.sin(50 * product);
}

const sinatan3 = ([x, y, z]) => 0.1 * Math.sin(50 * x * z) + Math.atan2(0.1, Math.sin(5 * y) - 2 * x * z);

const tanh3 = ([x, y, z]) => Math.tanh((x + 1.3) ** 20 * (y - 0.3) ** 9 * z);

/** Boundary layers at three faces. */
function bl3([x, y, z]) {
  const layer = (t) => (1 - Math.exp((t - 1) / 0.01)) / (1 - Math.exp(-1 / 0.01));
  return 1 - layer(x) * layer(y) * layer(z);
}

export const FUNCTIONS = { sinfun3, sinatan3, tanh3, bl3 };

/** Points of the rule of Gauss along each axis of a cube, which is mapped to the element. */
const DIVISIONS = 4;

/** Returns the points of the quadrature in barycentric coordinates, with weights of the sum 1. */
function quadrature() {
  const [nodes, weights] = [[0.06943184420297371, 0.33000947820757187, 0.6699905217924281, 0.9305681557970262], [0.17392742256872692, 0.3260725774312731, 0.3260725774312731, 0.17392742256872692]]; // prettier-ignore
  const points = [];
  for (let i = 0; i < DIVISIONS; ++i) {
    for (let j = 0; j < DIVISIONS; ++j) {
      for (let k = 0; k < DIVISIONS; ++k) {
        const [a, b, c] = [nodes[i], nodes[j], nodes[k]];
        const at = [a, b * (1 - a), c * (1 - a) * (1 - b)];
        const weight = 6 * weights[i] * weights[j] * weights[k] * (1 - a) ** 2 * (1 - b);
        points.push({ at: [1 - at[0] - at[1] - at[2], ...at], weight });
      }
    }
  }
  return points;
}

/** Returns the L2 norm of the error of linear interpolation at the nodes. */
export const interpolationError = (mesh, valueAt) => fieldError(mesh, valuesAt(mesh, valueAt), valueAt);

/** Returns the values of a function at the nodes. */
export const valuesAt = ({ points }, valueAt) =>
  Float64Array.from({ length: points.length / 3 }, (_, node) =>
    valueAt(points.subarray(3 * node, 3 * node + 3)),
  );

/** Returns the L2 norm of the difference of a function and the linear elements with values at the nodes. */
export function fieldError({ points, tetrahedra }, nodeValues, valueAt) {
  const rule = quadrature();
  let sum = 0;
  for (let t = 0; t < tetrahedra.length; t += 4) {
    const corners = [...tetrahedra.subarray(t, t + 4)].map((node) => [
      ...points.subarray(3 * node, 3 * node + 3),
    ]);
    const values = [...tetrahedra.subarray(t, t + 4)].map((node) => nodeValues[node]);
    const [u, v, w] = corners.slice(1).map((corner) => corner.map((x, k) => x - corners[0][k]));
    const volume =
      ((u[1] * v[2] - u[2] * v[1]) * w[0] +
        (u[2] * v[0] - u[0] * v[2]) * w[1] +
        (u[0] * v[1] - u[1] * v[0]) * w[2]) /
      6;
    let local = 0;
    for (const { at, weight } of rule) {
      const position = [0, 1, 2].map((k) =>
        at.reduce((total, l, corner) => total + l * corners[corner][k], 0),
      );
      const interpolated = at.reduce((total, l, corner) => total + l * values[corner], 0);
      local += weight * (valueAt(position) - interpolated) ** 2;
    }
    sum += volume * local;
  }
  return Math.sqrt(sum);
}
