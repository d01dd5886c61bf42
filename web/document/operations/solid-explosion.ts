import type { DrawnSolid } from "tetrafront/internal";
import type { Project, ProjectBody, ProjectGroup } from "tetrafront/project";
import { operationStrings } from "../../strings";
import type { Offer } from "../create";
import { bodiesOf } from "../entities";
import { insertion, mainEntities, withInsertion } from "../insert-shape";
import { withHeirs } from "../patch-heirs";
import type { Shape } from "../shape";
import { faceLabel } from "./feature-names";
import type { Operation } from "./operation";
import { solidIn, withoutPlacement, type Solid } from "./solids";

const texts = operationStrings.solids.exploded;

/** Makes a solid the lines and patches that its faces are, or are near to. */
export const explode: Operation<Record<never, never>> = {
  id: "solid-explode",
  title: texts.title,
  step: texts.step,
  action: operationStrings.apply,
  usesSelection: true,
  initial: () => ({}),
  fields: () => [],
  make: () => ({ possible: false, reason: texts.noSolid }),
  makeLater: (subject, _values, solids) => {
    const solid = solidIn(subject);
    if (!solid) return null;
    return Promise.resolve(withoutPlacement(solid))
      .then(({ features }) => solids.drawn(features))
      .then((drawn) => offered(subject.project, solid, drawn));
  },
};

function offered(project: Project, solid: Solid, { drawing, faces, failures }: DrawnSolid): Offer {
  if (!drawing)
    return {
      possible: false,
      reason: failures.map(({ message, remedy }) => `${message} ${remedy}`).join(" "),
    };
  const patchOf = new Map(solid.patches.map((patch) => [patch.origin, patch]));
  const originOf = (face: number): string => faces[face] ?? "";
  const nameOf = (face: number): string =>
    patchOf.get(originOf(face))?.name ?? faceLabel(solid.features, originOf(face));
  if (drawing.left.length > 0) return { possible: false, reason: texts.left(drawing.left.map(nameOf)) };
  const pieces = new Map<number, number>();
  for (const { face } of drawing.patches) pieces.set(face, (pieces.get(face) ?? 0) + 1);
  const numbers = new Map<number, number>();
  const shape: Shape = {
    points: drawing.points,
    lines: drawing.lines,
    patches: drawing.patches.map(({ type, loops, face }) => {
      const number = (numbers.get(face) ?? 0) + 1;
      numbers.set(face, number);
      const name = pieces.get(face) === 1 ? nameOf(face) : `${nameOf(face)} ${number}`;
      return { type, loops, name };
    }),
  };
  const made = insertion(project, shape, { join: false });
  const newPatches = new Map<number, number[]>();
  drawing.patches.forEach(({ face }, p) => {
    const old = patchOf.get(originOf(face))?.id;
    const id = made.patchIds[p];
    if (old !== undefined && id !== undefined) newPatches.set(old, [...(newPatches.get(old) ?? []), id]);
  });
  const edit = {
    label: texts.step,
    replace: { ...withInsertion(project, made), ...othersOf(project, solid, newPatches) },
  };
  return {
    possible: true,
    creation: { entities: mainEntities(made), edit, note: noteOf(drawing, solid, nameOf) },
  };
}

/** Returns the rest of a project without a solid: groups and conditions with its new patches, sizes painted on it as sources of their own. */
function othersOf(project: Project, { id }: ProjectBody, newPatches: ReadonlyMap<number, readonly number[]>) {
  const { background, problem } = project;
  const all = [...newPatches.keys()].map((patch) => ({ kind: "patch", id: patch }) as const);
  const membersOf = ({ members }: ProjectGroup): ProjectGroup["members"] =>
    members.flatMap((member) => (member.kind === "body" && member.id === id ? all : [member]));
  const groups = project.groups?.map((group) => ({ ...group, members: membersOf(group) }));
  const sources = background.sources?.map(({ body, ...source }) =>
    body === undefined || body === id ? source : { ...source, body },
  );
  return {
    bodies: bodiesOf(project).filter((body) => body.id !== id),
    background: { ...background, ...(sources && { sources }) },
    ...withHeirs({ groups, problem }, newPatches),
  };
}

function noteOf(
  { patches }: NonNullable<DrawnSolid["drawing"]>,
  solid: Solid,
  nameOf: (face: number) => string,
): string {
  const facesThat = (isExact: boolean): number[] => [
    ...new Set(patches.flatMap((patch) => (patch.isExact === isExact ? [patch.face] : []))),
  ];
  const [exact, near] = [facesThat(true), facesThat(false)];
  return [
    exact.length > 0 ? texts.exact(exact.length) : "",
    near.length > 0 ? texts.near(near.map(nameOf)) : "",
    texts.forgotten,
    solid.remeshing || solid.patches.some(({ color }) => color !== undefined) ? texts.noPlace : "",
  ]
    .filter((sentence) => sentence !== "")
    .join(" ");
}
