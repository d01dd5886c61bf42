import { lensSceneOf } from "../../player/lens-scene";
import { surfaceState } from "../../player/phases";
import { supposedCandidate } from "../../player/planar-lens";
import type { PlayerState } from "../../player/player";
import { playerStrings } from "../../strings/player";
import { frontChangeOf, planarSentenceOf, sentenceOf } from "./lens-sentence";
import { usePlayer } from "./use-player";

/** Says that the view shows the front as it would be with a refused candidate, where the lens is not beside the view. */
export function SupposedFront() {
  const text = usePlayer(supposedFrontText);
  return (
    <p role="status" data-testid="supposed-front" hidden={text === null}>
      {text}
    </p>
  );
}

/** Returns null if the view shows what the step has made. */
export function supposedFrontText(state: PlayerState): string | null {
  const { trace, lensStep, candidate } = state;
  if (!trace || candidate === null) return null;
  const surface = surfaceState(trace, lensStep);
  if (surface !== null) {
    const refused = supposedCandidate(trace.surface?.stepAt(surface), candidate);
    return refused && `${planarSentenceOf(refused)} ${playerStrings.patch.supposed(refused.isNew)}`;
  }
  const scene = lensSceneOf(state);
  if (!scene?.supposed || !scene.examined) return null;
  return `${sentenceOf(scene.step, scene.examined)} ${frontChangeOf(scene) ?? ""}`;
}
