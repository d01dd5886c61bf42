import { ActionIcon, CloseButton, Text, TextInput } from "@mantine/core";
import {
  IconAlertTriangle,
  IconChevronDown,
  IconChevronRight,
  IconEye,
  IconEyeOff,
  IconPlus,
  IconSearch,
} from "@tabler/icons-react";
import {
  useEffect,
  useLayoutEffect,
  useMemo,
  useRef,
  useState,
  type KeyboardEvent,
  type MouseEvent,
} from "react";
import type { App } from "../app/app";
import { commandNamed, runCommand } from "../commands/registry";
import { lineMakers, makeOrTell, patchMakers } from "../commands/create-menu";
import { drawnKinds, entityKey, recordsOf, type DrawnKind, type Entity } from "../document/entities";
import type { SelectMode } from "../document/selection";
import { entityWords, strings } from "../ui/strings";
import { formatCount } from "../ui/format";
import { useApp, useProblems, useProject, useView } from "./app-context";
import { EntityIcon } from "./entity-icon";
import { TreeRows, type TreeRow } from "./tree-rows";
import { useRowWindow } from "./use-row-window";

/** Pixels per row. */
const rowHeight = 24;

const rowKey = (row: TreeRow): string => (row.type === "group" ? row.kind : entityKey(row.entity));

function modeOf(event: MouseEvent | KeyboardEvent): SelectMode {
  if (event.ctrlKey || event.metaKey) return "toggle";
  return event.shiftKey ? "add" : "replace";
}

