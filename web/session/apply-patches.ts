import type { Patches } from "mutative";

type Container = Record<string | number, unknown>;

const copyOf = (value: unknown): Container =>
  (Array.isArray(value) ? [...(value as unknown[])] : { ...(value as object) }) as Container;

function applyOne(container: Container, key: string | number, op: string, value: unknown): void {
  if (!Array.isArray(container) || key === "length") {
    if (op === "remove") Reflect.deleteProperty(container, key);
    else container[key] = value;
  } else if (op === "replace") container[Number(key)] = value;
  else if (op === "add") container.splice(Number(key), 0, value);
  else container.splice(Number(key), 1);
}

/**
 * Returns the state after patches. Unchanged parts are shared with the previous state, and new values are
 * stored without a copy, because states never change. The cost does not depend on the size of the state or of
 * the values.
 */
export function applyPatches<State extends object>(state: State, patches: Patches): State {
  const root = { state } as Container;
  const own = new Set<unknown>([root]);
  for (const { op, path, value } of patches) {
    const steps: (string | number)[] = ["state", ...(Array.isArray(path) ? path : path.split("/").slice(1))];
    const last = steps.pop() ?? "state";
    let container = root;
    for (const step of steps) {
      const inner = container[step];
      const mine = own.has(inner) ? (inner as Container) : copyOf(inner);
      own.add(mine);
      container[step] = mine;
      container = mine;
    }
    applyOne(container, last, op, value);
  }
  return root["state"] as State;
}
