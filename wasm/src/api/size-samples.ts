/** Samples the sizes of a project before it is meshed. */
import type { EngineClient } from "../engine/engine-client.js";
import type { RunControl } from "../engine/control.js";
import { refuse } from "../diagnostics/mesher-error.js";
import { projectArrays } from "../project/arrays.js";
import { withNodes } from "../project/grid-arrays.js";
import type { Project } from "../project/project-types.js";
import { joinedBodies } from "./body-preparation.js";
import { checkPositions, checkProject } from "./input-checks.js";
import type { SizeSamples } from "./mesher-interface.js";
import type { ProjectMeshOptions } from "./option-types.js";
import { checkOptions, checkProjectOptions, engineOptions, withSettings } from "./mesh-options.js";

/** Implements `Mesher.sampleSizes`. */
export async function sampleSizes(
  client: EngineClient,
  project: Project,
  positions: Float64Array,
  options: ProjectMeshOptions,
  control: RunControl,
): Promise<SizeSamples> {
  refuse([...checkProject(project), ...checkPositions(positions), ...checkProjectOptions(options)]);
  const { preparedBodies: known = [], elementOrder: _, ...own } = options;
  const settled = withSettings(own, project);
  refuse(checkOptions(settled));
  const { bodies = [] } = project;
  const present = new Set(bodies.map(({ id }) => id));
  const prepared = known.filter(({ body }) => present.has(body));
  const drawn = projectArrays(project);
  const { background } = settled;
  const grid = background === undefined ? drawn.grid : withNodes(drawn.grid, background);
  const bodySurfaces = joinedBodies(project, prepared);
  const given = [drawn.model, bodySurfaces, grid, engineOptions(settled), positions.slice()] as const;
  const { sizes, tetrahedra } = await client.ask("sampleSizes", given, control);
  const isComplete = tetrahedra > 0 && prepared.length === bodies.length;
  return { sizes, tetrahedra: isComplete ? Math.round(tetrahedra) : null };
}
