import {
  liveNotes,
  type BodyPlacement,
  type Project,
  type ProjectBody,
  type ProjectSource,
} from "tetrafront/project";
import type { Replacement } from "./edit";
import { bodiesOf } from "./entities";
import { carried } from "./placement";

/**
 * Returns a change that keeps painted sizes on their bodies after a step. A source goes with the body that it was painted
 * on, unless the step has changed the source too. A source whose body is gone stays where it is and belongs to none.
 * Undefined if nothing is to be done. O(bodies + sources).
 */
export function paintedSizes(before: Project, after: Project): Replacement | undefined {
  const { sources } = after.background;
  if (before.bodies === after.bodies || !sources?.some(({ body }) => body !== undefined)) return undefined;
  const byId = (project: Project) => new Map(bodiesOf(project).map((body) => [body.id, body]));
  const [oldBodies, newBodies] = [byId(before), byId(after)];
  const oldSources = new Map((before.background.sources ?? []).map((source) => [source.id, source]));
  const followed = sources.map((source) => {
    if (source.body === undefined) return source;
    const body = newBodies.get(source.body);
    if (!body) return withoutBody(source);
    const oldBody = oldBodies.get(source.body);
    const isUnchanged = oldSources.get(source.id)?.positions === source.positions;
    return oldBody && isUnchanged ? moved(source, oldBody, body) : source;
  });
  const isSame = followed.every((source, s) => source === sources[s]);
  return isSame ? undefined : { replace: { background: { ...after.background, sources: followed } } };
}

/** Returns a project without some of its bodies, and without what it notes about them. Sizes that were painted on them stay. */
export function withoutBodies(project: Project, ids: ReadonlySet<number>): Project {
  const rest = { ...project, bodies: bodiesOf(project).filter(({ id }) => !ids.has(id)) };
  const unpainted = { ...rest, ...paintedSizes(project, rest)?.replace };
  return { ...unpainted, ...liveNotes(unpainted) };
}

function withoutBody({ body: _, ...source }: ProjectSource): ProjectSource {
  return source;
}

function moved(
  source: ProjectSource,
  { placement: from }: ProjectBody,
  { placement: to }: ProjectBody,
): ProjectSource {
  if (from === to || placementKey(from) === placementKey(to)) return source;
  const factor = (to?.scale ?? 1) / (from?.scale ?? 1);
  const { distance } = source;
  return {
    ...source,
    positions: source.positions.map((position) => carried(position, from, to)),
    size: source.size * factor,
    ...(distance !== undefined && { distance: distance * factor }),
  };
}

const placementKey = ({ position, rotation, scale = 1 }: BodyPlacement = {}): string =>
  [...(position ?? [0, 0, 0]), ...(rotation ?? [0, 0, 0, 1]), scale].join(" ");
