import type { ProjectBody } from "tetrafront/project";
import { setBodyUnit, setProjectUnit, unitOf, unitOfBody } from "../../document/length-units";
import { strings } from "../../strings";
import { useApp, useProject } from "../shared/app-context";
import { UnitSelect } from "../shared/unit-select";

/** The unit of the coordinates in the file of a body. In a project without a unit, it becomes that of the project. */
export function BodyUnit({ body }: { readonly body: ProjectBody }) {
  const app = useApp();
  const units = unitOf(useProject().units);
  return (
    <UnitSelect
      label={strings.units.ofFile}
      value={units ? (unitOfBody(body, units) ?? null) : null}
      without={units ? null : strings.units.unknown}
      testId="body-unit"
      onChange={(unit) => {
        if (unit) app.documents.edit(units ? setBodyUnit(body, unit, units) : setProjectUnit(unit));
      }}
    />
  );
}
