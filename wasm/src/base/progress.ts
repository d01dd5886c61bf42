/** Progress of a call. */

/** The stages of a run in their order. */
export type Phase = "check" | "sides" | "surface" | "volume" | "optimize" | "verify";

/** Where a run stands, or any other call; in all but runs the phase is `check`, and there are no counts. */
export interface Progress {
  readonly phase: Phase;
  /** Of the whole call, 0 to 1, estimated, never decreasing. */
  readonly fraction: number;
  readonly nodes: number;
  readonly triangles: number;
  readonly tetrahedra: number;
  readonly frontFaces: number;
  /** As many as the sizes ask for, estimated before the front starts; 0 until then. */
  readonly expectedTetrahedra: number;
  /** How far the exact fill is with what the front has left open, 0 to 1, estimated; 0 while it is not at work. */
  readonly exactFillFraction: number;
  readonly elapsedSeconds: number;
}
