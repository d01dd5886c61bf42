/** What the viewer needs to know of the theme. Colours are CSS strings, e.g. "#f59f00". */
export interface ViewerColors {
  /** Points and lines of the model. */
  readonly point: string;
  readonly line: string;
  readonly patch: string;
  readonly backgroundGrid: string;
  readonly source: string;
  readonly selection: string;
  readonly hover: string;
  /** Remaining front of an incomplete mesh. */
  readonly front: string;
  /** Element edges, and the mesh where it is not shaded by quality. */
  readonly meshEdge: string;
  readonly meshPlain: string;
  /** What an out-of-date mesh fades towards. */
  readonly faded: string;
  readonly ground: string;
  readonly cubeFace: string;
  /** Edges and corners of the view cube. */
  readonly cubeTrim: string;
  readonly cubeText: string;
  readonly cubeHover: string;
  /** Quality from bad to good, evenly spaced. */
  readonly ramp: readonly string[];
  /** Of regions, by their numbers; they begin again after the last. */
  readonly regions: readonly string[];
}
