/** Units of length. */
export const UNITS = ["um", "mm", "cm", "m", "in", "ft"] as const;

/** Unit of length: micrometre, millimetre, centimetre, metre, inch (25.4 mm) or foot (304.8 mm). */
export type Unit = (typeof UNITS)[number];
