import { lazy, Suspense, useState } from "react";
import { playerStrings } from "../../strings/player";
import { lessonStrings as texts } from "../../strings/lessons";
import { CompactPlayer } from "../player/compact-player";
import { usePlayer } from "../player/use-player";
import { ViewChecks, ViewChoices } from "../player/view-choices";
import { useLayout } from "../../../panels/shared/use-layout";
import styles from "./lessons.module.css";

const Lens = lazy(async () => ({ default: (await import("../player/lens")).Lens }));
const SupposedFront = lazy(async () => ({
  default: (await import("../player/supposed-front")).SupposedFront,
}));

/** The player and the lens in a lesson on a small screen, where only one panel is open at a time. */
export function LessonPlayer() {
  const layout = useLayout();
  const hasTrace = usePlayer((state) => state.trace !== null);
  if (layout === "wide" || !hasTrace) return null;
  return (
    <>
      <section
        className={styles["player"]}
        aria-label={playerStrings.transport}
        data-testid="lesson-player"
        data-unprinted
      >
        <CompactPlayer />
      </section>
      <LessonLens />
    </>
  );
}

function LessonLens() {
  const [isOpen, setIsOpen] = useState(false);
  return (
    <>
      {/* The open lens has the same sentences. */}
      {!isOpen && (
        <Suspense fallback={null}>
          <SupposedFront />
        </Suspense>
      )}
      <details
        className={styles["lens"]}
        data-testid="lesson-lens"
        data-unprinted
        onToggle={(event) => setIsOpen(event.currentTarget.open)}
      >
        <summary>{texts.lens}</summary>
        {isOpen && (
          <>
            <div className={styles["choices"]}>
              <ViewChoices />
              <ViewChecks />
            </div>
            <Suspense fallback={null}>
              <Lens />
            </Suspense>
          </>
        )}
      </details>
    </>
  );
}
