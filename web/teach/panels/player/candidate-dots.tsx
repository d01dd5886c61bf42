import { useLayoutEffect, useRef } from "react";
import { isBeforeTest } from "../../player/beats";
import { lensSceneOf } from "../../player/lens-scene";
import { filmStrings } from "../../strings/film";
import { playerStrings as texts } from "../../strings/player";
import type { Viewer } from "../../../viewer/viewer";
import styles from "./film.module.css";
import { useFrontPlayer, usePlayer } from "./use-player";

/** No more candidates have dots, as in the drawing. */
const maxDots = 9;

/** The candidates of a step in the view, to be pointed at, focused and chosen: the list of the lens answers, and they answer it. */
export function CandidateDots({ viewer }: { readonly viewer: Viewer }) {
  const player = useFrontPlayer();
  const scene = usePlayer(lensSceneOf);
  const pointed = usePlayer((state) => state.pointed);
  const box = useRef<HTMLDivElement>(null);
  const isShown = scene !== null && scene.beat !== "base" && scene.beat !== "ideal";
  const candidates = isShown ? scene.step.candidates.slice(0, maxDots) : [];
  useLayoutEffect(() => {
    const follow = (): void => {
      [...(box.current?.children ?? [])].forEach((dot, i) => {
        const candidate = scene?.step.candidates[i];
        const at = candidate && viewer.toScreen(candidate.position);
        if (!(dot instanceof HTMLElement)) return;
        dot.hidden = !at;
        if (at) dot.style.transform = `translate(${at.x}px, ${at.y}px)`;
      });
    };
    follow();
    return viewer.onDrawn(follow);
  }, [viewer, scene]);
  if (!isShown) return null;
  const isEarly = isBeforeTest(scene.beat);
  const point = (rank: number | null): void => player.state.setState({ pointed: rank });
  return (
    <div ref={box} role="group" aria-label={filmStrings.candidates} className={styles["dots"]}>
      {candidates.map(({ node, isNew, verdict, culprit }, i) => (
        <button
          // Candidates have no identity beside their rank.
          key={i}
          type="button"
          className={styles["dot"]}
          data-pointed={pointed === i || undefined}
          aria-label={filmStrings.candidate(
            i + 1,
            texts.marks.node(isNew ? null : node),
            isEarly ? filmStrings.untested : texts.verdictAt(texts.verdicts[verdict], culprit),
          )}
          onPointerEnter={() => point(i)}
          onPointerLeave={() => point(null)}
          onFocus={() => point(i)}
          onBlur={() => point(null)}
          onClick={() => player.choose(i)}
        />
      ))}
    </div>
  );
}
