import { useMemo } from "react";
import { ScaleLegend } from "../../../panels/viewport/scale-legend";
import { frontValues } from "../../player/front-values";
import { poorAngle } from "../../player/poor-angle";
import { playerStrings } from "../../strings/player";
import { usePlayer } from "./use-player";
import { showsData } from "../../player/film-state";

/** The colour scale of the faces of a recorded front; lines and patches have none. */
export function FrontLegend() {
  const trace = usePlayer((state) => state.trace);
  const coloring = usePlayer((state) => state.coloring);
  const isSwept = usePlayer(({ sweep }) => sweep !== null);
  const isVolume = usePlayer(({ step }) => step >= 0);
  const hasData = usePlayer(showsData);
  const [low, high] = useMemo(() => {
    if (isSwept) return ["0°", `${poorAngle}°`];
    const [from, to] = trace ? frontValues(trace, coloring).rangeAt(0) : [0, 0];
    return playerStrings.legendEnds(coloring, from, to);
  }, [trace, coloring, isSwept]);
  const name = isSwept ? playerStrings.sweptLegend : playerStrings.legend[coloring];
  return isVolume && hasData && <ScaleLegend name={name} testId="front-legend" ticks={[high, low]} />;
}
