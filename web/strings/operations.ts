import { entityNouns, pluralNouns } from "./entities";

const countOf = (count: number, kind: keyof typeof entityNouns): string =>
  `${count} ${count === 1 ? entityNouns[kind] : pluralNouns[kind]}`;

/** Texts of the operations that add or change many entities by a few values. */
export const operationStrings = {
  create: "Create",
  cancel: "Cancel",
  apply: "Apply",
  aboveZero: "Must be above 0.",
  wholeBetween: (min: number, max: number) => `A whole number from ${min} to ${max}.`,
  noDirection: "A direction must not be zero.",
  opens: (title: string) => `${title}…`,
  /** What an operation gives: "6 patches". */
  result: (entities: readonly { readonly kind: keyof typeof entityNouns }[]) =>
    [...new Set(entities.map(({ kind }) => kind))]
      .map((kind) => countOf(entities.filter((entity) => entity.kind === kind).length, kind))
      .join(", "),
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
