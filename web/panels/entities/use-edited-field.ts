import { useEffect, useRef, type RefObject } from "react";
import { useApp, useShell } from "../shared/app-context";

/** Elements that contain the fields of the entity. */
interface EditedFields {
  readonly name: RefObject<HTMLDivElement | null>;
  readonly values: RefObject<HTMLDivElement | null>;
}

/** Moves the focus to the field that the shell asks for, once; to the other one if the entity has no such field. */
export function useEditedField(): EditedFields {
  const { shell } = useApp();
  const editing = useShell((state) => state.editing);
  const name = useRef<HTMLDivElement>(null);
  const values = useRef<HTMLDivElement>(null);
  useEffect(() => {
    if (editing === null) return;
    const [first, second] = editing === "name" ? [name, values] : [values, name];
    const field = inputIn(first.current) ?? inputIn(second.current);
    field?.focus();
    field?.select();
    shell.setState({ editing: null });
  }, [shell, editing]);
  return { name, values };
}

const inputIn = (element: HTMLElement | null): HTMLInputElement | null | undefined =>
  element?.querySelector<HTMLInputElement>("input:not([disabled], [type=hidden])");
