/** Why candidates are refused: the lists of the package, without its code that reads traces, which is loaded with the first front. */
import type { EDGE_REFUSALS, REFUSALS } from "tetrafront/trace";

export const refusals: typeof REFUSALS = ["behind", "crosses", "too-close"];
export const edgeRefusals: typeof EDGE_REFUSALS = ["behind", "crosses", "too-close", "same-node", "outside"];
