/** The order in which a repair gives regions what they share: the engine gives a volume to the lowest region that has it. */
import { type Steps } from "../base/steps.js";
import { enclosedVolumes } from "../formats/sixfold-volume.js";
import { NO_REGION } from "../generated/constants.js";
import type { SharedVolume } from "../mesh/inspection.js";
import type { SurfaceInput } from "../mesh/mesh.js";
import { SMALLEST_OVERLAP } from "./touching-solids.js";

/** Two inverse permutations of the regions. */
export interface RegionOrder {
  /** Per region: its place in the order. */
  readonly placeOf: Uint32Array;
  /** Per place: its region. */
  readonly regionAt: Uint32Array;
}

/**
 * Returns an order in which regions that lie wholly inside others come before them, the smallest first; undefined if no such region
 * lost its volume. `sides`: the regions beside the triangles; `shared`: what a repair in the given order gave to the lower ones. O(n).
 */
export function* innerFirst(
  surface: SurfaceInput,
  sides: Uint32Array,
  shared: readonly SharedVolume[],
): Steps<RegionOrder | undefined> {
  if (shared.length === 0) return undefined;
  const count = sides.reduce((most, region) => (region === NO_REGION ? most : Math.max(most, region + 1)), 0);
  const [behind, before] = [0, 1].map((side) => (t: number) => regionOrNone(sides[2 * t + side]));
  const volumes = yield* enclosedVolumes(surface, count, behind ?? (() => undefined));
  const taken = yield* enclosedVolumes(surface, count, before ?? (() => undefined));
  const volumeOf = (region: number) => (volumes[region] ?? 0) - (taken[region] ?? 0);
  const most = 1 - SMALLEST_OVERLAP;
  const inner = shared
    .filter(({ regions: [outer, lost], volume }) => {
      return volume >= most * volumeOf(lost) && volumeOf(lost) < most * volumeOf(outer);
    })
    .map(({ regions: [, lost] }) => lost);
  if (inner.length === 0) return undefined;
  const first = [...new Set(inner)].sort((a, b) => volumeOf(a) - volumeOf(b) || a - b);
  const others = [...Array(count).keys()].filter((region) => !first.includes(region));
  const regionAt = Uint32Array.from([...first, ...others]);
  const placeOf = new Uint32Array(count);
  regionAt.forEach((region, place) => (placeOf[region] = place));
  return { placeOf, regionAt };
}

const regionOrNone = (region: number | undefined) => (region === NO_REGION ? undefined : region);

/** Returns regions beside triangles with other numbers. */
export const renumbered = (sides: Uint32Array, numberOf: Uint32Array): Uint32Array =>
  sides.map((region) => numberOf[region] ?? NO_REGION);
