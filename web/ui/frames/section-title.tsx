import type { ReactNode } from "react";
import styles from "./panel.module.css";

/** The title of a section of a panel. */
export function SectionTitle({ children }: { readonly children: ReactNode }) {
  return <h2 className={styles["title"]}>{children}</h2>;
}
