import type { Project, ProjectLine, ProjectPreview } from "tetrafront/project";
import type { Position } from "./position";
import { distance } from "./vectors";

/** The course of a line: its positions from start to end. */
export interface LinePath {
  readonly line: ProjectLine;
  readonly positions: readonly Position[];
}

/** A preview by the engine, and the project that it samples. */
interface Sampled {
  readonly samples: ProjectPreview;
  readonly project: Project;
}

/**
 * Returns the course of every line: the exact ends of straight lines, and the engine's samples of all others. A line that
 * has not been sampled yet counts as straight from point to point. O(points and samples).
 */
export function linePaths(project: Project, sampled: Sampled | null): readonly LinePath[] {
  const positionOf = new Map(project.points.map(({ id, position }) => [id, position]));
  const sampledLines = new Map(sampled?.project.lines.map((line, index) => [line, index]));
  return project.lines.map((line) => {
    const index = line.type === "straight" ? undefined : sampledLines.get(line);
    const ofPoints = line.points.map((id) => positionOf.get(id)).filter((position) => position !== undefined);
    if (index === undefined || !sampled) return { line, positions: ofPoints };
    const { lineOffsets, linePoints } = sampled.samples;
    const positions: Position[] = [];
    for (let i = lineOffsets[index] ?? 0; i < (lineOffsets[index + 1] ?? 0); ++i) {
      positions.push([linePoints[3 * i] ?? 0, linePoints[3 * i + 1] ?? 0, linePoints[3 * i + 2] ?? 0]);
    }
    // The preview of a line that the engine rejects is empty.
    return { line, positions: positions.length > 1 ? fromStart(positions, ofPoints) : ofPoints };
  });
}

/** Returns samples in the direction of their line: the engine samples a line from the end with the lower id. */
function fromStart(samples: readonly Position[], points: readonly Position[]): readonly Position[] {
  const [start, first, last] = [points[0], samples[0], samples.at(-1)];
  if (!start || !first || !last) return samples;
  return distance(last, start) < distance(first, start) ? samples.toReversed() : samples;
}
