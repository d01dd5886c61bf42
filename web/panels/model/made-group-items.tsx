import { IconChevronDown, IconChevronRight } from "@tabler/icons-react";
import { useMemo, type ComponentPropsWithoutRef } from "react";
import type { ProjectGroup } from "tetrafront/project";
import { groupedColor, cssColor, groupEntities } from "../../document/groups";
import { strings } from "../../strings";
import { formatCount } from "../../strings/format";
import { useProject } from "../shared/app-context";
import styles from "./model-tree.module.css";
import { EntitiesEye, IsolateButton, ShowAllButton } from "./tree-actions";
import { headings, type TreeRow } from "./tree-rows";

/** What the elements of all rows have in common. */
export type Common = Readonly<ComponentPropsWithoutRef<"div">>;
type RowOf<Type extends TreeRow["type"]> = Extract<TreeRow, { type: Type }>;

/** A spot of the colour of a group. */
export function Swatch({ color }: { readonly color: NonNullable<ProjectGroup["color"]> }) {
  return <span className={styles["swatch"]} style={{ background: cssColor(color) }} aria-hidden />;
}

/** The heading of the groups that the user made. */
export function MadeGroupsItem({
  row,
  common,
}: {
  readonly row: RowOf<"made-groups">;
  readonly common: Common;
}) {
  const Chevron = row.open ? IconChevronDown : IconChevronRight;
  return (
    <div
      {...common}
      className={`${styles["row"]} ${styles["group"]}`}
      aria-level={1}
      aria-expanded={row.open}
      aria-setsize={headings.length + 1}
      aria-posinset={row.ordinal}
    >
      <Chevron size={14} aria-hidden />
      <span className={styles["title"]}>{strings.groups.title}</span>
      <span className={styles["detail"]}>{formatCount(row.total)}</span>
      <ShowAllButton />
    </div>
  );
}

/** A group that the user made. Its members stand below the headings of their kinds. */
export function MadeGroupItem({
  row,
  common,
}: {
  readonly row: RowOf<"made-group">;
  readonly common: Common;
}) {
  const project = useProject();
  const { group } = row;
  const entities = useMemo(() => groupEntities(project, group), [project, group]);
  return (
    <div
      {...common}
      className={styles["row"]}
      aria-level={2}
      aria-setsize={row.siblings}
      aria-posinset={row.ordinal}
      title={strings.groups.select(group.name, entities.length)}
    >
      <Swatch color={group.color ?? groupedColor} />
      <span className={styles["title"]}>{group.name}</span>
      <span className={styles["detail"]}>{formatCount(entities.length)}</span>
      <IsolateButton entities={entities} name={group.name} />
      <EntitiesEye entities={entities} name={group.name} />
    </div>
  );
}
