import { ActionIcon, Splitter, Tabs, Tooltip } from "@mantine/core";
import type { SplitterPaneSize } from "@mantine/hooks";
import { IconAdjustments, IconListDetails, IconMessage2 } from "@tabler/icons-react";
import { useState, type ReactNode } from "react";
import { FramedDrawer } from "../../ui/frames/framed-drawer";
import { strings } from "../../strings";
import { useApp, useProblems, useShell } from "../shared/app-context";
import { BottomPanel } from "./bottom-panel";
import { Header } from "./header";
import { Inspector } from "../inspector/inspector";
import { DisplayPanel, GalleryPanel, QualityReport, SolutionPanel } from "../later/later";
import { ModelTree } from "../model/model-tree";
import { ProblemBadge } from "../problems/problem-badge";
import { PanelBoundary } from "../shared/panel-boundary";
import { useSlots } from "../shared/slots";
import { StatusBar } from "./status-bar";
import { useLayout, type Layout } from "../shared/use-layout";
import { ViewportPanel } from "../viewport/viewport-panel";
import tabs from "../../ui/frames/panel-tabs.module.css";
import styles from "./layout.module.css";

const rightTabs = ["inspector", "quality", "display", "solution"] as const;

/** The whole app: panels beside the view if there is room, otherwise in drawers. */
export function PageLayout() {
  const layout = useLayout();
  return (
    <div className={styles["page"]} data-testid="app" data-layout={layout}>
      <Header layout={layout} />
      {layout === "wide" ? <WideBody /> : <NarrowBody layout={layout} />}
      <StatusBar />
    </div>
  );
}

type Sizes = readonly SplitterPaneSize[];

/** Sizes of the panels, across and down. An audience sees larger type, and the lens or nothing in place of the model tree. */
const usual = {
  across: ["250px", 100, "292px"],
  down: [100, "212px"],
  limits: { left: ["180px", "480px"], right: "520px", bottom: "420px" },
} as const;
const presenting = {
  across: ["0px", 100, "440px"],
  down: [100, "300px"],
  limits: { left: ["0px", "0px"], right: "720px", bottom: "540px" },
} as const;

/** The player of an audience has two rows. */
const presentingLens = {
  across: ["390px", 100, "400px"],
  down: [100, "184px"],
  limits: { ...presenting.limits, left: ["280px", "600px"] },
} as const;

const arrangements = { usual, presenting, presentingLens } as const;
type Arrangement = keyof typeof arrangements;

/** Sizes that the user has chosen, with and without an audience. */
function useSizes(direction: "across" | "down", arrangement: Arrangement) {
  const [chosen, setChosen] = useState<Partial<Record<Arrangement, Sizes>>>({});
  return {
    sizes: [...(chosen[arrangement] ?? arrangements[arrangement][direction])],
    onSizeChange: (sizes: Sizes) => setChosen((before) => ({ ...before, [arrangement]: sizes })),
  };
}

