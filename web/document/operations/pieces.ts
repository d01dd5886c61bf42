import { operationStrings } from "../../strings";
import { box } from "../pieces/box";
import { prism } from "../pieces/prism";
import type { FieldSpec, Operation } from "./operation";
import { pieceOperation } from "./piece";

const { fields: texts, pieces } = operationStrings;

const aboveZero = (value: number): string | null => (value > 0 ? null : operationStrings.aboveZero);

const size = (key: string, label: string): FieldSpec => ({
  kind: "number",
  key,
  label,
  unit: "length",
  refuse: aboveZero,
});

const count = (key: string, label: string, min: number, max: number): FieldSpec => ({
  kind: "number",
  key,
  label,
  unit: null,
  whole: true,
  refuse: (value) =>
    Number.isInteger(value) && value >= min && value <= max ? null : operationStrings.wholeBetween(min, max),
});

const createBox = pieceOperation({
  id: "create-box",
  ...pieces.box,
  sizes: (extent) => ({ width: extent, depth: extent, height: extent }),
  fields: [size("width", texts.width), size("depth", texts.depth), size("height", texts.height)],
  middle: ({ height }) => height / 2,
  shape: ({ width, depth, height }) => box(width, depth, height),
});

const createPrism = pieceOperation({
  id: "create-prism",
  ...pieces.prism,
  sizes: (extent) => ({ sides: 6, radius: extent / 2, height: extent }),
  fields: [
    count("sides", texts.sides, 3, 100),
    size("radius", texts.cornerRadius),
    size("height", texts.height),
  ],
  middle: ({ height }) => height / 2,
  shape: ({ sides, radius, height }) => prism(sides, radius, height),
});

/** The operations that create solid pieces, in the order of the menu. */
export const pieceOperations: readonly Operation[] = [createBox, createPrism];
