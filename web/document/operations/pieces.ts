import { operationStrings } from "../../strings";
import { box } from "../pieces/box";
import { cone } from "../pieces/cone";
import { cylinder } from "../pieces/cylinder";
import { prism } from "../pieces/prism";
import { sphere } from "../pieces/sphere";
import { torus } from "../pieces/torus";
import { wing } from "../pieces/wing";
import { angleBetween, positiveLength, wholeNumber } from "./number-specs";
import type { FieldSpec, Operation } from "./operation";
import { pieceOperation } from "./piece";

const { fields: texts, pieces, refusals } = operationStrings;

/** A length of 0 or more. */
const length = (key: string, label: string): FieldSpec => ({
  kind: "number",
  key,
  label,
  unit: "length",
  refuse: (value) => (value >= 0 ? null : operationStrings.notNegative),
});

const createBox = pieceOperation({
  id: "create-box",
  ...pieces.box,
  sizes: (extent) => ({ width: extent, depth: extent, height: extent }),
  fields: [
    positiveLength("width", texts.width),
    positiveLength("depth", texts.depth),
    positiveLength("height", texts.height),
  ],
  middle: ({ height }) => height / 2,
  shape: ({ width, depth, height }) => box(width, depth, height),
});

const createCylinder = pieceOperation({
  id: "create-cylinder",
  ...pieces.cylinder,
  sizes: (extent) => ({ radius: extent / 2, height: extent }),
  fields: [positiveLength("radius", texts.radius), positiveLength("height", texts.height)],
  middle: ({ height }) => height / 2,
  shape: ({ radius, height }) => cylinder(radius, radius, height),
});

const createSphere = pieceOperation({
  id: "create-sphere",
  ...pieces.sphere,
  sizes: (extent) => ({ radius: extent / 2 }),
  fields: [positiveLength("radius", texts.radius)],
  middle: () => 0,
  shape: ({ radius }) => sphere(radius),
});

const createCone = pieceOperation({
  id: "create-cone",
  ...pieces.cone,
  sizes: (extent) => ({ radius: extent / 2, topRadius: 0, height: extent }),
  fields: [
    positiveLength("radius", texts.radius),
    length("topRadius", texts.topRadius),
    positiveLength("height", texts.height),
  ],
  middle: ({ height }) => height / 2,
  shape: ({ radius, topRadius, height }) =>
    topRadius === 0 ? cone(radius, height) : cylinder(radius, topRadius, height),
});

const createTorus = pieceOperation({
  id: "create-torus",
  ...pieces.torus,
  sizes: (extent) => ({ radius: extent, tubeRadius: extent / 4, angle: 360 }),
  fields: [
    positiveLength("radius", texts.ringRadius),
    positiveLength("tubeRadius", texts.tubeRadius),
    angleBetween("angle", texts.angle, 1, 360),
  ],
  middle: () => 0,
  refuse: ({ radius, tubeRadius }) => (tubeRadius < radius ? null : refusals.tubeRadius),
  shape: ({ radius, tubeRadius, angle }) => torus(radius, tubeRadius, angle),
});

const createPrism = pieceOperation({
  id: "create-prism",
  ...pieces.prism,
  sizes: (extent) => ({ sides: 6, radius: extent / 2, height: extent }),
  fields: [
    wholeNumber("sides", texts.sides, 3, 100),
    positiveLength("radius", texts.cornerRadius),
    positiveLength("height", texts.height),
  ],
  middle: ({ height }) => height / 2,
  shape: ({ sides, radius, height }) => prism(sides, radius, height),
});

const createWing = pieceOperation({
  id: "create-wing",
  ...pieces.wing,
  sizes: (extent) => ({ digits: 12, chord: extent, tipChord: extent, span: 2 * extent, sweep: 0, twist: 0 }),
  fields: [
    wholeNumber("digits", texts.digits, 1, 9999),
    positiveLength("chord", texts.chord),
    positiveLength("tipChord", texts.tipChord),
    positiveLength("span", texts.span),
    angleBetween("sweep", texts.sweep, -80, 80),
    angleBetween("twist", texts.twist, -45, 45),
  ],
  middle: ({ span }) => span / 2,
  refuse: ({ digits }) => (digits % 100 > 0 ? null : refusals.thickness),
  shape: wing,
});

/** The operations that create solid pieces, in the order of the menu. */
export const pieceOperations: readonly Operation[] = [
  createBox,
  createCylinder,
  createSphere,
  createCone,
  createTorus,
  createPrism,
  createWing,
];
