import { readdirSync, readFileSync } from "node:fs";
import { describe, expect, it } from "vitest";
import { readProject } from "tetrafront";
import { findOpenLines } from "../../../web/document/open-lines";
import { cubeProject } from "../../support/projects";

const models = new URL("../../../public/models/", import.meta.url);

describe("open lines", () => {
  it.each(readdirSync(models))("finds none in the closed model %s", (file) => {
    const read = readProject(readFileSync(new URL(file, models), "utf8"));
    if (!read.success) throw new Error(read.problems[0].message);
    expect(findOpenLines(read.value)).toEqual([]);
  });

  it("names the lines around a patch that is gone", () => {
    const cube = cubeProject();
    const [gone, ...patches] = cube.patches;
    const [found] = findOpenLines({ ...cube, patches });
    const around = gone?.loops.flat().map(Math.abs) ?? [];
    expect(found?.entities.map(({ id }) => id).sort()).toEqual(around.sort());
    expect(found).toMatchObject({ code: "open-edge", severity: "error" });
  });

  it("does not judge a line that another may lie upon", () => {
    const cube = cubeProject();
    const doubles = cube.lines.map(({ id, ...line }) => ({ ...line, id: id + 100 }));
    const project = { ...cube, patches: cube.patches.slice(1), lines: [...cube.lines, ...doubles] };
    expect(findOpenLines(project)).toEqual([]);
  });
});
