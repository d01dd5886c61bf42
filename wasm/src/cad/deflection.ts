/** How finely faces are triangulated. */
import type { Deflection } from "./protocol.js";

/**
 * The distance is at most 1/5000 of the diagonal of each part, far below the remesher's tolerance of 1/250; the mean
 * side of a box is at most its diagonal / √3. With this angle, a circle has 63 edges and loses 0.17 % of its area.
 */
export const PER_DIAGONAL = 5000;
export const DEFLECTION: Deflection = { distance: Math.sqrt(3) / PER_DIAGONAL, isRelative: true, angle: 0.1 };
