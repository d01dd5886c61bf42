/** Changes to the rules of a recorded front. */
import * as v from "valibot";
import { objectWith } from "../calls/schemas.js";

/** Ways in which faces near a base face are found. */
export const FRONT_SEARCHES = ["grid", "linear"] as const;
/** `grid`: in the cells of a hash grid; `linear`: in addition, every face of the front is compared, which takes time only. */
export type FrontSearch = (typeof FRONT_SEARCHES)[number];

/** Changes to the rules of the front, to see what each rule is good for. By default, the rules are those of every run. */
export interface FrontExperiment {
  /** False leaves a face that cannot be completed to recovery at once, instead of relaxing the rules for it. Default true. */
  readonly relaxation?: boolean | undefined;
  /**
   * Factor, from 0 to 10, of the distance below which a new node is too close to a face. With 0, only exact crossings
   * count. Default 1.
   */
  readonly tolerance?: number | undefined;
  /** `linear` gives the same mesh in the time that a program without a search structure takes. Default `grid`. */
  readonly search?: FrontSearch | undefined;
}

/** Largest factor of the distance at which a node is too close. */
export const MAX_TOLERANCE = 10;

export const experimentSchema = objectWith({
  relaxation: v.optional(v.boolean()),
  tolerance: v.optional(v.pipe(v.number(), v.minValue(0), v.maxValue(MAX_TOLERANCE))),
  search: v.optional(v.picklist(FRONT_SEARCHES)),
});
