import { Text } from "@mantine/core";
import type { ReactNode } from "react";
import styles from "./field-row.module.css";

export interface FieldRowProps {
  readonly label: string;
  /** A sentence below the row, for example why a choice is disabled. */
  readonly hint?: string | null;
  readonly children: ReactNode;
}

/** A row of a form: a label on the left and its fields on the right. */
export function FieldRow({ label, hint = null, children }: FieldRowProps) {
  return (
    <>
      <div className={styles["row"]}>
        <span className={styles["label"]}>{label}</span>
        <div className={styles["fields"]}>{children}</div>
      </div>
      {hint !== null && (
        <Text size="xs" c="dimmed">
          {hint}
        </Text>
      )}
    </>
  );
}
