/** Dihedral angle in degrees below which an element is drawn after a sweep of the optimizer. */
export const poorAngle = 30;
