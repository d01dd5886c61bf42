import type { ReactNode } from "react";
import { projectNumbers } from "../../document/length-units";
import { NamedNumbersContext } from "../../ui/fields/named-numbers";
import { useDocument } from "./app-context";

/** Lets all fields use the parameters of the project. */
export function ProjectNames({ children }: { readonly children: ReactNode }) {
  const parameters = useDocument((state) => state.history.present.project.parameters);
  const units = useDocument((state) => state.history.present.project.units);
  return <NamedNumbersContext value={projectNumbers({ parameters, units })}>{children}</NamedNumbersContext>;
}
