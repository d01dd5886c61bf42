import { LENGTH_UNITS } from "tetrafront";
import { createBody, type Project } from "tetrafront/project";
import { describe, expect, it } from "vitest";
import { formatMeasure } from "../../../web/strings/format";
import { emptyProject } from "../../../web/document/create";
import {
  convertProject,
  hasLengths,
  inProjectUnit,
  projectNumbers,
  setBodyUnit,
  setProjectUnit,
  unitFactor,
  unitOfBody,
} from "../../../web/document/length-units";
import { setParameter } from "../../../web/document/parameters";
import { namesIn, readNumber, unitsIn, withNameReplaced } from "../../../web/expressions/expression";
import { cubeProject } from "../../support/projects";
import { DocumentStore } from "../../../web/session/document-store";
import { boxSurface } from "../../support/surfaces";

/** Metres per unit, from the definitions of the units. */
const metres = { um: 1e-6, mm: 1e-3, cm: 1e-2, m: 1, in: 0.0254, ft: 0.3048 } as const;

const body = createBody(boxSurface(1), { id: 1, firstPatchId: 1, name: "part" });

it("converts between all units", () => {
  for (const from of LENGTH_UNITS) {
    for (const to of LENGTH_UNITS) {
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

describe("expressions with units", () => {
  const named = projectNumbers({ units: "mm", parameters: [{ name: "r", expression: "2 in" }, { name: "m", expression: "7" }] }); // prettier-ignore

  it.each([
    ["1 in", 25.4],
    ["2.5 mm", 2.5],
    ["3ft", 914.4],
    ["1e-3 m", 1],
    ["1/2 in", 12.7],
    ["1 ft + 3 in", 381],
    ["(1 + 1/4) in", 31.75],
    ["2*3 cm - 1 mm", 59],
    ["r", 50.8],
    ["2*m", 14],
    ["m m", 7000],
    ["sqrt(4) cm", 20],
  ])("%s in millimetres", (text, value) => expect(readNumber(text, named)).toBeCloseTo(value, 11));

  it.each(["1 furlong", "in", "1 in in", "mm 1", "1 In"])("rejects %s", (text) =>
    expect(readNumber(text, named)).toBeNull(),
  );

  it("need a unit of the project, and parameters may have the names of units", () => {
    expect(readNumber("1 in", projectNumbers({}))).toBeNull();
    expect([...namesIn("2 m + m*r in")]).toEqual(["m", "r"]);
    expect([...unitsIn("2 m + m*r in")]).toEqual(["m", "in"]);
    expect(withNameReplaced("2 m + m", "m", "q")).toBe("2 m + q");
  });
});

describe("another unit for a project with numbers", () => {
  const project: Project = {
    ...cubeProject(0.5),
    units: "in",
    meshing: { size: 0.25 },
    parameters: [
      { name: "count", expression: "3" },
      { name: "wide", expression: "5.08 cm" },
    ],
    bodies: [{ ...body, placement: { position: [1, 2, 3] }, remeshing: { size: 0.5, featureAngle: 30 } }],
    expressions: [
      { kind: "point", id: 8, field: "position.0", expression: "count/3" },
      { kind: "point", id: 8, field: "position.1", expression: "wide/2" },
      { kind: "point", id: 8, field: "position.2", expression: "25.4 mm" },
      { kind: "meshing", field: "size", expression: "wide/8" },
    ],
  };

  it("converts all lengths and nothing else, and expressions follow", () => {
    const documents = new DocumentStore(project, () => 0);
    const before = documents.project;
    documents.edit(convertProject(documents.project, "in", "mm"));
    const { points, background, meshing, bodies, parameters, units } = documents.project;
    expect(units).toBe("mm");
    points.forEach(({ position }, i) =>
      position.forEach((x, k) => expect(x).toBeCloseTo(25.4 * (project.points[i]?.position[k] ?? 0), 12)),
    );
    expect(background.nodes.every(({ size }) => size === 12.7)).toBe(true);
    expect(meshing?.size).toBeCloseTo(6.35, 12);
    expect(bodies?.[0]?.placement).toEqual({ position: [25.4, 50.8, 76.2], scale: 25.4 });
    expect(bodies?.[0]?.remeshing).toEqual({ size: 12.7, featureAngle: 30 });
    expect(parameters).toEqual(project.parameters);
    expect(documents.project.expressions?.map(({ expression }) => expression)).toEqual([
      "(count/3)*25.4",
      "wide/2",
      "25.4 mm",
      "wide/8",
    ]);
    documents.edit(setParameter("wide", "4 in"));
    expect(documents.project.points.at(-1)?.position[1]).toBeCloseTo(50.8, 12);
    documents.undo();
    documents.undo();
    expect(documents.project).toEqual(before);
  });

  it("scales expressions whose value is 0, so that they follow their parameters", () => {
    const documents = new DocumentStore(
      {
        ...project,
        parameters: [
          { name: "w", expression: "10" },
          { name: "wide", expression: "5.08 cm" },
          { name: "half", expression: "wide/2" },
        ],
        expressions: [
          { kind: "point", id: 1, field: "position.0", expression: "(w-10)/2" },
          { kind: "point", id: 1, field: "position.1", expression: "half-1 in" },
          { kind: "point", id: 1, field: "position.2", expression: "wide-2*half" },
        ],
      },
      () => 0,
    );
    documents.edit(convertProject(documents.project, "in", "mm"));
    expect(documents.project.expressions?.map(({ expression }) => expression)).toEqual([
      "((w-10)/2)*25.4",
      "half-1 in",
      "wide-2*half",
    ]);
    documents.edit(setParameter("w", "12"));
    expect(documents.project.points[0]?.position[0]).toBeCloseTo(25.4, 12);
  });

  it("keeps the numbers if it is only relabelled, also those with units", () => {
    const documents = new DocumentStore(project, () => 0);
    documents.edit(setProjectUnit("mm"));
    const after = documents.project;
    expect(after.units).toBe("mm");
    expect(after.points).toEqual(project.points);
    expect(after.meshing?.size).toBeCloseTo(0.25, 12);
    expect(after.parameters?.map(({ expression }) => Number(expression))).toEqual([3, 2]);
    expect(after.expressions?.map(({ expression }) => expression)).toEqual(["count/3", "wide/2", "wide/8"]);
  });

  it("is asked about only if there are lengths", () => {
    expect(hasLengths(emptyProject())).toBe(false);
    expect(hasLengths({ ...emptyProject(), meshing: { size: 1 } })).toBe(true);
    expect(hasLengths(project)).toBe(true);
  });
});

it("measures are written with the power of their unit, if there is one", () => {
  expect(formatMeasure(0.125, "m", 3)).toBe("0.125 m³");
  expect(formatMeasure(12.3456, "mm", 2)).toBe("12.35 mm²");
  expect(formatMeasure(2, "in")).toBe("2 in");
  expect(formatMeasure(2, undefined, 3)).toBe("2");
});
