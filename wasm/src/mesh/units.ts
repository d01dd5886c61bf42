/** Units of length. */
export const LENGTH_UNITS = ["um", "mm", "cm", "m", "in", "ft"] as const;

/** Unit of length: micrometre, millimetre, centimetre, metre, inch (25.4 mm) or foot (304.8 mm). */
export type LengthUnit = (typeof LENGTH_UNITS)[number];
