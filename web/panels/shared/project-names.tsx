import type { ReactNode } from "react";
import { parameterValues } from "../../expressions/parameters";
import { NamedNumbersContext } from "../../ui/fields/named-numbers";
import { useDocument } from "./app-context";

/** Lets all fields use the parameters of the project. */
export function ProjectNames({ children }: { readonly children: ReactNode }) {
  const parameters = useDocument((state) => state.history.present.project.parameters);
  return <NamedNumbersContext value={parameterValues(parameters)}>{children}</NamedNumbersContext>;
}
