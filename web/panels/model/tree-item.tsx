import { IconAlertTriangle, IconChevronDown, IconChevronRight, IconCircleDashed } from "@tabler/icons-react";
import type { KeyboardEvent, MouseEvent } from "react";
import { rename } from "../../commands/selection-actions";
import { entityKey } from "../../document/entities";
import { groupTints } from "../../document/groups";
import type { SelectMode } from "../../document/selection";
import type { Problem } from "../../document/validate";
import { formatCount } from "../../strings/format";
import { entityWords, strings } from "../../strings";
import { useApp, useProblems, useProject, useView } from "../shared/app-context";
import { isCalm, useShownSeverity } from "../shared/problem-severity";
import { useEntityHover } from "../shared/use-entity-hover";
import { EntityIcon } from "../shared/entity-icon";
import styles from "./model-tree.module.css";
import { AddButton, EntityEye, GroupEye } from "./tree-actions";
import { MadeGroupItem, MadeGroupsItem, Swatch, type Common } from "./made-group-items";
import { headings, rowElementId, rowKey, type TreeRow } from "./tree-rows";

/** How a click or a key changes the selection: by one row, or by all rows from the one chosen before. */
export type TreeSelectMode = SelectMode | "range" | "add-range";

export function selectModeOf(event: MouseEvent | KeyboardEvent): TreeSelectMode {
  const hasMod = event.ctrlKey || event.metaKey;
  if (event.shiftKey) return hasMod ? "add-range" : "range";
  return hasMod ? "toggle" : "replace";
}

export interface TreeItemProps {
  readonly row: TreeRow;
  /** Position in the list, in pixels. */
  readonly top: number;
  readonly height: number;
  readonly isFocusable: boolean;
  readonly onActivate: (mode: TreeSelectMode) => void;
  /** Opens or closes the rows below. */
  readonly onToggle: () => void;
}

/** A row of the model tree. */
export function TreeItem({ row, top, height, isFocusable, onActivate, onToggle }: TreeItemProps) {
  const key = rowKey(row);
  const common = {
    id: rowElementId(key),
    role: "treeitem",
    tabIndex: isFocusable ? 0 : -1,
    style: { top, height },
    "data-testid": `tree-${key}`,
    onClick: (event: MouseEvent) => onActivate(selectModeOf(event)),
  } as const;
  switch (row.type) {
    case "group":
      return <GroupItem row={row} common={common} />;
    case "entity":
      return <EntityItem row={row} common={common} onToggle={onToggle} />;
    case "made-groups":
      return <MadeGroupsItem row={row} common={common} />;
    case "made-group":
      return <MadeGroupItem row={row} common={common} />;
  }
}

type RowOf<Type extends TreeRow["type"]> = Extract<TreeRow, { type: Type }>;

function GroupItem({ row, common }: { readonly row: RowOf<"group">; readonly common: Common }) {
  const hasMade = (useProject().groups ?? []).length > 0;
  const Chevron = row.open ? IconChevronDown : IconChevronRight;
  return (
    <div
      {...common}
      className={`${styles["row"]} ${styles["group"]}`}
      aria-level={1}
      aria-expanded={row.open}
      aria-setsize={headings.length + (hasMade ? 1 : 0)}
      aria-posinset={row.ordinal}
    >
      <Chevron size={14} aria-hidden />
      <span className={styles["title"]}>{entityWords[row.kind].many}</span>
      <span className={styles["detail"]}>{formatCount(row.total)}</span>
      <AddButton kind={row.kind} />
      <GroupEye kind={row.kind} />
    </div>
  );
}

interface EntityItemProps {
  readonly row: RowOf<"entity">;
  readonly common: Common;
  readonly onToggle: () => void;
}

function EntityItem({ row, common, onToggle }: EntityItemProps) {
  const app = useApp();
  const project = useProject();
  const key = rowKey(row);
  const tint = groupTints(project).get(row.entity.kind === "body-patch" ? `patch-${row.entity.id}` : key);
  const isSelected = useView((state) => state.selection.some((entity) => entityKey(entity) === key));
  const isHovered = useView((state) => state.hover !== null && entityKey(state.hover) === key);
  const problems = useProblems((state) => state.byEntity.get(key));
  return (
    <div
      {...common}
      className={styles["row"]}
      data-hover={isHovered || undefined}
      data-level={row.level}
      data-kind={row.entity.kind}
      aria-level={row.level}
      {...(row.open !== null && { "aria-expanded": row.open })}
      aria-selected={isSelected}
      aria-setsize={row.siblings}
      aria-posinset={row.ordinal}
      {...useEntityHover(row.entity)}
      onDoubleClick={() => rename(app)}
    >
      {row.open !== null && <Opener isOpen={row.open} onToggle={onToggle} />}
      <EntityIcon entity={row.entity} project={project} />
      {tint && <Swatch color={tint} />}
      <span className={styles["title"]} title={row.title}>
        {row.title}
      </span>
      {problems && <ProblemIcon problems={problems} />}
      <span className={styles["detail"]}>{row.detail()}</span>
      <EntityEye entity={row.entity} title={row.title} />
    </div>
  );
}

function ProblemIcon({ problems }: { readonly problems: readonly Problem[] }) {
  const severityOf = useShownSeverity();
  const areCalm = problems.every((problem) => isCalm(severityOf(problem)));
  const Icon = areCalm ? IconCircleDashed : IconAlertTriangle;
  return (
    <span
      className={styles["problem"]}
      data-severity={areCalm ? "expected" : undefined}
      role="img"
      aria-label={strings.tree.problems(problems.length)}
    >
      <Icon size={14} aria-hidden />
    </span>
  );
}

/** The arrow that opens or closes the rows below an entity. Keys do the same on the row. */
function Opener({ isOpen, onToggle }: { readonly isOpen: boolean; readonly onToggle: () => void }) {
  const Chevron = isOpen ? IconChevronDown : IconChevronRight;
  return (
    <Chevron
      size={14}
      aria-hidden
      className={styles["opener"]}
      onClick={(event) => {
        event.stopPropagation();
        onToggle();
      }}
    />
  );
}
