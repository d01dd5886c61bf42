import styles from "./unit.module.css";

/** The unit behind the number of a field. */
export function Unit({ children }: { readonly children: string }) {
  return <span className={styles["unit"]}>{children}</span>;
}
