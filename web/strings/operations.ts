/** Texts of the operations that add or change many entities by a few values. */
export const operationStrings = {
  create: "Create",
  cancel: "Cancel",
  apply: "Apply",
  aboveZero: "Must be above 0.",
  wholeBetween: (min: number, max: number) => `A whole number from ${min} to ${max}.`,
  noDirection: "A direction must not be zero.",
  preview: (count: number) => `Preview: ${count === 1 ? "1 patch" : `${count} patches`}`,
  fields: {
    width: "Width (x)",
    depth: "Depth (y)",
    height: "Height",
    radius: "Radius",
    cornerRadius: "Radius of corners",
    sides: "Sides",
    anchor: "Position of",
    anchors: { base: "Base", centre: "Centre" },
    base: "Centre of base",
    centre: "Centre",
    axis: "Axis",
    join: "Join to what it touches",
  },
  directions: { x: "X", y: "Y", z: "Z", other: "Other" },
  pieces: {
    box: { noun: "box", title: "Box" },
    prism: { noun: "prism", title: "Prism" },
  },
} as const;
