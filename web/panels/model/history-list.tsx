import { Text } from "@mantine/core";
import { useEffect, useRef } from "react";
import { ScrollPanel } from "../../ui/frames/scroll-panel";
import { strings } from "../../strings";
import { useApp, useDocument } from "../shared/app-context";
import styles from "./history-list.module.css";

/** All steps that can be undone and redone. A click shows the model after a step. */
export function HistoryList() {
  const { documents } = useApp();
  const past = useDocument((state) => state.history.past);
  const future = useDocument((state) => state.history.future);
  const present = useRef<HTMLButtonElement>(null);
  useEffect(() => {
    // No return value: in new browsers, this call returns a promise.
    present.current?.scrollIntoView({ block: "nearest" });
  }, [past.length]);
  const steps = [strings.history.start, ...[...past, ...future].map(({ label }) => label)];
  return (
    <ScrollPanel label={strings.history.title} data-testid="history">
      <Text size="xs" c="dimmed">
        {strings.history.hint}
      </Text>
      <ol className={styles["steps"]} start={0}>
        {steps.map((label, index) => (
          <li key={index}>
            <button
              ref={index === past.length ? present : undefined}
              type="button"
              className={styles["step"]}
              aria-current={index === past.length ? "step" : undefined}
              data-undone={index > past.length || undefined}
              onClick={() => documents.jumpTo(index)}
            >
              {label}
            </button>
          </li>
        ))}
      </ol>
    </ScrollPanel>
  );
}
