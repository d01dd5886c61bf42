import { createBody, UNITS, type Project } from "tetrafront";
import { expect, it } from "vitest";
import { emptyProject } from "../../../web/document/create";
import {
  inProjectUnit,
  setBodyUnit,
  setProjectUnit,
  unitFactor,
  unitOfBody,
} from "../../../web/document/length-units";
import { DocumentStore } from "../../../web/session/document-store";
import { boxSurface } from "../../support/surfaces";

/** Metres per unit, from the definitions of the units. */
const metres = { um: 1e-6, mm: 1e-3, cm: 1e-2, m: 1, in: 0.0254, ft: 0.3048 } as const;

const body = createBody(boxSurface(1), { id: 1, firstPatchId: 1, name: "part" });

it("converts between all units", () => {
  for (const from of UNITS) {
    for (const to of UNITS) {
      expect(unitFactor(from, to) / (metres[from] / metres[to])).toBeCloseTo(1, 12);
    }
  }
});

it("scales a body to the unit of the project, and reads the unit from its scale", () => {
  const project: Project = { ...emptyProject(), units: "m", bodies: [body] };
  const documents = new DocumentStore(project);
  const present = () => documents.project.bodies?.[0] ?? body;
  expect(unitOfBody(present(), "m")).toBe("m");
  documents.edit(setBodyUnit(present(), "mm", "m"));
  expect(present().placement).toMatchObject({ scale: 0.001 });
  expect(unitOfBody(present(), "m")).toBe("mm");
  expect(unitOfBody({ ...body, placement: { scale: 0.7 } }, "m")).toBeUndefined();
  documents.undo();
  expect(documents.project).toEqual(project);
});

it("scales imported bodies only if both units are known", () => {
  const made = [{ body }];
  const scaleOf = (unit: string | undefined, units: string | undefined): number | undefined =>
    inProjectUnit(made, unit, { ...emptyProject(), ...(units !== undefined && { units }) })[0]?.body.placement
      ?.scale;
  expect(scaleOf("in", "mm")).toBeCloseTo(25.4, 12);
  expect(scaleOf("mm", "mm")).toBeUndefined();
  expect(scaleOf(undefined, "mm")).toBeUndefined();
  expect(scaleOf("mm", undefined)).toBeUndefined();
  expect(scaleOf("furlong", "mm")).toBeUndefined();
});

it("sets and removes the unit of the project", () => {
  const documents = new DocumentStore(emptyProject());
  documents.edit(setProjectUnit("mm"));
  expect(documents.project.units).toBe("mm");
  documents.edit(setProjectUnit(null));
  expect(documents.project).not.toHaveProperty("units");
});
