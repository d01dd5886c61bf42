import { bodyOfPatch } from "../../document/entities";
import { FieldRow } from "../../ui/fields/field-row";
import { strings } from "../../strings";
import { useProject } from "../shared/app-context";
import { SplitSection } from "./body-patches";
import { EntityChips } from "../shared/entity-chips";

/** The body that a patch belongs to. */
export function BodyPatchCard({ patch }: { readonly patch: number }) {
  const project = useProject();
  const body = bodyOfPatch(project, patch);
  if (!body) return null;
  return (
    <>
      <FieldRow label={strings.bodies.patchOf}>
        <EntityChips entities={[{ kind: "body", id: body.id }]} project={project} paddingTop={5} />
      </FieldRow>
      <SplitSection key={patch} body={body} patch={patch} />
    </>
  );
}
