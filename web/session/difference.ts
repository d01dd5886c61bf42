/**
 * The difference of two states of plain data, as data: it can be stored, reversed and applied. Its size follows from what
 * differs. States share the parts that are the same, so that finding a difference visits only what was changed, and the lists
 * with changed records once.
 */
export type Difference =
  /** A value is replaced. A missing `from` or `to` is a missing field. */
  | { readonly from?: unknown; readonly to?: unknown }
  | { readonly fields: Readonly<Record<string, Difference>> }
  | { readonly list: readonly Hunk[] };

/** What follows a number of unchanged records in a list: records in place of others, or a difference within one record. */
type Hunk =
  | readonly [skip: number, from: readonly unknown[], to: readonly unknown[]]
  | readonly [skip: number, within: Difference];

type Fields = Readonly<Record<string, unknown>>;
type List = readonly unknown[];

const isList = (value: unknown): value is List => Array.isArray(value);
const isRecord = (value: unknown): value is Fields =>
  typeof value === "object" && value !== null && !isList(value) && !ArrayBuffer.isView(value);

/** Returns undefined for equal states. */
export function differenceOf(from: unknown, to: unknown): Difference | undefined {
  if (Object.is(from, to)) return undefined;
  if (isRecord(from) && isRecord(to)) return differenceOfRecords(from, to);
  if (!isList(from) || !isList(to)) return { from, to };
  if (![...from.slice(0, 1), ...to.slice(0, 1)].every((item) => typeof item === "object"))
    return isSameList(from, to) ? undefined : { from, to };
  const list = hunksOf(from, to);
  return list.length === 0 ? undefined : { list };
}

function differenceOfRecords(from: Fields, to: Fields): Difference | undefined {
  const fields: Record<string, Difference> = {};
  for (const key of Object.keys({ ...from, ...to })) {
    const difference = differenceOf(from[key], to[key]);
    if (difference) fields[key] = difference;
  }
  return Object.keys(fields).length === 0 ? undefined : { fields };
}

const isSameList = (a: List, b: List): boolean =>
  a.length === b.length && a.every((item, i) => Object.is(item, b[i]));

/** Records with the same id are states of one record, unless the id is that of another record, of some kind. */
const keyOf = (item: unknown): unknown => (isRecord(item) && !("kind" in item) ? (item["id"] ?? item) : item);

function hunksOf(from: List, to: List): readonly Hunk[] {
  const keys = new Map<List, ReadonlySet<unknown>>();
  const has = (list: List, item: unknown): boolean => {
    const known = keys.get(list) ?? new Set(list.map(keyOf));
    keys.set(list, known);
    return known.has(keyOf(item));
  };
  const hunks = new Hunks();
  let [i, j] = [0, 0];
  while (i < from.length || j < to.length) {
    const isPair = i < from.length && j < to.length && (from[i] === to[j] || keyOf(from[i]) === keyOf(to[j]));
    if (isPair) hunks.pair(from[i++], to[j++]);
    else if (i < from.length && !has(to, from[i])) hunks.replace([from[i++]], []);
    else if (j < to.length && !has(from, to[j])) hunks.replace([], [to[j++]]);
    else {
      // The order has changed.
      hunks.replace(from.slice(i), to.slice(j));
      break;
    }
  }
  return hunks.list;
}

/** Collects hunks; adjacent ones are joined. */
class Hunks {
  readonly list: Hunk[] = [];
  /** The hunk that adjacent replacements extend; null after an unchanged record. */
  #open: { readonly from: unknown[]; readonly to: unknown[] } | null = null;
  #skip = 0;

  pair(from: unknown, to: unknown): void {
    const within = from === to ? undefined : differenceOf(from, to);
    if (within && !hasRecords(to)) return this.replace([from], [to]);
    this.#open = null;
    if (within) this.#add([this.#skip, within]);
    else this.#skip += 1;
  }

  replace(from: List, to: List): void {
    if (!this.#open) {
      this.#open = { from: [], to: [] };
      this.#add([this.#skip, this.#open.from, this.#open.to]);
    }
    for (const item of from) this.#open.from.push(item);
    for (const item of to) this.#open.to.push(item);
  }

  #add(hunk: Hunk): void {
    this.list.push(hunk);
    this.#skip = 0;
  }
}

/** Returns whether a record holds others, as a body its patches: a difference within it is smaller than the record. */
const hasRecords = (value: unknown): boolean =>
  isRecord(value) && Object.values(value).some((part) => isList(part) && isRecord(part[0]));

/** Returns the difference that leads back. */
export function reversed(difference: Difference): Difference {
  if ("fields" in difference) {
    const fields = Object.entries(difference.fields).map(([key, field]) => [key, reversed(field)] as const);
    return { fields: Object.fromEntries(fields) };
  }
  if (!("list" in difference)) return { from: difference.to, to: difference.from };
  return {
    list: difference.list.map((hunk) =>
      hunk.length === 3 ? ([hunk[0], hunk[2], hunk[1]] as const) : ([hunk[0], reversed(hunk[1])] as const),
    ),
  };
}

/** Returns the state after a difference from the given one. Shares unchanged parts with it, and new values with the difference. */
export function withDifference<State>(state: State, difference: Difference): State {
  return changedValue(state, difference) as State;
}

function changedValue(value: unknown, difference: Difference): unknown {
  if ("list" in difference) return changedList(value as List, difference.list);
  if (!("fields" in difference)) return difference.to;
  const record: Record<string, unknown> = { ...(value as Fields) };
  for (const [key, field] of Object.entries(difference.fields)) {
    const changed = changedValue(record[key], field);
    if (changed === undefined) Reflect.deleteProperty(record, key);
    else record[key] = changed;
  }
  return record;
}

function changedList(list: List, hunks: readonly Hunk[]): List {
  const changed: unknown[] = [];
  let next = 0;
  for (const hunk of hunks) {
    for (const end = next + hunk[0]; next < end; ++next) changed.push(list[next]);
    if (hunk.length === 2) changed.push(changedValue(list[next++], hunk[1]));
    else {
      for (const item of hunk[2]) changed.push(item);
      next += hunk[1].length;
    }
  }
  for (; next < list.length; ++next) changed.push(list[next]);
  return changed;
}
