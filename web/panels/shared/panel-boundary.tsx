import { Button, Text } from "@mantine/core";
import { Component, Suspense, type ReactNode } from "react";
import { strings } from "../../strings";
import styles from "./panel-boundary.module.css";

interface PanelBoundaryProps {
  readonly children: ReactNode;
  readonly onFailed?: () => void;
  /** Show the failure above the page, because the content has no area of its own. */
  readonly floats?: boolean;
}

interface PanelBoundaryState {
  readonly failed: boolean;
}

/** Shows content that is loaded later. If loading fails, the rest of the app continues to work. */
export class PanelBoundary extends Component<PanelBoundaryProps, PanelBoundaryState> {
  override state: PanelBoundaryState = { failed: false };

  static getDerivedStateFromError(): PanelBoundaryState {
    return { failed: true };
  }

  override componentDidCatch(): void {
    this.props.onFailed?.();
  }

  override render(): ReactNode {
    if (!this.state.failed) return <Suspense fallback={null}>{this.props.children}</Suspense>;
    return (
      <div className={this.props.floats ? styles["floating"] : styles["alert"]} role="alert">
        <Text size="sm" mb={8}>
          {strings.messages.partFailed}
        </Text>
        <Button size="compact-sm" variant="default" onClick={() => window.location.reload()}>
          {strings.messages.reload}
        </Button>
      </div>
    );
  }
}
