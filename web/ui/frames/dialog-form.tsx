import { Button, type ButtonProps } from "@mantine/core";
import {
  createContext,
  useContext,
  useEffect,
  useLayoutEffect,
  useMemo,
  useRef,
  type MouseEvent,
  type ReactNode,
  type RefObject,
} from "react";
import { flushSync } from "react-dom";

/** A field whose text may be incomplete or invalid. */
export interface FormField {
  /** Takes the text as the value. Returns false, and shows the reason, if it is invalid. */
  readonly commit: () => boolean;
  readonly focus: () => void;
}

interface Form {
  /** Registers a field. Returns a function that removes it. */
  readonly add: (field: RefObject<FormField>) => () => void;
  /** Commits all fields. If all are valid, applies the form; else moves the focus to the first invalid one. */
  readonly apply: (action: string) => void;
}

const FormContext = createContext<Form | null>(null);

export interface DialogFormProps {
  /** Called with the values of all fields committed. `action` names the button; "apply" stands for Enter too. */
  readonly onApply: (action: string) => void;
  readonly children: ReactNode;
}

/** A form that cannot be applied while one of its fields is invalid. Enter in a field applies it. */
export function DialogForm({ onApply, children }: DialogFormProps) {
  const latest = useRef(onApply);
  useLayoutEffect(() => {
    latest.current = onApply;
  });
  const form = useMemo<Form>(() => {
    const fields = new Set<RefObject<FormField>>();
    return {
      add: (field) => {
        fields.add(field);
        return () => void fields.delete(field);
      },
      apply: (action) => {
        // The owner of the form renders with the new values before it is asked to apply them.
        const invalid = flushSync(() => [...fields].filter(({ current }) => !current.commit()));
        if (invalid[0]) invalid[0].current.focus();
        else latest.current(action);
      },
    };
  }, []);
  return (
    <FormContext value={form}>
      <form
        noValidate
        onSubmit={(event) => {
          event.preventDefault();
          form.apply("apply");
        }}
      >
        {children}
      </form>
    </FormContext>
  );
}

/** Makes a field part of the form around it, if there is one. */
export function useFormField(field: FormField): void {
  const form = useContext(FormContext);
  const latest = useRef(field);
  useLayoutEffect(() => {
    latest.current = field;
  });
  useEffect(() => form?.add(latest), [form]);
}

export interface ApplyButtonProps extends ButtonProps {
  /** Omitted for the button that Enter stands for. */
  readonly action?: string;
  readonly "data-testid"?: string;
}

/** Keeps the focus in the field until the click: leaving the field may show a reason and move the button away. */
const keepFocus = (event: MouseEvent): void => event.preventDefault();

/** A button that applies the form around it. */
export function ApplyButton({ action, ...others }: ApplyButtonProps) {
  const form = useContext(FormContext);
  const props = { size: "xs", onMouseDown: keepFocus, ...others };
  if (action === undefined) return <Button type="submit" {...props} />;
  return <Button variant="default" onClick={() => form?.apply(action)} {...props} />;
}