/** Everything drawn, grouped by kind. Only the rows in sight are in the page. */
export function ModelTree() {
  const app = useApp();
  const project = useProject();
  const selection = useView((state) => state.selection);
  const [filter, setFilter] = useState("");
  const [closed, setClosed] = useState<ReadonlySet<DrawnKind>>(() => new Set(["point"] as const));
  const [focusedKey, setFocusedKey] = useState<string | null>(null);
  const rows = useMemo(() => new TreeRows(project, filter, closed), [project, filter, closed]);
  const focused = Math.max(0, rows.indexOf(focusedKey));
  const scroller = useRef<HTMLDivElement>(null);
  const { first, last, scrollTo } = useRowWindow(scroller, rows.length, rowHeight);

  // A row far away is in the page only after scrolling; the focus waits for it, unless it has moved on.
  const wantsFocus = useRef(false);
  useLayoutEffect(() => {
    const row = wantsFocus.current ? document.getElementById(`row-${focusedKey}`) : null;
    if (!row) return;
    wantsFocus.current = false;
    const holder = document.activeElement;
    if (holder === document.body || scroller.current?.contains(holder)) row.focus();
  });

  const setOpen = (kind: DrawnKind, open: boolean): void => {
    const next = new Set(closed);
    if (open) next.delete(kind);
    else next.add(kind);
    setClosed(next);
  };
  // Where a range of rows, selected with Shift, begins.
  const anchor = useRef<string | null>(null);
  const selectRange = (row: TreeRow): void => {
    const from = rows.indexOf(anchor.current);
    const to = rows.indexOf(rowKey(row));
    const range = from < 0 ? [row] : rows.slice(Math.min(from, to), Math.max(from, to) + 1);
    const entities = range.flatMap((other) => (other.type === "entity" ? [other.entity] : []));
    app.view.selectAll(from > to ? entities.reverse() : entities);
  };
  const focusRow = (index: number): void => {
    const within = Math.min(rows.length - 1, Math.max(0, index));
    const row = rows.at(within);
    if (!row) return;
    setFocusedKey(rowKey(row));
    scrollTo(within);
    wantsFocus.current = true;
  };
  const activate = (row: TreeRow, mode: SelectMode): void => {
    setFocusedKey(rowKey(row));
    if (row.type === "group") setOpen(row.kind, !row.open);
    else if (mode === "add") selectRange(row);
    else {
      anchor.current = rowKey(row);
      app.view.select(row.entity, mode);
      app.view.reveal(row.entity.kind);
    }
  };
  /** Moves the focus by one row; with Shift the selection goes along. */
  const stepTo = (index: number, extend: boolean): void => {
    focusRow(index);
    const row = rows.at(Math.min(rows.length - 1, Math.max(0, index)));
    if (!extend || !row) return;
    anchor.current ??= rowKey(rows.at(focused) ?? row);
    selectRange(row);
  };
  const selectKind = (kind: DrawnKind): void => app.view.selectAll(rows.entitiesOf(kind));
  const onKeyDown = (event: KeyboardEvent): void => {
    const row = rows.at(focused);
    if (!row) return;
    const steps: Readonly<Record<string, () => void>> = {
      ArrowDown: () => stepTo(focused + 1, event.shiftKey),
      ArrowUp: () => stepTo(focused - 1, event.shiftKey),
      Home: () => focusRow(0),
      End: () => focusRow(rows.length - 1),
      ArrowRight: () => (row.type === "group" && !row.open ? setOpen(row.kind, true) : focusRow(focused + 1)),
      ArrowLeft: () => {
        if (row.type === "group") setOpen(row.kind, false);
        else focusRow(rows.indexOf(row.entity.kind));
      },
      Enter: () => activate(row, modeOf(event)),
      " ": () => activate(row, modeOf(event)),
    };
    if (event.key === "a" && (event.ctrlKey || event.metaKey)) {
      event.preventDefault();
      selectKind(row.type === "group" ? row.kind : row.entity.kind);
      return;
    }
    const step = steps[event.key];
    if (!step || (event.key === "Enter" && (event.ctrlKey || event.metaKey))) return;
    event.preventDefault();
    step();
  };

  const empty = drawnKinds.every((kind) => recordsOf(project, kind).length === 0);

  // What is selected in the view comes into sight here: of several things the latest.
  const selected = selection.at(-1);
  const selectedKey = selected ? entityKey(selected) : null;
  useEffect(() => {
    if (!selected) return;
    setClosed((kinds) =>
      kinds.has(selected.kind) ? new Set([...kinds].filter((kind) => kind !== selected.kind)) : kinds,
    );
  }, [selected]);
  useEffect(() => {
    const index = rows.indexOf(selectedKey);
    if (index >= 0) scrollTo(index);
  }, [selectedKey, rows, scrollTo]);

  return (
    <div className="tf-fill" data-testid="model-tree">
      <TextInput
        m={6}
        size="xs"
        aria-label={strings.tree.filter}
        placeholder={strings.tree.filter}
        leftSection={<IconSearch size={14} aria-hidden />}
        rightSection={
          filter === "" ? null : (
            <CloseButton size="xs" aria-label={strings.tree.clearFilter} onClick={() => setFilter("")} />
          )
        }
        value={filter}
        onChange={(event) => setFilter(event.currentTarget.value)}
      />
      <div ref={scroller} className="tf-scroll" tabIndex={-1}>
        {(empty || rows.length === 0) && (
          <Text c="dimmed" p="sm" size="sm">
            {empty ? strings.tree.empty : strings.tree.nothing}
          </Text>
        )}
        <div
          role="tree"
          aria-label={strings.tree.model}
          aria-multiselectable
          className="tf-tree"
          style={{ height: rows.length * rowHeight }}
          onKeyDown={onKeyDown}
          onMouseLeave={() => app.view.setHover(null)}
        >
          {rows.slice(first, last).map((row, index) => (
            <TreeItem
              key={rowKey(row)}
              row={row}
              top={(first + index) * rowHeight}
              focusable={first + index === focused}
              onActivate={(mode) => activate(row, mode)}
            />
          ))}
        </div>
      </div>
    </div>
  );
}

interface TreeItemProps {
  readonly row: TreeRow;
  readonly top: number;
  readonly focusable: boolean;
  readonly onActivate: (mode: SelectMode) => void;
}

