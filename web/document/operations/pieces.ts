import { over, valueOf } from "../../expressions/quantity";
import { operationStrings } from "../../strings";
import { box } from "../pieces/box";
import { cone } from "../pieces/cone";
import { cylinder } from "../pieces/cylinder";
import { prism } from "../pieces/prism";
import { sphere } from "../pieces/sphere";
import { torus } from "../pieces/torus";
import { wedge } from "../pieces/wedge";
import { wing } from "../pieces/wing";
import { worldFrame, zero } from "../vectors";
import { angleBetween, positiveLength, wholeNumber } from "./number-specs";
import type { FieldSpec } from "./operation";
import { pieceOperation } from "./piece";
import type { FeatureOperation } from "./solids";

const { fields: texts, pieces, refusals } = operationStrings;
const { x, y, z } = worldFrame;

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
  middle: ({ height }) => over(height, 2),
  handles: ({ height }) => [
    { key: "width", from: [0, 0, height / 2], along: x, share: 0.5 },
    { key: "depth", from: [0, 0, height / 2], along: y, share: 0.5 },
    { key: "height", from: zero, along: z },
  ],
  shape: ({ width, depth, height }) => box(width, depth, height),
  feature: {
    make: ({ width, depth, height }, place) => ({ type: "box", size: [width, depth, height], ...place }),
    read: (feature) => {
      if (feature.type !== "box") return null;
      const [width, depth, height] = feature.size;
      return { width, depth, height };
    },
  },
});

const createCylinder = pieceOperation({
  id: "create-cylinder",
  ...pieces.cylinder,
  sizes: (extent) => ({ radius: extent / 2, height: extent }),
  fields: [positiveLength("radius", texts.radius), positiveLength("height", texts.height)],
  middle: ({ height }) => over(height, 2),
  handles: ({ height }) => [
    { key: "radius", from: [0, 0, height / 2], along: x },
    { key: "height", from: zero, along: z },
  ],
  shape: ({ radius, height }) => cylinder(radius, radius, height),
  feature: {
    make: ({ radius, height }, place) => ({ type: "cylinder", radius, height, ...place }),
    read: (feature) =>
      feature.type === "cylinder" ? { radius: feature.radius, height: feature.height } : null,
  },
});

const createSphere = pieceOperation({
  id: "create-sphere",
  ...pieces.sphere,
  sizes: (extent) => ({ radius: extent / 2 }),
  fields: [positiveLength("radius", texts.radius)],
  middle: () => 0,
  handles: () => [{ key: "radius", from: zero, along: x }],
  shape: ({ radius }) => sphere(radius),
  feature: {
    make: ({ radius }, place) => ({ type: "sphere", radius, ...place }),
    read: (feature) => (feature.type === "sphere" ? { radius: feature.radius } : null),
  },
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
  middle: ({ height }) => over(height, 2),
  handles: ({ height }) => [
    { key: "radius", from: zero, along: x },
    { key: "topRadius", from: [0, 0, height], along: x },
    { key: "height", from: zero, along: z },
  ],
  shape: ({ radius, topRadius, height }) =>
    topRadius === 0 ? cone(radius, height) : cylinder(radius, topRadius, height),
  feature: {
    make: ({ radius, topRadius, height }, place) => ({ type: "cone", radius, topRadius, height, ...place }),
    read: (feature) => {
      if (feature.type !== "cone") return null;
      const { radius, topRadius, height } = feature;
      return { radius, topRadius, height };
    },
  },
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
  handles: ({ radius }) => [
    { key: "radius", from: zero, along: x },
    { key: "tubeRadius", from: [radius, 0, 0], along: z },
  ],
  shape: ({ radius, tubeRadius, angle }) => torus(radius, tubeRadius, angle),
  feature: {
    make: ({ radius, tubeRadius, angle }, place) => ({
      type: "torus",
      majorRadius: radius,
      minorRadius: tubeRadius,
      angle,
      ...place,
    }),
    read: (feature) => {
      if (feature.type !== "torus") return null;
      const { majorRadius, minorRadius, angle = 360 } = feature;
      return { radius: majorRadius, tubeRadius: minorRadius, angle };
    },
  },
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
  middle: ({ height }) => over(height, 2),
  handles: ({ height }) => [
    { key: "radius", from: [0, 0, height / 2], along: x },
    { key: "height", from: zero, along: z },
  ],
  shape: ({ sides, radius, height }) => prism(valueOf(sides), radius, height),
  feature: {
    make: ({ sides, radius, height }, place) => ({ type: "prism", sides, radius, height, ...place }),
    read: (feature) => {
      if (feature.type !== "prism") return null;
      const { sides, radius, height } = feature;
      return { sides, radius, height };
    },
  },
});

const createWedge = pieceOperation({
  id: "create-wedge",
  ...pieces.wedge,
  sizes: (extent) => ({ width: extent, depth: extent, height: extent, topLength: extent / 2 }),
  fields: [
    positiveLength("width", texts.width),
    positiveLength("depth", texts.depth),
    positiveLength("height", texts.height),
    positiveLength("topLength", texts.topLength),
  ],
  middle: ({ height }) => over(height, 2),
  handles: ({ width, height }) => [
    { key: "width", from: [0, 0, height / 2], along: x, share: 0.5 },
    { key: "depth", from: [0, 0, height / 2], along: y, share: 0.5 },
    { key: "height", from: zero, along: z },
    { key: "topLength", from: [-width / 2, 0, height], along: x },
  ],
  shape: ({ width, depth, height, topLength }) => wedge(width, depth, height, topLength),
  feature: {
    make: ({ width, depth, height, topLength }, place) => ({
      type: "wedge",
      size: [width, depth, height],
      topLength,
      ...place,
    }),
    read: (feature) => {
      if (feature.type !== "wedge") return null;
      const [width, depth, height] = feature.size;
      return { width, depth, height, topLength: feature.topLength };
    },
  },
});

const createWing = pieceOperation({
  id: "create-wing",
  ...pieces.wing,
  sizes: (extent) => ({ digits: 12, chord: extent, tipChord: extent, span: 2 * extent, sweep: 0, twist: 0 }),
  fields: [
    { ...wholeNumber("digits", texts.digits, 1, 9999), minDigits: 4 },
    positiveLength("chord", texts.chord),
    positiveLength("tipChord", texts.tipChord),
    positiveLength("span", texts.span),
    angleBetween("sweep", texts.sweep, -80, 80),
    angleBetween("twist", texts.twist, -45, 45),
  ],
  middle: ({ span }) => over(span, 2),
  refuse: ({ digits }) => (digits % 100 > 0 ? null : refusals.thickness),
  handles: ({ span, sweep }) => [
    { key: "chord", from: zero, along: x },
    { key: "tipChord", from: [span * Math.tan((sweep * Math.PI) / 180), 0, span], along: x },
    { key: "span", from: zero, along: z },
  ],
  shape: wing,
});

/** The operations that create solid pieces, in the order of the menu. */
export const pieceOperations: readonly FeatureOperation[] = [
  createBox,
  createCylinder,
  createSphere,
  createCone,
  createTorus,
  createPrism,
  createWedge,
  createWing,
];
