import { lazy, Suspense } from "react";
import type { App } from "../../app/app";
import { queryOf, type SharedFront } from "../player/shared-front";
import { shareStrings as texts } from "../strings/share";
import { playerStrings } from "../strings/player";
import { Notices } from "../../panels/dialogs/notices";
import { frontCommands } from "../commands/front-commands";
import { CompactPlayer } from "../panels/player/compact-player";
import { usePlayer } from "../panels/player/use-player";
import { AppContext } from "../../panels/shared/app-context";
import { useHotkeys } from "../../panels/page/hotkeys";
import { FrontView } from "./front-view";
import styles from "./embed.module.css";

const SupposedFront = lazy(async () => ({
  default: (await import("../panels/player/supposed-front")).SupposedFront,
}));

export interface EmbedPageProps {
  readonly app: App;
  readonly shared: SharedFront;
}

/** The view of a front with a small player below it. */
export function EmbedPage({ app, shared }: EmbedPageProps) {
  useHotkeys(app, frontCommands);
  return (
    <AppContext value={app}>
      <div className={styles["page"]} data-testid="embed">
        <FrontView />
        <footer className={styles["bar"]}>
          <Controls />
          <a href={`./?${queryOf(shared).toString()}`} target="_blank" rel="noreferrer">
            {texts.openInApp}
          </a>
        </footer>
        <Notices />
      </div>
    </AppContext>
  );
}

function Controls() {
  const hasTrace = usePlayer((state) => state.trace !== null);
  const failure = usePlayer((state) => state.failure);
  if (failure) return <p role="alert">{failure.join(" ")}</p>;
  return hasTrace ? (
    <section className={styles["player"]} aria-label={playerStrings.transport}>
      <Suspense fallback={null}>
        <SupposedFront />
      </Suspense>
      <CompactPlayer />
    </section>
  ) : (
    <p role="status">{texts.loading}</p>
  );
}
