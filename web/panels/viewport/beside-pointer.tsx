import type { ReactNode } from "react";
import type { ScreenPoint } from "../../viewer/screen";
import styles from "./beside-pointer.module.css";

/** Distance of a label from the pointer, in CSS pixels. */
const offset = 14;

/** A label at the lower right of the pointer, shifted so far that all of it lies within the view. */
export function BesidePointer({ at, children }: { readonly at: ScreenPoint; readonly children: ReactNode }) {
  return (
    <div className={styles["row"]} style={{ top: `min(${at.y + offset}px, 100% - 28px)` }}>
      <span className={styles["room"]} style={{ flexBasis: at.x + offset }} />
      {children}
    </div>
  );
}
