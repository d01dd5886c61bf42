import { Button, Text } from "@mantine/core";
import { IconPlayerPlayFilled } from "@tabler/icons-react";
import type { SurfaceInspection } from "tetrafront";
import type { ProjectBody } from "tetrafront/project";
import { runNamed } from "../../commands/registry";
import { withTreatmentAfter } from "../../document/body-repair";
import { entityKey } from "../../document/entities";
import { touchingCode } from "../../document/validate";
import { canBeFilled, isFillable } from "../../session/bodies";
import { Facts } from "../../ui/facts";
import { SectionTitle } from "../../ui/frames/section-title";
import { formatCount, formatMeasure, formatShort } from "../../strings/format";
import { planText, strings } from "../../strings";
import { ratioMeanings } from "../../strings/ratio-meanings";
import { Explained } from "../../ui/explained";
import { useApp, useProblems, useProject, useRun } from "../shared/app-context";
import { BrushSection } from "./body-brush";
import { SplitSection } from "./body-patches";
import { BodyPlacementFields } from "./body-placement";
import { BodyPreview } from "./body-preview";
import { BodyProblems } from "./body-problems";
import { BodyRepairs } from "./body-repairs";
import { BodyTreatment } from "./body-treatment";
import { BodyUnit } from "./body-unit";
import { isSolid } from "../../document/operations/solids";
import { FeatureList } from "./feature-list";
import styles from "./bodies.module.css";
import { useBody } from "./use-body";

const texts = strings.bodies;

/** What a body is, what is wrong with it, and what meshing will do with it. */
export function BodyCard({ body }: { readonly body: ProjectBody }) {
  const state = useBody(body.id);
  return (
    <div data-testid="body-card">
      {state?.failure != null && (
        <Text size="sm" c="var(--tf-error)" role="alert">
          {state.failure}
        </Text>
      )}
      {state?.inspection ? (
        <BodyFacts body={body} inspection={state.inspection} />
      ) : (
        state?.failure == null && (
          <Text size="sm" c="dimmed" role="status">
            {texts.inspecting}
          </Text>
        )
      )}
      {isSolid(body) && <FeatureList solid={body} />}
      {!isSolid(body) && (
        <div className={styles["unit"]}>
          <BodyUnit body={body} />
        </div>
      )}
      {state?.inspection && <BodyProblems body={body} inspection={state.inspection} />}
      <BodyRepairs body={body} />
      <BodyTreatment body={body} />
      <BodyPreview body={body} />
      <PlanLine body={body} />
      <GenerateButton isPossible={state !== undefined && canBeFilled(state)} />
      {!isSolid(body) && <SplitSection body={body} patch={null} />}
      <BrushSection body={body} />
      <BodyPlacementFields body={body} />
    </div>
  );
}

interface BodyFactsProps {
  readonly body: ProjectBody;
  readonly inspection: SurfaceInspection;
}

/** The size and the parts of the given surface. */
function BodyFacts({ body, inspection }: BodyFactsProps) {
  const { units = "" } = useProject();
  const { box, triangles, nodes, openEdges, regions, cavities, volume, area, worst } = inspection;
  const { scale = 1 } = body.placement ?? {};
  const extents = box ? box.high.map((high, k) => scale * (high - (box.low[k] ?? 0))) : [];
  const shells = [formatCount(inspection.shells.length), cavities > 0 && texts.cavities(cavities)];
  return (
    <>
      <SectionTitle>{isSolid(body) ? texts.solid : texts.shape}</SectionTitle>
      <Facts>
        <dt>{texts.box}</dt>
        <dd data-testid="body-size">
          {extents.map(formatShort).join(" × ")} {units}
        </dd>
        {!isSolid(body) && (
          <>
            <dt>{texts.triangles}</dt>
            <dd data-testid="body-triangles">{formatCount(triangles)}</dd>
            <dt>{texts.nodes}</dt>
            <dd>{formatCount(nodes)}</dd>
          </>
        )}
        {inspection.isFillable ? (
          <>
            <dt>{texts.shells}</dt>
            <dd data-testid="body-shells">{shells.filter((text) => text !== false).join(", ")}</dd>
            {regions > 1 && (
              <>
                <dt>{texts.regions}</dt>
                <dd>{formatCount(regions)}</dd>
              </>
            )}
            <dt>{texts.volume}</dt>
            <dd data-testid="body-volume">{formatMeasure(volume * scale ** 3, units, 3)}</dd>
          </>
        ) : (
          <>
            <dt>{texts.area}</dt>
            <dd>{formatMeasure(area * scale ** 2, units, 2)}</dd>
            {openEdges > 0 && (
              <>
                <dt>{texts.shells}</dt>
                <dd>{texts.open(openEdges)}</dd>
              </>
            )}
          </>
        )}
        <dt>{texts.patches}</dt>
        <dd data-testid="body-patches">{formatCount(body.patches.length)}</dd>
        {worst[0] && !isSolid(body) && (
          <>
            <dt>
              <Explained name={texts.worst} meaning={ratioMeanings.triangle} />
            </dt>
            <dd>{formatShort(worst[0].radiusRatio)}</dd>
          </>
        )}
      </Facts>
    </>
  );
}

/** Says what a run will do with the body. */
function PlanLine({ body }: { readonly body: ProjectBody }) {
  const state = useBody(body.id);
  const isJoined = useProblems(
    ({ byEntity }) =>
      byEntity.get(entityKey({ kind: "body", id: body.id }))?.some(({ code }) => code === touchingCode) ??
      false,
  );
  if (!state?.inspection || !canBeFilled(state)) return null;
  const isRepaired = !isFillable(state);
  if (isSolid(body) && !isRepaired && !isJoined) return null;
  const after = isRepaired && state.repair ? withTreatmentAfter(state.repair.changes, body) : body;
  const [chosen, repaired] = [body, after].map(({ surface = "remesh" }) => surface);
  return (
    <Text size="xs" c="dimmed" mt={8} data-testid="body-plan">
      {planText({ isRepaired, isJoined, chosen: chosen ?? "remesh", repaired: repaired ?? "remesh" })}
    </Text>
  );
}

function GenerateButton({ isPossible }: { readonly isPossible: boolean }) {
  const app = useApp();
  const busy = useRun((state) => state.busy);
  return (
    <Button
      fullWidth
      size="xs"
      my={10}
      disabled={busy || !isPossible}
      leftSection={<IconPlayerPlayFilled size={13} aria-hidden />}
      data-testid="body-generate"
      onClick={() => runNamed(app, "generate")}
    >
      {texts.generate}
    </Button>
  );
}
