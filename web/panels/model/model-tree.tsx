import { CloseButton, Text, TextInput } from "@mantine/core";
import { IconSearch } from "@tabler/icons-react";
import { useMemo, useRef, useState } from "react";
import { isEmptyProject } from "../../document/entities";
import panel from "../../ui/frames/panel.module.css";
import { strings } from "../../strings";
import { useProject } from "../shared/app-context";
import styles from "./model-tree.module.css";
import { TreeItem } from "./tree-item";
import { TreeRows, rowKey } from "./tree-rows";
import { useRowWindow } from "./use-row-window";
import { useTreeNavigation } from "./use-tree-navigation";

/** Height of a row, in pixels. */
const rowHeight = 24;

/** All entities of the model, grouped by kind. The page holds only the rows in sight. */
export function ModelTree() {
  const project = useProject();
  const [filter, setFilter] = useState("");
  const [closed, setClosed] = useState<ReadonlySet<string>>(() => new Set(["point"]));
  const rows = useMemo(() => new TreeRows(project, filter, closed), [project, filter, closed]);
  const scroller = useRef<HTMLDivElement>(null);
  const { first, last, scrollTo } = useRowWindow(scroller, rows.length, rowHeight);
  const { focused, activate, toggle, onKeyDown } = useTreeNavigation({ rows, scroller, scrollTo, setClosed });
  const isEmpty = isEmptyProject(project);
  return (
    <div className={styles["panel"]} data-testid="model-tree">
      <TextInput
        m={6}
        size="xs"
        aria-label={strings.tree.filter}
        placeholder={strings.tree.filter}
        leftSection={<IconSearch size={14} aria-hidden />}
        rightSection={
          filter === "" ? null : (
            <CloseButton size={24} aria-label={strings.tree.clearFilter} onClick={() => setFilter("")} />
          )
        }
        value={filter}
        onChange={(event) => setFilter(event.currentTarget.value)}
      />
      <div ref={scroller} className={panel["scroll"]} tabIndex={-1}>
        {(isEmpty || rows.length === 0) && (
          <Text c="dimmed" p="sm" size="sm">
            {isEmpty ? strings.tree.empty : strings.tree.nothing}
          </Text>
        )}
        <div
          role="tree"
          aria-label={strings.tree.model}
          aria-multiselectable
          className={styles["rows"]}
          style={{ height: rows.length * rowHeight }}
          onKeyDown={onKeyDown}
        >
          {rows.slice(first, last).map((row, index) => (
            <TreeItem
              key={rowKey(row)}
              row={row}
              top={(first + index) * rowHeight}
              height={rowHeight}
              isFocusable={first + index === focused}
              onActivate={(mode) => activate(row, mode)}
              onToggle={() => toggle(row)}
            />
          ))}
        </div>
      </div>
    </div>
  );
}
