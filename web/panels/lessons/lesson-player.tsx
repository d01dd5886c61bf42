import { strings } from "../../strings";
import { CompactPlayer } from "../player/compact-player";
import { usePlayer } from "../player/use-player";
import { useLayout } from "../shared/use-layout";
import styles from "./lessons.module.css";

/** The player in a lesson, where the panels are drawers of which only one is open. */
export function LessonPlayer() {
  const layout = useLayout();
  const hasTrace = usePlayer((state) => state.trace !== null);
  if (layout === "wide" || !hasTrace) return null;
  return (
    <section
      className={styles["player"]}
      aria-label={strings.player.transport}
      data-testid="lesson-player"
      data-unprinted
    >
      <CompactPlayer />
    </section>
  );
}
