/** The values at the nodes and of the elements of a mesh, as a list of fields. */
import type { Mesh } from "./mesh.js";
import type { FieldValues } from "./solution.js";

/** Returns the fields of a mesh, those at the nodes first. */
export const fieldsOf = ({
  nodeData,
  elementData = new Map(),
}: Pick<Mesh, "nodeData" | "elementData">): (FieldValues & { readonly name: string })[] => [
  ...Array.from(nodeData, ([name, data]) => ({ ...data, name })),
  ...Array.from(elementData, ([name, data]) => ({ ...data, name, isPerElement: true })),
];

/** Returns fields in the form in which a mesh has them. */
export function dataOf(fields: readonly FieldValues[]): Required<Pick<Mesh, "nodeData" | "elementData">> {
  const data = (ofElements: boolean): Mesh["nodeData"] =>
    new Map(
      fields
        .filter(({ isPerElement = false }) => isPerElement === ofElements)
        .map(({ name = "", components, values }) => [name, { components, values }]),
    );
  return { nodeData: data(false), elementData: data(true) };
}
