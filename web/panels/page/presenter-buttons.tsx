import { Button } from "@mantine/core";
import { strings } from "../../strings";
import { useApp, useShell } from "../shared/app-context";
import styles from "./status-bar.module.css";

const texts = strings.presenter;

/** What presenter mode offers, where it covers nothing of the view. */
export function PresenterButtons() {
  const { shell } = useApp();
  const isPresenting = useShell((state) => state.isPresenting);
  const hasLaser = useShell((state) => state.hasLaser);
  return (
    isPresenting && (
      <section
        className={styles["presenter"]}
        aria-label={texts.title}
        data-testid="presenter"
        data-covers-labels
      >
        <Button
          size="compact-xs"
          className={styles["laserButton"]}
          variant={hasLaser ? "filled" : "default"}
          aria-pressed={hasLaser}
          data-testid="presenter-laser"
          onClick={() => shell.setState({ hasLaser: !hasLaser })}
        >
          {texts.laser}
        </Button>
        <Button
          size="compact-xs"
          variant="default"
          data-testid="presenter-end"
          onClick={() => shell.setState({ isPresenting: false })}
        >
          {texts.end}
        </Button>
      </section>
    )
  );
}
