import {
  useEffect,
  useLayoutEffect,
  useRef,
  useState,
  type Dispatch,
  type KeyboardEvent,
  type RefObject,
  type SetStateAction,
} from "react";
import { entityKey, type Entity } from "../../document/entities";
import { groupEntities } from "../../document/groups";
import { useApp, useProject, useView } from "../shared/app-context";
import {
  headingOf,
  madeGroupsKey,
  rowAbove,
  rowElementId,
  rowKey,
  type TreeRow,
  type TreeRows,
} from "./tree-rows";
import { selectModeOf, type TreeSelectMode } from "./tree-item";

export interface TreeNavigationOptions {
  readonly rows: TreeRows;
  readonly scroller: RefObject<HTMLElement | null>;
  readonly scrollTo: (index: number) => void;
  /** Sets which rows are closed, by key. */
  readonly setClosed: Dispatch<SetStateAction<ReadonlySet<string>>>;
}

export interface TreeNavigation {
  /** Index of the row that Tab reaches. */
  readonly focused: number;
  /** Selects the entity of a row, or opens or closes a group. */
  readonly activate: (row: TreeRow, mode: TreeSelectMode) => void;
  /** Opens or closes the rows below a row. */
  readonly toggle: (row: TreeRow) => void;
  readonly onKeyDown: (event: KeyboardEvent) => void;
}

/** Focus, selection and keys of the model tree, as the ARIA practices describe them for a tree view. */
export function useTreeNavigation(options: TreeNavigationOptions): TreeNavigation {
  const app = useApp();
  const project = useProject();
  const { rows, setClosed } = options;
  const { focused, focusRow, setFocusedKey } = useFocusedRow(options);
  useRevealedSelection(options);
  const setOpen = (row: TreeRow, open: boolean): void =>
    setClosed((keys) => {
      const next = new Set(keys);
      if (open) next.delete(rowKey(row));
      else next.add(rowKey(row));
      return next;
    });
  const { anchor, rangeTo } = useRange(rows);
  const activate = (row: TreeRow, mode: TreeSelectMode): void => {
    setFocusedKey(rowKey(row));
    if (row.type === "group" || row.type === "made-groups") setOpen(row, !row.open);
    else if (row.type === "made-group") {
      const single = mode === "add-range" || mode === "range" ? "add" : mode;
      app.view.selectMany(groupEntities(project, row.group), single);
    } else if (mode === "add-range") app.view.selectMany(rangeTo(row), "add");
    else if (mode === "range") app.view.selectAll(rangeTo(row));
    else {
      anchor.current = rowKey(row);
      app.view.select(row.entity, mode);
      app.view.reveal(row.entity.kind);
    }
  };
  /** Moves the focus by one row, and selects the range to it if Shift is held. */
  const stepTo = (index: number, extend: boolean): void => {
    focusRow(index);
    const row = rows.at(Math.min(rows.length - 1, Math.max(0, index)));
    if (!extend || !row) return;
    anchor.current ??= rowKey(rows.at(focused) ?? row);
    app.view.selectAll(rangeTo(row));
  };
  /** The entities of the row's kind, or those of a group. */
  const entitiesBeside = (row: TreeRow): readonly Entity[] => {
    if (row.type === "group") return rows.entitiesOf(row.kind);
    if (row.type === "entity") return rows.entitiesOf(row.entity.kind);
    const groups = row.type === "made-group" ? [row.group] : (project.groups ?? []);
    return groups.flatMap((group) => groupEntities(project, group));
  };
  const onKeyDown = (event: KeyboardEvent): void => {
    const row = rows.at(focused);
    if (!row) return;
    const isModified = event.ctrlKey || event.metaKey;
    const actions: Readonly<Record<string, () => void>> = {
      ArrowDown: () => stepTo(focused + 1, event.shiftKey),
      ArrowUp: () => stepTo(focused - 1, event.shiftKey),
      Home: () => focusRow(0),
      End: () => focusRow(rows.length - 1),
      ArrowRight: () => (openOf(row) === false ? setOpen(row, true) : focusRow(focused + 1)),
      ArrowLeft: () => {
        if (openOf(row) === true || row.type === "group") setOpen(row, false);
        else if (row.type === "entity") focusRow(rows.indexOf(rowAbove(project, row.entity)));
        else focusRow(rows.indexOf(madeGroupsKey));
      },
      Enter: () => activate(row, selectModeOf(event)),
      " ": () => activate(row, selectModeOf(event)),
    };
    const selectKind = (): void => app.view.selectAll(entitiesBeside(row));
    const action = event.key === "a" && isModified ? selectKind : actions[event.key];
    // Ctrl Enter generates the mesh.
    if (!action || (event.key === "Enter" && isModified)) return;
    event.preventDefault();
    // Ctrl A selects everything elsewhere.
    if (action === selectKind) event.stopPropagation();
    action();
  };
  const toggle = (row: TreeRow): void => setOpen(row, openOf(row) === false);
  return { focused, activate, toggle, onKeyDown };
}

