/** Projects made of shapes of the app, for tests. */
import type { Project } from "tetrafront/project";
import { emptyProject } from "../../web/document/create";
import { insertInto, insertion } from "../../web/document/insert-shape";
import type { Shape } from "../../web/document/shape";

/** Returns a project with shapes, inserted one after the other and joined, and a uniform element size. */
export function projectOf(shapes: readonly Shape[], size: number): Project {
  const empty = { ...emptyProject("Pieces"), meshing: { size } };
  return shapes.reduce<Project>((project, shape) => {
    const lists = { points: [...project.points], lines: [...project.lines], patches: [...project.patches] };
    insertInto(lists, insertion(project, shape, { join: true }));
    return { ...project, ...lists };
  }, empty);
}

/** Returns a shape moved by an offset. */
export function moved(shape: Shape, [dx, dy, dz]: readonly [number, number, number]): Shape {
  return { ...shape, points: shape.points.map(([x, y, z]) => [x + dx, y + dy, z + dz]) };
}
