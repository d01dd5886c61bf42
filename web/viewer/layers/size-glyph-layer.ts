import { BufferAttribute, BufferGeometry, Group, LineBasicMaterial, LineSegments, Points } from "three";
import type { Position } from "../../document/position";
import { addScaled, cross, frameAlong, orthogonalTo, unit, type Frame } from "../../document/vectors";
import { setStateColors, stateCodes } from "../draw-state";
import { createDotMaterial } from "../materials/dot-material";
import { setColor, setNumber } from "../materials/uniforms";
import type { SceneChanges } from "../scene-state";
import type { Layer } from "./layer";

/** An ellipsoid: one of revolution, unless it has a second axis. */
export interface Glyph {
  readonly centre: Position;
  readonly axis: Position;
  /** Radii across the axis and along it. */
  readonly across: number;
  readonly along: number;
  /** A direction orthogonal to the axis, and the radius along it. */
  readonly second?: { readonly axis: Position; readonly along: number } | undefined;
}

/** What is drawn: glyphs, lines to the handles, and the handles. */
export interface GlyphSketch {
  readonly glyphs: readonly Glyph[];
  readonly handles: readonly Position[];
  /** Ends of lines, in pairs. */
  readonly stems: readonly Position[];
  /** The handle under the pointer; null for none. */
  readonly hovered: number | null;
}

const circlePieces = 48;
/** Angles of the meridians, as shares of a full turn. */
const meridians = [0, 0.125, 0.25, 0.375];
/** Heights of the circles across the axis, as shares of half of it. */
const parallels = [-0.6, 0, 0.6];

/** The sizes of selected nodes and sources as ellipsoids in true size, with handles. */
export class SizeGlyphLayer implements Layer {
  readonly root = new Group();
  readonly #lineMaterial = new LineBasicMaterial({ transparent: true, opacity: 0.75, depthTest: false });
  readonly #dotMaterial = createDotMaterial("round");
  readonly #lines = new LineSegments(new BufferGeometry(), this.#lineMaterial);
  readonly #dots = new Points(new BufferGeometry(), this.#dotMaterial);
  #sketch: GlyphSketch | null = null;
  #origin: Position = [0, 0, 0];

  constructor() {
    for (const [order, drawn] of [this.#lines, this.#dots].entries()) {
      drawn.frustumCulled = false;
      drawn.renderOrder = 8 + order;
      this.root.add(drawn);
    }
  }

  /** Shows a sketch, or hides everything. */
  show(sketch: GlyphSketch | null): void {
    this.#sketch = sketch;
    this.#write();
  }

  update(changes: SceneChanges): void {
    const { colors, viewport, origin } = changes.state;
    if (changes.has("colors")) {
      this.#lineMaterial.color.set(colors.selection);
      setStateColors(this.#dotMaterial, { normal: colors.selection, hover: colors.hover });
      setColor(this.#dotMaterial, "rim", colors.faded);
    }
    if (changes.has("viewport")) setNumber(this.#dotMaterial, "pixelRatio", viewport.pixelRatio);
    if (!changes.has("origin")) return;
    this.#origin = origin;
    this.#write();
  }

  dispose(): void {
    for (const { geometry, material } of [this.#lines, this.#dots]) {
      geometry.dispose();
      material.dispose();
    }
  }

  #write(): void {
    const { glyphs, stems, handles, hovered } = this.#sketch ?? nothing;
    this.root.visible = this.#sketch !== null;
    const ends = [...glyphs.flatMap(glyphEnds), ...stems];
    this.#lines.geometry.dispose();
    this.#lines.geometry = new BufferGeometry().setAttribute("position", this.#local(ends));
    const states = Uint8Array.from(handles, (_, i) => stateCodes[i === hovered ? "hover" : "normal"]);
    this.#dots.geometry.dispose();
    this.#dots.geometry = new BufferGeometry()
      .setAttribute("position", this.#local(handles))
      .setAttribute("state", new BufferAttribute(states, 1));
  }

  #local(positions: readonly Position[]): BufferAttribute {
    const [x, y, z] = this.#origin;
    const local = Float32Array.from(positions.flatMap((p) => [p[0] - x, p[1] - y, p[2] - z]));
    return new BufferAttribute(local, 3);
  }
}

const nothing: GlyphSketch = { glyphs: [], handles: [], stems: [], hovered: null };

/** Returns the ends of the segments of an ellipsoid: meridians and circles across the axis. */
export function glyphEnds({ centre, axis, across, along, second }: Glyph): Position[] {
  const frame = second ? frameOf(centre, axis, second.axis) : frameAlong(axis, centre);
  const aside = second?.along ?? across;
  const rings = meridians.map((share) => {
    const [cosine, sine] = circleAt(share);
    return ring((c, s) => at(frame, aside * s * cosine, across * s * sine, along * c));
  });
  const circles = parallels.map((height) => {
    const share = Math.sqrt(1 - height * height);
    return ring((c, s) => at(frame, aside * share * c, across * share * s, along * height));
  });
  return [...rings, ...circles].flat();
}

/** Returns the frame of an ellipsoid whose x is the second axis. */
function frameOf(origin: Position, axis: Position, second: Position): Frame {
  const { z, x: any } = frameAlong(axis);
  const x = unit(orthogonalTo(z, second)) ?? any;
  return { origin, x, y: cross(z, x), z };
}

const circleAt = (share: number): readonly [cosine: number, sine: number] => [
  Math.cos(2 * Math.PI * share),
  Math.sin(2 * Math.PI * share),
];

function ring(positionAt: (cosine: number, sine: number) => Position): Position[] {
  return Array.from({ length: circlePieces }, (_, piece) => [
    positionAt(...circleAt(piece / circlePieces)),
    positionAt(...circleAt((piece + 1) / circlePieces)),
  ]).flat();
}

function at({ origin, x, y, z }: Frame, a: number, b: number, c: number): Position {
  return addScaled(addScaled(addScaled(origin, x, a), y, b), z, c);
}
