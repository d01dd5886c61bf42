import { Tabs, Text } from "@mantine/core";
import { useEffect, useMemo, useRef } from "react";
import { groupProblems } from "../../document/validate";
import { strings } from "../../strings";
import { useApp, useProblems, useRun, useShell } from "../shared/app-context";
import { PatchTable } from "../quality/patch-quality";
import { HistoryList } from "../later/later";
import { FixAllButton } from "../problems/fix-button";
import { ProblemBadge } from "../problems/problem-badge";
import { ProblemCard } from "../problems/problem-card";
import { PanelBoundary } from "../shared/panel-boundary";
import { useSlots } from "../shared/slots";
import { useShownSeverity } from "../shared/problem-severity";
import tabs from "../../ui/frames/panel-tabs.module.css";
import { ScrollPanel } from "../../ui/frames/scroll-panel";
import styles from "./bottom-panel.module.css";

const bottomTabs = ["log", "problems", "patches", "front", "history"] as const;

/** The log of the mesher, the problems, the quality of the patches, the player of the front, and the steps of undo. */
export function BottomPanel() {
  const app = useApp();
  const slot = useSlots().bottom;
  const tab = useShell((state) => state.bottomTab);
  const hasProblems = useProblems((state) => state.problems.length > 0);
  return (
    <Tabs
      className={tabs["tabs"]}
      value={tab}
      keepMounted={false}
      onChange={(value) => {
        const chosen = bottomTabs.find((tab) => tab === value);
        if (chosen) app.shell.setState({ bottomTab: chosen });
      }}
    >
      <Tabs.List>
        <Tabs.Tab value="log">{strings.bottom.log}</Tabs.Tab>
        <Tabs.Tab value="problems" rightSection={hasProblems && <ProblemBadge />}>
          {strings.bottom.problems}
        </Tabs.Tab>
        <Tabs.Tab value="patches" data-testid="tab-patches">
          {strings.patches.tab}
        </Tabs.Tab>
        <Tabs.Tab value="front" data-testid="tab-front">
          {slot.label}
        </Tabs.Tab>
        <Tabs.Tab value="history" data-testid="tab-history">
          {strings.history.title}
        </Tabs.Tab>
      </Tabs.List>
      <Tabs.Panel value="log">
        <LogList />
      </Tabs.Panel>
      <Tabs.Panel value="problems">
        <ProblemPanel />
      </Tabs.Panel>
      <Tabs.Panel value="patches">
        <PatchTable />
      </Tabs.Panel>
      <Tabs.Panel value="front">
        <PanelBoundary>
          <slot.Panel />
        </PanelBoundary>
      </Tabs.Panel>
      <Tabs.Panel value="history">
        <PanelBoundary>
          <HistoryList />
        </PanelBoundary>
      </Tabs.Panel>
    </Tabs>
  );
}

function LogList() {
  const log = useRun((state) => state.log);
  const end = useRef<HTMLDivElement>(null);
  useEffect(() => {
    if (end.current) end.current.scrollTop = end.current.scrollHeight;
  }, [log]);
  return (
    <ScrollPanel
      ref={end}
      className={styles["log"]}
      padded={false}
      role="log"
      label={strings.bottom.log}
      data-testid="log"
    >
      {log.length === 0 && <Text c="dimmed">{strings.bottom.logEmpty}</Text>}
      {log.map((line) => (
        <p key={line.id} data-level={line.level}>
          <span>{line.seconds.toFixed(3).padStart(7, "\u2007")}</span>
          {line.text}
        </p>
      ))}
    </ScrollPanel>
  );
}

/** Largest number of problems listed per kind; the others are counted. */
const maxPerGroup = 50;

/** All problems, grouped by kind. */
function ProblemPanel() {
  const problems = useProblems((state) => state.problems);
  const areBodiesChecked = useProblems((state) => state.areBodiesChecked);
  const groups = useMemo(() => groupProblems(problems), [problems]);
  const severityOf = useShownSeverity();
  const indices = new Map(problems.map((problem, index) => [problem, index]));
  return (
    <ScrollPanel
      label={strings.bottom.problems}
      data-testid="problem-list"
      data-bodies-checked={areBodiesChecked}
    >
      {problems.length === 0 && (
        <Text size="sm" c="dimmed">
          {strings.bottom.noProblems}
        </Text>
      )}
      {groups.map(({ code, severity, problems: members }) => (
        <section key={`${severity} ${code}`} data-testid={`problems-${code}`}>
          <div className={styles["group"]} data-severity={severityOf({ code, severity })}>
            <h2>
              {strings.problemTitle(code)}
              <span>{strings.bottom.count(members.length, severityOf({ code, severity }))}</span>
            </h2>
            <FixAllButton problems={members} />
          </div>
          {members.slice(0, maxPerGroup).map((problem) => (
            <ProblemCard
              key={problem.key}
              problem={problem}
              testId={`problem-${indices.get(problem) ?? 0}`}
            />
          ))}
          {members.length > maxPerGroup && (
            <Text size="sm" c="dimmed">
              {strings.inspector.more(members.length - maxPerGroup)}
            </Text>
          )}
        </section>
      ))}
    </ScrollPanel>
  );
}
