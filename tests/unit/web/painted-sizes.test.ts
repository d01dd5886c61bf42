import { createBody, parseProject, type Project, type ProjectSource } from "tetrafront/project";
import { describe, expect, it } from "vitest";
import { setPlacement } from "../../../web/document/body-edits";
import { deleteEntities } from "../../../web/document/edits";
import { carried, placed, rotationOf } from "../../../web/document/placement";
import { withoutBodies } from "../../../web/document/painted-sizes";
import type { Position } from "../../../web/document/position";
import { offerCopies } from "../../../web/document/transforms/copies";
import { offerTransform } from "../../../web/document/transforms/transform";
import { translation } from "../../../web/document/transforms/affine";
import { DocumentStore } from "../../../web/session/document-store";
import { cubeProject } from "../../support/projects";
import { sphereSurface } from "../../support/surfaces";

const surface = sphereSurface(16);
const own: Position = [0.25, 0.5, -1];
const first = { position: [1, 2, 3], rotation: rotationOf([10, 20, 30]), scale: 2 } as const;
const then = { position: [-4, 0, 9], rotation: rotationOf([-70, 5, 110]), scale: 3 } as const;

function project(): Project {
  const body = { ...createBody(surface, { id: 3, firstPatchId: 20, name: "ball" }), placement: first };
  const sources: ProjectSource[] = [
    { id: 1, type: "point", positions: [placed(own, first)], size: 0.2, distance: 0.5, body: 3 },
    { id: 2, type: "point", positions: [[1, 1, 1]], size: 0.2 },
  ];
  return { ...cubeProject(), bodies: [body], background: { nodes: [], tetrahedra: [], sources } };
}

const sourcesOf = ({ background }: Project) => background.sources ?? [];
const close = (actual: Position | undefined, expected: Position) =>
  expected.forEach((value, k) => expect(actual?.[k]).toBeCloseTo(value, 12));

describe("sizes painted on a body", () => {
  it("follow a new placement in the same step of undo; other sources stay", () => {
    const documents = new DocumentStore(project(), () => 0);
    documents.edit(setPlacement(3, then));
    const [painted, other] = sourcesOf(documents.project);
    close(painted?.positions[0], placed(own, then));
    expect(painted?.size).toBeCloseTo(0.3, 12);
    expect(painted?.distance).toBeCloseTo(0.75, 12);
    expect(other).toEqual(sourcesOf(project())[1]);
    documents.undo();
    expect(documents.project).toEqual(project());
    documents.redo();
    close(sourcesOf(documents.project)[0]?.positions[0], placed(own, then));
  });

  it("follow each update of a drag from where they began", () => {
    const documents = new DocumentStore(project(), () => 0);
    const gesture = documents.begin("Move body 3");
    for (const x of [1, 5, 7]) gesture.update(setPlacement(3, { ...then, position: [x, 0, 9] }));
    gesture.commit();
    close(sourcesOf(documents.project)[0]?.positions[0], placed(own, { ...then, position: [7, 0, 9] }));
    expect(documents.state.getState().history.past).toHaveLength(1);
  });

  it("follow a parameter that the placement depends on", () => {
    const start: Project = {
      ...project(),
      parameters: [{ name: "lift", expression: "3" }],
      expressions: [{ kind: "body", id: 3, field: "placement.position.2", expression: "lift" }],
    };
    const documents = new DocumentStore(start, () => 0);
    documents.edit({
      label: "Set parameter",
      replace: { parameters: [{ name: "lift", expression: "8" }] },
    });
    const [x, y] = placed(own, first);
    close(sourcesOf(documents.project)[0]?.positions[0], [x, y, placed(own, first)[2] + 5]);
  });

  it("move once with a body that is transformed, selected or not", () => {
    for (const ids of [[], [1]]) {
      const documents = new DocumentStore(project(), () => 0);
      const selection = [
        { kind: "body", id: 3 } as const,
        ...ids.map((id) => ({ kind: "source", id }) as const),
      ];
      const offer = offerTransform(project(), selection, translation([0, 0, 5]), {
        label: "Move",
        join: false,
      });
      if (!offer.possible) throw new Error(offer.reason);
      documents.edit(offer.creation.edit);
      const [x, y, z] = placed(own, first);
      close(sourcesOf(documents.project)[0]?.positions[0], [x, y, z + 5]);
    }
  });

  it("are copied with the body and belong to the copy", () => {
    const documents = new DocumentStore(project(), () => 0);
    const offer = offerCopies(project(), [{ kind: "body", id: 3 }], [translation([0, 0, 5])], {
      label: "Copy",
      join: false,
    });
    if (!offer.possible) throw new Error(offer.reason);
    expect(offer.creation.entities).toEqual([{ kind: "body", id: 4 }]);
    documents.edit(offer.creation.edit);
    const [original, , copy] = sourcesOf(documents.project);
    expect(original).toEqual(sourcesOf(project())[0]);
    const [x, y, z] = placed(own, first);
    expect(copy?.body).toBe(4);
    close(copy?.positions[0], [x, y, z + 5]);
    documents.edit(setPlacement(4, first));
    close(sourcesOf(documents.project)[2]?.positions[0], placed(own, first));
  });

  it("are deleted with the body, and stay without it if the body is replaced", () => {
    const documents = new DocumentStore(project(), () => 0);
    documents.edit(deleteEntities(project(), [{ kind: "body", id: 3 }]));
    expect(sourcesOf(documents.project).map(({ id }) => id)).toEqual([2]);
    documents.undo();
    expect(documents.project).toEqual(project());
    documents.edit({ label: "Union", replace: { bodies: [] } });
    const { body: _, ...painted } = sourcesOf(project())[0] ?? { body: 0 };
    expect(sourcesOf(documents.project)[0]).toEqual(painted);
  });
});

describe("a point carried with a body", () => {
  it("ends where the new placement puts its given point", () => {
    close(carried(placed(own, first), first, then), placed(own, then));
    close(carried(own, undefined, then), placed(own, then));
    close(carried(placed(own, then), then), own);
  });

  it("stay, in a valid project, if a question leaves the body out", () => {
    const member = { kind: "body", id: 3 } as const;
    const grouped = { ...project(), groups: [{ id: 1, name: "g", members: [member] }] };
    const rest = withoutBodies(grouped, new Set([3]));
    expect(parseProject(rest)).toMatchObject({ success: true });
    expect([rest.bodies, rest.groups?.[0]?.members]).toEqual([[], []]);
    expect(sourcesOf(rest).map(({ id, body }) => [id, body])).toEqual([
      [1, undefined],
      [2, undefined],
    ]);
  });
});
