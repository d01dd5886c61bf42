/** Names of length units, and where they are chosen. */
export const unitStrings = {
  um: "µm",
  mm: "mm",
  cm: "cm",
  m: "m",
  in: "inch",
  ft: "foot",
  unknown: "not stated",
  /** In the status bar, which opens the choice. */
  stated: (unit: string | null) => (unit === null ? "no length unit" : `lengths in ${unit}`),
  choose: "Choose the length unit",
  other: "other scale",
  ofProject: "Length unit",
  ofFile: "File unit",
  changeTitle: "Change the length unit",
  question: (from: string, to: string, factor: string) =>
    `Convert the numbers, so that the model stays as large as it is: 1 ${from} becomes ${factor} ${to}. Or keep the numbers and change their unit only: the model then has another size.`,
  convert: "Convert the numbers",
  relabel: "Keep the numbers",
  cancel: "Cancel",
} as const;
