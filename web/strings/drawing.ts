/** Texts of the drawing tools. */
import { shortened } from "./shortened";

export const drawingStrings = {
  bar: "Drawing",
  lineType: "Type of line",
  circleBy: "Circle by",
  circleThroughPoints: "circle by 3 points",
  circleWays: { centre: "Centre", points: "3 points" },
  sourceType: "Type of source",
  sourceTypes: { point: "Point", segment: "Segment", triangle: "Triangle" },
  handles: "Handles",
  handleModes: { translate: "Move", rotate: "Rotate", scale: "Scale" },
  /** By how much a drag changes the selection. */
  amounts: {
    translate: (offset: string) => `Δ ${offset}`,
    rotate: (degrees: string) => `${degrees}°`,
    scale: (factors: string) => `× ${factors}`,
  },
  /** A handle: what it changes, with the present value. */
  grip: (name: string, value: string) => `${name} ${value}`,
  plane: "Work plane",
  planes: { xy: "XY", xz: "XZ", yz: "YZ" },
  /** In a list of values, if none of them is chosen. */
  none: "–",
  planeOfSelection: "Work plane from selection",
  noPlane: "Select one point, three points that are not on a line, or a planar patch.",
  snapping: "Snap to",
  snapTo: { grid: "Grid", model: "Points and lines", patches: "Patches" },
  snaps: {
    point: "point",
    node: "grid node",
    intersection: "intersection",
    middle: "middle",
    line: "on line",
    patch: "on patch",
    grid: "grid",
    plane: "work plane",
    typed: "typed",
    radius: "through",
  },
  hints: {
    point: "Click a place, or type coordinates: 1,2,0 or @0.5,0,0 or 5<30.",
    straight: "Click places for a chain of lines, or type coordinates. Enter ends the chain.",
    parabolic: "Click three places: start, middle, end.",
    arc: "Click three places: start, a place on the arc, end. Or click start and end, and type the radius.",
    circle:
      "Click the centre, then a place on the circle, or type the radius. The circle lies in the work plane.",
    circleThrough: "Click three places on the circle.",
    spline: "Click places, then Enter. The first place closes the spline.",
    hermite: "Click places, then Enter. The first place closes the line.",
    patch: "Click into a loop of lines, or click its lines and press Enter.",
    node: "Click places or nodes of the background grid. Four of them make a tetrahedron.",
    source: {
      point: "Click the place of the source.",
      segment: "Click both ends of the source. Enter after the first one makes a point source.",
      triangle: "Click the three corners of the source.",
    },
    move: "Drag a handle or the selection, or type a number; X, Y, Z choose an axis. Ctrl during a drag turns steps off, G changes the handles.",
    measure: "Click two places for a distance, a third one for an angle.",
  },
  noCircle: "The three places lie on one straight line.",
  /** A letter that may begin a name in coordinates, or be the hotkey of a command. */
  waiting: (letter: string, command: string) => `${letter}…  Enter: ${command}`,
  typeCoordinates: "Type coordinates",
  /** Ends what is being drawn. */
  finish: "Finish",
  coordinates: "Coordinates",
  coordinatesHint: "1,2,0   @0.5,0,0   5<30",
  coordinatesTitle: "Numbers may be expressions, such as sin(30)*2. Angles are in degrees.",
  /** The field for the amount of a motion. */
  motions: {
    translate: {
      coordinates: "Distance",
      coordinatesHint: "0.5   @0.5,0,0   5<30",
      coordinatesTitle:
        "0.5 is a distance, @0.5,0,0 and 5<30 are offsets, 1,2,0 is the new place. X, Y and Z choose an axis, Tab goes to the next number.",
    },
    rotate: {
      coordinates: "Angle",
      coordinatesHint: "30   X, Y, Z: axis",
      coordinatesTitle: "The angle in degrees. X, Y and Z choose an axis.",
    },
    scale: {
      coordinates: "Factor",
      coordinatesHint: "2   2,1,1   X, Y, Z: axis",
      coordinatesTitle: "One factor, or three of them along x, y and z. X, Y and Z choose an axis.",
    },
  },
  alongAxis: (name: string, axis: string) => `${name}, axis ${axis}`,
  mistakes: {
    syntax: "Type 1,2,0 or @0.5,0,0 or 5<30.",
    "no-last-place": "There is no place before this one.",
    "no-radius": "Type a radius above 0.",
    "no-motion": "Type 0.5 or @0.5,0,0 or 5<30.",
    "no-angle": "Type an angle in degrees.",
    "no-factor": "Type one or three factors above 0.",
    "short-radius": "Type a radius of at least half the distance between the two places.",
  },
  refusedLine: (line: string) =>
    `"${shortened(line, 80)}" is no position. The lines before it were used; this one and those after it were not.`,
  gridUnit: (step: string, unit: string | null) => (unit === null ? `grid ${step}` : `grid ${step} ${unit}`),
  measurement: "Measurement",
  distance: "distance",
  angle: "angle",
  copy: "Copy measurement",
  copied: "Copied",
} as const;
