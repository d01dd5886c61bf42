import { ActionIcon, Splitter, Tabs, Tooltip } from "@mantine/core";
import { IconAdjustments, IconListDetails, IconMessage2 } from "@tabler/icons-react";
import type { ReactNode, RefObject } from "react";
import { FramedDrawer } from "../../ui/frames/framed-drawer";
import { strings } from "../../strings";
import { useApp, useShell } from "../shared/app-context";
import { BottomPanel } from "./bottom-panel";
import { Header } from "./header";
import { Inspector } from "../inspector/inspector";
import { DisplayPanel, GalleryPanel, LessonsPanel, QualityReport } from "../later/later";
import { ModelTree } from "../model/model-tree";
import { PanelBoundary } from "../shared/panel-boundary";
import { StatusBar } from "./status-bar";
import { useLayout, type Layout } from "../shared/use-layout";
import { ViewportPanel } from "../viewport/viewport-panel";
import tabs from "../../ui/frames/panel-tabs.module.css";
import styles from "./layout.module.css";

const rightTabs = ["inspector", "quality", "display", "lessons"] as const;

/** The whole app: panels beside the view if there is room, otherwise in drawers. */
export function PageLayout({ root }: { readonly root: RefObject<HTMLDivElement | null> }) {
  const layout = useLayout();
  return (
    <div ref={root} className={styles["page"]} data-testid="app" data-layout={layout}>
      <Header layout={layout} />
      {layout === "wide" ? <WideBody /> : <NarrowBody layout={layout} />}
      <StatusBar />
    </div>
  );
}

/** Sizes of the panels. An audience sees larger type, and no model tree. */
const usualSizes = { bottom: ["212px", "420px"], right: ["292px", "520px"] } as const;
const presenterSizes = { bottom: ["300px", "540px"], right: ["440px", "720px"] } as const;

function WideBody() {
  const isPresenting = useShell((state) => state.isPresenting);
  const { bottom, right } = isPresenting ? presenterSizes : usualSizes;
  return (
    <Splitter key={String(isPresenting)} className={styles["body"]} withHandle={false} lineSize={1}>
      {!isPresenting && (
        <Splitter.Pane defaultSize="250px" min="180px" max="480px">
          <aside className={styles["side"]} aria-label={strings.tree.model}>
            <LeftPanel />
          </aside>
        </Splitter.Pane>
      )}
      <Splitter.Pane defaultSize={100} min={20}>
        <Splitter orientation="vertical" className={styles["side"]} withHandle={false} lineSize={1}>
          <Splitter.Pane defaultSize={100} min={20}>
            <ViewportPanel layout="wide" />
          </Splitter.Pane>
          <Splitter.Pane defaultSize={bottom[0]} min="60px" max={bottom[1]}>
            <aside className={styles["side"]} aria-label={strings.bottom.title}>
              <BottomPanel />
            </aside>
          </Splitter.Pane>
        </Splitter>
      </Splitter.Pane>
      <Splitter.Pane defaultSize={right[0]} min="220px" max={right[1]}>
        <aside className={styles["side"]} aria-label={strings.inspector.title}>
          <RightPanel />
        </aside>
      </Splitter.Pane>
    </Splitter>
  );
}

const drawers = [
  { key: "left", label: strings.tree.model, Icon: IconListDetails },
  { key: "right", label: strings.inspector.title, Icon: IconAdjustments },
  { key: "bottom", label: strings.bottom.title, Icon: IconMessage2 },
] as const;

/** Buttons that open the drawers. */
function Rail({ phone }: { readonly phone: boolean }) {
  const app = useApp();
  return (
    <nav className={styles["rail"]} aria-label={strings.header.panels}>
      {drawers.map(({ key, label, Icon }) => (
        <Tooltip key={key} label={label} disabled={phone} position="right">
          <ActionIcon
            size={phone ? 44 : 32}
            variant="subtle"
            color="gray"
            aria-label={label}
            aria-haspopup="dialog"
            data-testid={`drawer-${key}`}
            onClick={() => app.shell.setState({ drawer: key })}
          >
            <Icon size={18} aria-hidden />
            {phone && <span className={styles["railLabel"]}>{label}</span>}
          </ActionIcon>
        </Tooltip>
      ))}
    </nav>
  );
}

function NarrowBody({ layout }: { readonly layout: Layout }) {
  const app = useApp();
  const open = useShell((state) => state.drawer);
  const phone = layout === "phone";
  const panels: Readonly<Record<"left" | "right" | "bottom", ReactNode>> = {
    left: <LeftPanel />,
    right: <RightPanel />,
    bottom: <BottomPanel />,
  };
  return (
    <>
      <div className={`${styles["body"]} ${styles["narrow"]}`} data-drawer={(phone && open) || undefined}>
        <Rail phone={phone} />
        <ViewportPanel layout={layout} />
      </div>
      {drawers.map(({ key, label }) => (
        <FramedDrawer
          key={key}
          opened={open === key}
          position={phone ? "bottom" : key}
          size={phone || key === "bottom" ? "62%" : 320}
          title={label}
          dimmed={!phone}
          onClose={() => app.shell.setState({ drawer: null })}
        >
          {panels[key]}
        </FramedDrawer>
      ))}
    </>
  );
}

function LeftPanel() {
  const app = useApp();
  const tab = useShell((state) => state.leftTab);
  return (
    <Tabs
      className={tabs["tabs"]}
      value={tab}
      keepMounted={false}
      onChange={(value) => app.shell.setState({ leftTab: value === "examples" ? "examples" : "model" })}
    >
      <Tabs.List>
        <Tabs.Tab value="model">{strings.tree.model}</Tabs.Tab>
        <Tabs.Tab value="examples" data-testid="tab-examples">
          {strings.tree.examples}
        </Tabs.Tab>
      </Tabs.List>
      <Tabs.Panel value="model">
        <ModelTree />
      </Tabs.Panel>
      <Tabs.Panel value="examples">
        <PanelBoundary>
          <GalleryPanel />
        </PanelBoundary>
      </Tabs.Panel>
    </Tabs>
  );
}

function RightPanel() {
  const app = useApp();
  const tab = useShell((state) => state.rightTab);
  return (
    <Tabs
      className={tabs["tabs"]}
      value={tab}
      keepMounted={false}
      onChange={(value) =>
        app.shell.setState({ rightTab: rightTabs.find((tab) => tab === value) ?? "inspector" })
      }
    >
      <Tabs.List>
        <Tabs.Tab value="inspector">{strings.inspector.title}</Tabs.Tab>
        <Tabs.Tab value="quality" data-testid="tab-quality">
          {strings.report.tab}
        </Tabs.Tab>
        <Tabs.Tab value="display">{strings.inspector.display}</Tabs.Tab>
        <Tabs.Tab value="lessons" data-testid="tab-lessons">
          {strings.inspector.lessons}
        </Tabs.Tab>
      </Tabs.List>
      <Tabs.Panel value="inspector">
        <Inspector />
      </Tabs.Panel>
      <Tabs.Panel value="quality">
        <PanelBoundary>
          <QualityReport />
        </PanelBoundary>
      </Tabs.Panel>
      <Tabs.Panel value="display">
        <PanelBoundary>
          <DisplayPanel />
        </PanelBoundary>
      </Tabs.Panel>
      <Tabs.Panel value="lessons">
        <PanelBoundary>
          <LessonsPanel />
        </PanelBoundary>
      </Tabs.Panel>
    </Tabs>
  );
}
