import { Button, CloseButton, Text } from "@mantine/core";
import { useEffect, useState } from "react";
import { hideNotice, type Notice } from "../../session/shell";
import { strings } from "../../strings";
import { useApp, useShell } from "../shared/app-context";
import styles from "./notices.module.css";

/** Time in milliseconds after which information disappears, unless it has the pointer or the focus. Warnings stay. */
const visibleMs = 15_000;

/** Messages that do not interrupt the work, the latest at the bottom. */
export function Notices() {
  const notices = useShell((state) => state.notices);
  return (
    <section
      className={styles["notices"]}
      aria-label={strings.notices.label}
      aria-live="polite"
      data-presented
    >
      {notices.map((notice) => (
        <NoticeCard key={`${notice.key} ${notice.text}`} notice={notice} />
      ))}
    </section>
  );
}

function NoticeCard({ notice }: { readonly notice: Notice }) {
  const { shell } = useApp();
  const [held, setHeld] = useState(false);
  const { key, tone, text, action } = notice;
  useEffect(() => {
    if (held || tone === "warning") return undefined;
    const timer = setTimeout(() => hideNotice(shell, key), visibleMs);
    return () => clearTimeout(timer);
  }, [shell, key, tone, held]);
  return (
    <div
      className={styles["notice"]}
      data-tone={tone}
      data-testid={`notice-${key}`}
      onPointerEnter={() => setHeld(true)}
      onPointerLeave={() => setHeld(false)}
      onFocus={() => setHeld(true)}
      onBlur={() => setHeld(false)}
    >
      <Text size="sm">{text}</Text>
      <Button
        size="compact-sm"
        variant="default"
        onClick={() => {
          hideNotice(shell, key);
          action.run();
        }}
      >
        {action.label}
      </Button>
      <CloseButton size="sm" aria-label={strings.notices.dismiss} onClick={() => hideNotice(shell, key)} />
    </div>
  );
}