/** All panes stay where they are in the tree, so that the view keeps its camera in presenter mode. */
function WideBody() {
  const isPresenting = useShell((state) => state.isPresenting);
  const slot = useSlots().left;
  const hasLens = slot.useIsOffered();
  const arrangement = !isPresenting ? "usual" : hasLens ? "presentingLens" : "presenting";
  const { limits } = arrangements[arrangement];
  const [left, right] = [usual.across[0], usual.across[2]];
  return (
    <Splitter
      className={styles["body"]}
      withHandle={false}
      lineSize={1}
      data-without-left={arrangement === "presenting" || undefined}
      {...useSizes("across", arrangement)}
    >
      <Splitter.Pane defaultSize={left} min={limits.left[0]} max={limits.left[1]}>
        <aside className={styles["side"]} aria-label={isPresenting ? slot.label : strings.tree.model}>
          {!isPresenting && <LeftPanel />}
          {arrangement === "presentingLens" && (
            <PanelBoundary>
              <slot.Panel />
            </PanelBoundary>
          )}
        </aside>
      </Splitter.Pane>
      <Splitter.Pane defaultSize={100} min={20}>
        <Splitter
          orientation="vertical"
          className={styles["side"]}
          withHandle={false}
          lineSize={1}
          {...useSizes("down", arrangement)}
        >
          <Splitter.Pane defaultSize={100} min={20}>
            <ViewportPanel layout="wide" />
          </Splitter.Pane>
          <Splitter.Pane defaultSize={usual.down[1]} min="60px" max={limits.bottom}>
            <aside className={styles["side"]} aria-label={strings.bottom.title}>
              <BottomPanel />
            </aside>
          </Splitter.Pane>
        </Splitter>
      </Splitter.Pane>
      <Splitter.Pane defaultSize={right} min="220px" max={limits.right}>
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
  const count = useProblems((state) => state.problems.length);
  return (
    <nav className={styles["rail"]} aria-label={strings.header.panels}>
      {drawers.map(({ key, label, Icon }) => (
        <Tooltip key={key} label={label} disabled={phone} position="right">
          <ActionIcon
            size={phone ? 44 : 32}
            variant="subtle"
            color="gray"
            aria-label={key === "bottom" && count > 0 ? `${label}: ${count}` : label}
            aria-haspopup="dialog"
            data-testid={`drawer-${key}`}
            onClick={() => app.shell.setState({ drawer: key })}
          >
            <Icon size={18} aria-hidden />
            {key === "bottom" && (
              <span className={styles["count"]}>
                <ProblemBadge />
              </span>
            )}
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
  const isBelow = (drawer: (typeof drawers)[number]["key"]): boolean => phone || drawer === "bottom";
  const panels: Readonly<Record<"left" | "right" | "bottom", ReactNode>> = {
    left: <LeftPanel />,
    right: <RightPanel />,
    bottom: <BottomPanel />,
  };
  return (
    <>
      <div
        className={`${styles["body"]} ${styles["narrow"]}`}
        data-drawer={(open !== null && isBelow(open) && open) || undefined}
      >
        <Rail phone={phone} />
        <ViewportPanel layout={layout} />
      </div>
      {drawers.map(({ key, label }) => (
        <FramedDrawer
          key={key}
          opened={open === key}
          position={phone ? "bottom" : key}
          size={isBelow(key) ? "62%" : 320}
          title={label}
          dimmed={!isBelow(key)}
          onClose={() => app.shell.setState({ drawer: null })}
        >
          {panels[key]}
        </FramedDrawer>
      ))}
    </>
  );
}

const leftTabs = ["model", "examples", "lens"] as const;

function LeftPanel() {
  const app = useApp();
  const slot = useSlots().left;
  const hasLens = slot.useIsOffered();
  const chosen = useShell((state) => state.leftTab);
  const tab = chosen === "lens" && !hasLens ? "model" : chosen;
  return (
    <Tabs
      className={tabs["tabs"]}
      value={tab}
      keepMounted={false}
      onChange={(value) =>
        app.shell.setState({ leftTab: leftTabs.find((known) => known === value) ?? "model" })
      }
    >
      <Tabs.List>
        <Tabs.Tab value="model">{strings.tree.model}</Tabs.Tab>
        <Tabs.Tab value="examples" data-testid="tab-examples">
          {strings.tree.examples}
        </Tabs.Tab>
        {hasLens && (
          <Tabs.Tab value="lens" data-testid="tab-lens">
            {slot.label}
          </Tabs.Tab>
        )}
      </Tabs.List>
      <Tabs.Panel value="model">
        <ModelTree />
      </Tabs.Panel>
      <Tabs.Panel value="examples">
        <PanelBoundary>
          <GalleryPanel />
        </PanelBoundary>
      </Tabs.Panel>
      {hasLens && (
        <Tabs.Panel value="lens">
          <PanelBoundary>
            <slot.Panel />
          </PanelBoundary>
        </Tabs.Panel>
      )}
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
        <Tabs.Tab value="solution" data-testid="tab-solution">
          {strings.inspector.solution}
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
      <Tabs.Panel value="solution">
        <PanelBoundary>
          <SolutionPanel />
        </PanelBoundary>
      </Tabs.Panel>
    </Tabs>
  );
}
