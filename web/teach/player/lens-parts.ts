/** What the layers of the player are made of: facets, segments and dots in a colour of the theme. */
import { BufferAttribute, BufferGeometry, LineBasicMaterial, LineSegments, Mesh, Points } from "three";
import type { Position } from "../../document/position";
import { subtract } from "../../document/vectors";
import type { ViewerColors } from "../../viewer/colors";
import { setStateColors, setStateScale, stateCodes } from "../../viewer/draw-state";
import { createDotMaterial } from "../../viewer/materials/dot-material";
import { createFacetMaterial } from "../../viewer/materials/facet-material";
import { createLineMaterial, fitLines } from "../../viewer/materials/line-material";
import type { Viewport } from "../../viewer/scene-state";
import { setColor, setNumber } from "../../viewer/materials/uniforms";
import { SegmentGeometry, segmentsInState } from "../../viewer/segment-geometry";

type ColorName = "selection" | "front" | "failing" | "source" | "point" | "line" | "hover";

/** Positions drawn in one colour. */
export abstract class Part<Drawn extends Mesh | LineSegments | Points> {
  protected constructor(
    readonly object: Drawn,
    protected readonly color: ColorName,
  ) {}

  abstract setColors(colors: ViewerColors): void;

  set(positions: readonly Position[], origin: Position): void {
    const local = Float32Array.from(positions.flatMap((position) => subtract(position, origin)));
    this.object.geometry.dispose();
    this.object.geometry = new BufferGeometry().setAttribute("position", new BufferAttribute(local, 3));
    this.object.visible = positions.length > 0;
  }

  dispose(): void {
    this.object.geometry.dispose();
  }
}

export class Facets extends Part<Mesh> {
  readonly #material;

  constructor(color: ColorName, opacity: number) {
    const material = createFacetMaterial({ opacity, depthTest: false });
    super(new Mesh(new BufferGeometry(), material), color);
    this.#material = material;
  }

  setColors(colors: ViewerColors): void {
    setColor(this.#material, "color", colors[this.color]);
  }

  override dispose(): void {
    super.dispose();
    this.#material.dispose();
  }
}

export class Segments extends Part<LineSegments> {
  readonly #material;

  constructor(color: ColorName) {
    const material = new LineBasicMaterial({ transparent: true, depthTest: false });
    super(new LineSegments(new BufferGeometry(), material), color);
    this.#material = material;
  }

  setColors(colors: ViewerColors): void {
    this.#material.color.set(colors[this.color]);
  }

  override dispose(): void {
    super.dispose();
    this.#material.dispose();
  }
}

/** Round dots with a rim, which show through everything. */
export class Dots extends Part<Points> {
  readonly #material;

  /** `size`: diameter in pixels. */
  constructor(color: ColorName, size: number) {
    const material = createDotMaterial("round");
    material.depthTest = false;
    setStateScale(material, "selected", size);
    super(new Points(new BufferGeometry(), material), color);
    this.#material = material;
  }

  override set(positions: readonly Position[], origin: Position): void {
    super.set(positions, origin);
    const states = new Uint8Array(positions.length).fill(stateCodes.selected);
    this.object.geometry.setAttribute("state", new BufferAttribute(states, 1));
  }

  setColors(colors: ViewerColors): void {
    setStateColors(this.#material, { selected: colors[this.color] });
    setColor(this.#material, "rim", colors.faded);
  }

  setViewport({ pixelRatio }: Viewport): void {
    setNumber(this.#material, "pixelRatio", pixelRatio);
  }

  override dispose(): void {
    super.dispose();
    this.#material.dispose();
  }
}

/** Segments some pixels wide. */
export class WideSegments {
  readonly #material;
  readonly object: Mesh;

  /** `width`: in pixels; `dash`: length of a dash and the gap after it, 0 for solid segments. */
  constructor(
    readonly color: ColorName,
    width: number,
    depthTest: boolean,
    dash = 0,
  ) {
    this.#material = createLineMaterial({ widths: { selected: width }, depthTest, dash });
    // What shows through everything is drawn after it, also after what is transparent.
    this.#material.transparent = !depthTest;
    this.object = new Mesh(new SegmentGeometry(0), this.#material);
    this.object.frustumCulled = false;
  }

  setColors(colors: ViewerColors): void {
    setStateColors(this.#material, { selected: colors[this.color] });
  }

  setViewport(viewport: Viewport): void {
    fitLines(this.#material, viewport);
  }

  /** Shows segments: their ends, two after two. */
  set(ends: readonly Position[], origin: Position): void {
    const local = Float32Array.from(ends.flatMap((position) => subtract(position, origin)));
    this.object.geometry.dispose();
    this.object.geometry = segmentsInState(local, stateCodes.selected);
    this.object.visible = ends.length > 0;
  }

  dispose(): void {
    this.object.geometry.dispose();
    this.#material.dispose();
  }
}
