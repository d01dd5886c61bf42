/** The colours of the theme that the viewer uses, as CSS strings, e.g. "#f59f00". */
export interface ViewerColors {
  /** Points and lines of the model. */
  readonly point: string;
  readonly line: string;
  readonly patch: string;
  readonly backgroundGrid: string;
  readonly source: string;
  readonly selection: string;
  readonly hover: string;
  /** The front, and defects. */
  readonly front: string;
  /** What a candidate of the front was refused for. */
  readonly failing: string;
  /** Element edges. */
  readonly meshEdge: string;
  /** The mesh with plain shading. */
  readonly meshPlain: string;
  /** Colour that an out-of-date mesh fades towards. */
  readonly faded: string;
  /** The wall of a volume that is still empty, near the eye and far from it: cool. */
  readonly emptyRim: string;
  readonly emptyHollow: string;
  /** Elements, and those made last: warm. */
  readonly filled: string;
  readonly fresh: string;
  readonly ground: string;
  /** Quality from bad to good, evenly spaced. */
  readonly ramp: readonly string[];
  /** Colours of regions by index; they repeat after the last. */
  readonly regions: readonly string[];
}
