import type { ReactNode } from "react";
import styles from "./field-row.module.css";

/** A row of a form: a label on the left and its fields on the right. */
export function FieldRow({ label, children }: { readonly label: string; readonly children: ReactNode }) {
  return (
    <div className={styles["row"]}>
      <span className={styles["label"]}>{label}</span>
      <div className={styles["fields"]}>{children}</div>
    </div>
  );
}
