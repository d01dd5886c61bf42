import { projectNamer, type Diagnostic, type Project, type ProjectLine } from "tetrafront";

/** Lines named in the sentence; the others are only counted. */
const namedLines = 4;

/** Equal for lines between the same two points, whichever way they run. */
function endsKey({ points }: ProjectLine): string {
  return [points.at(0), points.at(-1)].sort((a = 0, b = 0) => a - b).join(" ");
}

function countEach<Value>(values: readonly Value[]): ReadonlyMap<Value, number> {
  const counts = new Map<Value, number>();
  for (const value of values) counts.set(value, (counts.get(value) ?? 0) + 1);
  return counts;
}

/**
 * The lines with a patch on one side only, as one finding: known from the loops alone, long before a
 * run looks for open edges. A line that shares both its ends with another is given the benefit of the
 * doubt, for the two may lie in the same place. Time grows with the number of lines.
 */
export function findOpenLines(project: Project): readonly Diagnostic[] {
  const uses = countEach(project.patches.flatMap(({ loops }) => loops.flat().map(Math.abs)));
  const alike = countEach(project.lines.map(endsKey));
  const name = projectNamer(project);
  const open = project.lines.flatMap((line, index) =>
    uses.get(line.id) === 1 && alike.get(endsKey(line)) === 1 ? [name("line", index)] : [],
  );
  if (open.length === 0) return [];
  const named = open.slice(0, namedLines).map(({ label }) => label);
  const more = open.length > named.length ? ` and ${open.length - named.length} more` : "";
  return [
    {
      code: "open-edge",
      severity: "error",
      message: `The surface is not closed: only one patch uses ${named.join(", ")}${more}`,
      remedy: "Add the patch that is missing there, or let its neighbour use the same line.",
      entities: open,
      values: [open.length],
    },
  ];
}
