import { Drawer } from "@mantine/core";
import type { ReactNode } from "react";
import { strings } from "./strings";

export interface FramedDrawerProps {
  readonly title: string;
  readonly opened: boolean;
  readonly position: "left" | "right" | "bottom";
  readonly size: number | string;
  readonly onClose: () => void;
  readonly children: ReactNode;
}

/** A panel from the edge. Its head is no `header` element: the page has one already. */
export function FramedDrawer({ title, opened, position, size, onClose, children }: FramedDrawerProps) {
  return (
    <Drawer.Root opened={opened} position={position} size={size} onClose={onClose}>
      <Drawer.Overlay backgroundOpacity={0.25} />
      <Drawer.Content>
        <div className="tf-dialog-head">
          <Drawer.Title fw={600}>{title}</Drawer.Title>
          <Drawer.CloseButton aria-label={strings.messages.close} />
        </div>
        <Drawer.Body className="tf-drawer-body">{children}</Drawer.Body>
      </Drawer.Content>
    </Drawer.Root>
  );
}
