import { Drawer, VisuallyHidden } from "@mantine/core";
import type { ReactNode } from "react";
import styles from "./framed.module.css";
import { strings } from "../../strings";

export interface FramedDrawerProps {
  readonly title: string;
  readonly opened: boolean;
  readonly position: "left" | "right" | "bottom";
  readonly size: number | string;
  /** False if the view beside the drawer stays visible. */
  readonly dimmed: boolean;
  readonly onClose: () => void;
  readonly children: ReactNode;
}

/** Above the page, below notices and dialogs: a notice would lie unseen below a drawer. */
const zIndex = 120;

/** A panel with tabs at the edge of the page. The tabs name it, so only screen readers get the title. */
export function FramedDrawer({
  title,
  opened,
  position,
  size,
  dimmed,
  onClose,
  children,
}: FramedDrawerProps) {
  return (
    <Drawer.Root
      className={styles["drawer"]}
      opened={opened}
      position={position}
      size={size}
      zIndex={zIndex}
      onClose={onClose}
    >
      <Drawer.Overlay backgroundOpacity={dimmed ? 0.25 : 0} />
      <Drawer.Content>
        <VisuallyHidden component="div">
          <Drawer.Title>{title}</Drawer.Title>
        </VisuallyHidden>
        <Drawer.CloseButton className={styles["close"]} size={36} aria-label={strings.messages.close} />
        <Drawer.Body className={styles["drawerBody"]}>{children}</Drawer.Body>
      </Drawer.Content>
    </Drawer.Root>
  );
}
