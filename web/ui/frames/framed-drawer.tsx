import { Drawer } from "@mantine/core";
import type { ReactNode } from "react";
import styles from "./framed.module.css";
import { strings } from "../../strings";

export interface FramedDrawerProps {
  readonly title: string;
  readonly opened: boolean;
  readonly position: "left" | "right" | "bottom";
  readonly size: number | string;
  readonly onClose: () => void;
  readonly children: ReactNode;
}

/** A panel at the edge of the page. Its head is a `div`, because the page already has a `header` element. */
export function FramedDrawer({ title, opened, position, size, onClose, children }: FramedDrawerProps) {
  return (
    <Drawer.Root
      className={styles["drawer"]}
      opened={opened}
      position={position}
      size={size}
      onClose={onClose}
    >
      <Drawer.Overlay backgroundOpacity={0.25} />
      <Drawer.Content>
        <div className={styles["head"]}>
          <Drawer.Title fw={600}>{title}</Drawer.Title>
          <Drawer.CloseButton aria-label={strings.messages.close} />
        </div>
        <Drawer.Body className={styles["drawerBody"]}>{children}</Drawer.Body>
      </Drawer.Content>
    </Drawer.Root>
  );
}
