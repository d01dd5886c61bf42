import type { Project, ProjectSource } from "tetrafront/project";
import { templateStrings } from "../strings";
import { emptyProject } from "./create";
import { insertion, withInsertion } from "./insert-shape";
import { box } from "./pieces/box";
import { cylinder } from "./pieces/cylinder";
import { sphere } from "./pieces/sphere";
import { wing } from "./pieces/wing";
import type { Position } from "./position";
import { placedIn, type Shape } from "./shape";
import { worldFrame } from "./vectors";

/** A project to begin with. */
export interface Template {
  readonly id: keyof typeof templateStrings.templates;
  readonly make: () => Project;
}

const at = (shape: Shape, origin: Position): Shape => placedIn(shape, { ...worldFrame, origin });

/** A part of a template, whose patches get a name in front of theirs. */
interface Part {
  readonly name: string;
  readonly shape: Shape;
}

/** Returns a project with closed shapes: those inside another one are cavities. */
function projectOf(
  id: Template["id"],
  size: number,
  parts: readonly Part[],
  sources: readonly ProjectSource[] = [],
): Project {
  const empty: Project = { ...emptyProject(templateStrings.templates[id].title), meshing: { size } };
  const drawn = parts.reduce<Project>((project, { name, shape }) => {
    const patches = shape.patches.map((patch) => ({ ...patch, name: `${name} ${patch.name ?? ""}`.trim() }));
    return {
      ...project,
      ...withInsertion(project, insertion(project, { ...shape, patches }, { join: true })),
    };
  }, empty);
  return sources.length > 0
    ? { ...drawn, background: { ...drawn.background, sources: [...sources] } }
    : drawn;
}

const names = templateStrings.parts;

/** Projects to begin with, the simplest first. */
export const templates: readonly Template[] = [
  { id: "empty", make: () => emptyProject() },
  { id: "box", make: () => projectOf("box", 0.2, [{ name: names.box, shape: box(1, 1, 1) }]) },
  {
    id: "sphere-in-box",
    make: () =>
      projectOf(
        "sphere-in-box",
        0.4,
        [
          { name: names.channel, shape: at(box(4, 4, 4), [0, 0, -2]) },
          { name: names.sphere, shape: sphere(0.5) },
        ],
        [{ id: 1, type: "point", positions: [[0, 0, 0]], size: 0.15, distance: 0.5, growth: 0.3 }],
      ),
  },
  {
    id: "cylinder-in-box",
    make: () =>
      projectOf(
        "cylinder-in-box",
        0.4,
        [
          { name: names.channel, shape: at(box(6, 3, 2), [1, 0, 0]) },
          { name: names.cylinder, shape: at(cylinder(0.5, 0.5, 1), [0, 0, 0.5]) },
        ],
        [
          {
            id: 1,
            type: "segment",
            positions: [
              [0, 0, 0.5],
              [0, 0, 1.5],
            ],
            size: 0.15,
            distance: 0.6,
            growth: 0.3,
          },
        ],
      ),
  },
  {
    id: "wing-in-box",
    make: () =>
      projectOf(
        "wing-in-box",
        0.5,
        [
          { name: names.channel, shape: at(box(6, 4, 4), [0.5, 0, -1]) },
          {
            name: names.wing,
            shape: wing({ digits: 12, chord: 1, tipChord: 0.6, span: 2, sweep: 15, twist: 0 }),
          },
        ],
        [
          {
            id: 1,
            type: "segment",
            positions: [
              [0, 0, 0],
              [0.536, 0, 2],
            ],
            size: 0.04,
            distance: 0.05,
            growth: 0.25,
          },
          {
            id: 2,
            type: "segment",
            positions: [
              [1, 0, 0],
              [1.136, 0, 2],
            ],
            size: 0.04,
            distance: 0.05,
            growth: 0.25,
          },
        ],
      ),
  },
];
