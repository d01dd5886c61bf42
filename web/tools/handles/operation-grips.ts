import type { OperationHandle } from "../../document/operations/operation";
import type { Position } from "../../document/position";
import { addScaled, distance, dot, subtract } from "../../document/vectors";
import { roundTo } from "../../document/work-plane";
import type { OpenOperation, Operations } from "../../session/operations";
import { strings } from "../../strings";
import { formatPosition } from "../../strings/format";
import { onGrid, type Grips } from "./grips";

/** Smallest distance of a grip from the beginning of its line, in CSS pixels. */
const leastPixels = 26;

/**
 * Returns the grips of the open operation; null if it has none. They change its values, as its fields do. `pixel`: length of
 * a CSS pixel.
 */
export function operationGrips(operations: Operations, pixel: number): Grips | null {
  const { open } = operations.state.getState();
  const handles = open?.operation.handles?.(open.values) ?? [];
  if (!open || handles.length === 0) return null;
  const positions = handles.map((handle) => shownAt(handle, leastPixels * pixel));
  return {
    glyphs: [],
    grips: handles.map((handle, index) => ({
      from: handle.from,
      position: positions[index] ?? handle.from,
      moves: handle.along ?? "work-plane",
      label: labelOf(open, handle),
    })),
    begin: (index) => {
      const [handle, position] = [handles[index], positions[index]];
      if (!handle || !position) return null;
      const before = open.values[handle.key];
      if (before === undefined) return null;
      return {
        moveTo: (to, step) => {
          const value =
            typeof before === "number"
              ? lengthAt(handle, before, subtract(to, position), step)
              : positionAt(handle, onGrid(to, position, step));
          if (isValid(open, handle, value)) operations.set(handle.key, value);
        },
        commit: () => undefined,
        cancel: () => operations.set(handle.key, before),
      };
    },
  };
}

function labelOf({ operation, values, subject }: OpenOperation, { key }: OperationHandle): string {
  const field = operation.fields(values, subject).find((one) => one.key === key);
  const value = values[key];
  const numbers = typeof value === "number" ? [value] : typeof value === "object" ? value : [];
  return strings.drawing.grip(field?.label ?? "", formatPosition(numbers));
}

/** A handle of a short length is drawn beside its line, where it can be seen and taken. */
function shownAt({ from, position, along }: OperationHandle, least: number): Position {
  return along && distance(from, position) < least ? addScaled(from, along, least) : position;
}

function lengthAt({ along, rate }: OperationHandle, before: number, moved: Position, step: number): number {
  const value = before + rate * dot(moved, along ?? moved);
  return step > 0 ? roundTo(value, step) : value;
}

const positionAt = ({ valueAt }: OperationHandle, position: Position): Position =>
  valueAt?.(position) ?? position;

/** Returns whether the field of a handle takes a value. Otherwise, the value before is kept. */
function isValid(
  { operation, values, subject }: OpenOperation,
  handle: OperationHandle,
  value: number | Position,
): boolean {
  const field = operation.fields(values, subject).find(({ key }) => key === handle.key);
  return field?.kind !== "number" || typeof value !== "number" || (field.refuse?.(value) ?? null) === null;
}
