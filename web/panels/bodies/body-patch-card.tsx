import { useMemo } from "react";
import type { ProjectBody } from "tetrafront/project";
import { bodyOfPatch } from "../../document/entities";
import { patchFacts } from "../../document/patch-facts";
import { Facts } from "../../ui/facts";
import { FieldRow } from "../../ui/fields/field-row";
import { SectionTitle } from "../../ui/frames/section-title";
import { formatCount, formatPosition, formatMeasure } from "../../strings/format";
import { strings } from "../../strings";
import { useProject } from "../shared/app-context";
import { SplitSection } from "./body-patches";
import { EntityChips } from "../shared/entity-chips";
import { useBody } from "./use-body";

const texts = strings.bodies;

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
      <GivenFacts body={body} patch={patch} />
      <SplitSection key={patch} body={body} patch={patch} />
    </>
  );
}

/** The given triangles of a patch: number, area, and normal if they are planar. */
function GivenFacts({ body, patch }: { readonly body: ProjectBody; readonly patch: number }) {
  const { units } = useProject();
  const loaded = useBody(body.id)?.loaded;
  const facts = useMemo(() => {
    const index = body.patches.findIndex(({ id }) => id === patch);
    return loaded && patchFacts(loaded.surface, index, body.placement);
  }, [loaded, body, patch]);
  if (!facts) return null;
  const { triangles, area, normal } = facts;
  return (
    <section data-testid="body-patch-facts">
      <SectionTitle>{texts.given}</SectionTitle>
      <Facts>
        <dt>{texts.triangles}</dt>
        <dd>{formatCount(triangles)}</dd>
        <dt>{texts.area}</dt>
        <dd>{formatMeasure(area, units, 2)}</dd>
        <dt>{texts.normal}</dt>
        <dd>{normal ? formatPosition(normal) : texts.notPlanar}</dd>
      </Facts>
    </section>
  );
}