function TreeItem({ row, top, focusable, onActivate }: TreeItemProps) {
  const app = useApp();
  const project = useProject();
  const key = rowKey(row);
  const selected = useView(
    (state) => row.type === "entity" && state.selection.some((e) => entityKey(e) === key),
  );
  const hovered = useView((state) => state.hover !== null && entityKey(state.hover) === key);
  const problemCount = useProblems((state) =>
    row.type === "entity" ? (state.byEntity.get(key)?.length ?? 0) : 0,
  );
  const common = {
    id: `row-${key}`,
    role: "treeitem",
    tabIndex: focusable ? 0 : -1,
    style: { top, height: rowHeight },
    "data-testid": `tree-${key}`,
    onClick: (event: MouseEvent) => onActivate(modeOf(event)),
  } as const;
  if (row.type === "group") {
    const Chevron = row.open ? IconChevronDown : IconChevronRight;
    return (
      <div
        {...common}
        className="tf-row tf-row-group"
        aria-level={1}
        aria-expanded={row.open}
        aria-setsize={drawnKinds.length}
        aria-posinset={row.position}
      >
        <Chevron size={14} aria-hidden />
        <span className="tf-row-title">{entityWords[row.kind].many}</span>
        <span className="tf-row-detail">{formatCount(row.total)}</span>
        <AddButton kind={row.kind} />
        <GroupEye kind={row.kind} />
      </div>
    );
  }
  return (
    <div
      {...common}
      className="tf-row"
      data-hover={hovered || undefined}
      aria-level={2}
      aria-selected={selected}
      aria-setsize={row.siblings}
      aria-posinset={row.position}
      onMouseEnter={() => app.view.setHover(row.entity)}
      onDoubleClick={() => app.viewer.getState().viewer?.fit([row.entity])}
    >
      <EntityIcon entity={row.entity} project={project} />
      <span className="tf-row-title" title={row.title}>
        {row.title}
      </span>
      {problemCount > 0 && (
        <span className="tf-row-problem" role="img" aria-label={strings.tree.problems(problemCount)}>
          <IconAlertTriangle size={14} aria-hidden />
        </span>
      )}
      <span className="tf-row-detail">{row.detail()}</span>
      <EntityEye entity={row.entity} title={row.title} />
    </div>
  );
}

interface EyeProps {
  readonly hidden: boolean;
  readonly what: string;
  readonly onToggle: () => void;
}

function Eye({ hidden, what, onToggle }: EyeProps) {
  const Icon = hidden ? IconEyeOff : IconEye;
  return (
    <ActionIcon
      className="tf-eye"
      size={22}
      variant="subtle"
      color="gray"
      tabIndex={-1}
      data-off={hidden || undefined}
      aria-label={hidden ? strings.tree.show(what) : strings.tree.hide(what)}
      onClick={(event) => {
        event.stopPropagation();
        onToggle();
      }}
    >
      <Icon size={14} aria-hidden />
    </ActionIcon>
  );
}

function EntityEye({ entity, title }: { readonly entity: Entity; readonly title: string }) {
  const app = useApp();
  const hidden = useView((state) => state.hidden.has(entityKey(entity)));
  return <Eye hidden={hidden} what={title} onToggle={() => app.view.setHidden([entity], !hidden)} />;
}

const addWhat: { readonly [K in DrawnKind]: (app: App) => void } = {
  point: (app) => app.shell.setState({ dialog: "new-point" }),
  line: (app) => makeOrTell(app, lineMakers, strings.create.line, strings.create.lineHint),
  patch: (app) => makeOrTell(app, patchMakers, strings.create.patch, strings.create.patchHint),
  "background-node": (app) => app.shell.setState({ dialog: "new-node" }),
  source: (app) => runCommand(app, commandNamed("source-point")),
};

function AddButton({ kind }: { readonly kind: DrawnKind }) {
  const app = useApp();
  const label = strings.tree.add(entityWords[kind].one.toLowerCase());
  return (
    <ActionIcon
      className="tf-eye"
      size={22}
      variant="subtle"
      color="gray"
      tabIndex={-1}
      aria-label={label}
      title={label}
      data-testid={`add-${kind}`}
      onClick={(event) => {
        event.stopPropagation();
        addWhat[kind](app);
      }}
    >
      <IconPlus size={14} aria-hidden />
    </ActionIcon>
  );
}

const layerOfKind = {
  point: "points",
  line: "lines",
  patch: "patches",
  "background-node": "background",
  source: "sources",
} as const;

function GroupEye({ kind }: { readonly kind: DrawnKind }) {
  const app = useApp();
  const layer = layerOfKind[kind];
  const visible = useView((state) => state.layers[layer]);
  const what = entityWords[kind].many.toLowerCase();
  return <Eye hidden={!visible} what={what} onToggle={() => app.view.setLayer(layer, !visible)} />;
}
