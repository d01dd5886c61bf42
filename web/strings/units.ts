/** Names of length units, and where they are chosen. */
export const unitStrings = {
  um: "µm",
  mm: "mm",
  cm: "cm",
  m: "m",
  in: "inch",
  ft: "foot",
  unknown: "not stated",
  other: "other scale",
  ofProject: "Length unit",
  ofFile: "File unit",
} as const;