/** Returns whether the rows below are shown; null if there are none. */
const openOf = (row: TreeRow): boolean | null => (row.type === "made-group" ? null : row.open);

/** Ranges of rows: from the anchor, which is the row that was chosen last without a range, to another row. */
function useRange(rows: TreeRows) {
  const anchor = useRef<string | null>(null);
  const rangeTo = (row: TreeRow): readonly Entity[] => {
    const from = rows.indexOf(anchor.current);
    const to = rows.indexOf(rowKey(row));
    const range = from < 0 ? [row] : rows.slice(Math.min(from, to), Math.max(from, to) + 1);
    const entities = range.flatMap((other) => (other.type === "entity" ? [other.entity] : []));
    return from > to ? entities.reverse() : entities;
  };
  return { anchor, rangeTo };
}

/** Tracks the row that has the focus. A row that is out of sight gets it after scrolling. */
function useFocusedRow({ rows, scroller, scrollTo }: TreeNavigationOptions) {
  const [focusedKey, setFocusedKey] = useState<string | null>(null);
  const shouldFocus = useRef(false);
  useLayoutEffect(() => {
    const row =
      shouldFocus.current && focusedKey !== null
        ? scroller.current?.querySelector(`#${CSS.escape(rowElementId(focusedKey))}`)
        : null;
    if (!(row instanceof HTMLElement)) return;
    shouldFocus.current = false;
    // The user may have moved the focus to another panel meanwhile.
    const holder = document.activeElement;
    if (holder === document.body || scroller.current?.contains(holder)) row.focus();
  });
  const focusRow = (index: number): void => {
    const within = Math.min(rows.length - 1, Math.max(0, index));
    const row = rows.at(within);
    if (!row) return;
    setFocusedKey(rowKey(row));
    scrollTo(within);
    shouldFocus.current = true;
  };
  return { focused: Math.max(0, rows.indexOf(focusedKey)), focusRow, setFocusedKey };
}

/** Opens the group of the entity selected last, and scrolls to its row. */
function useRevealedSelection({ rows, scrollTo, setClosed }: TreeNavigationOptions): void {
  const project = useProject();
  const selected = useView((state) => state.selection).at(-1);
  const selectedKey = selected ? entityKey(selected) : null;
  useEffect(() => {
    if (!selected) return;
    const above = [headingOf(selected.kind), rowAbove(project, selected)];
    setClosed((keys) =>
      above.some((key) => keys.has(key)) ? new Set([...keys].filter((key) => !above.includes(key))) : keys,
    );
    // Only a new selection opens rows, not an edit of the project.
  }, [selected, setClosed, project]);
  useEffect(() => {
    const index = rows.indexOf(selectedKey);
    if (index >= 0) scrollTo(index);
  }, [selectedKey, rows, scrollTo]);
}
