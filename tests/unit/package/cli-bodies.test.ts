/** The command line with projects that have bodies: convert, info, check and mesh. */
import { readFileSync } from "node:fs";

import { readMesh, type MeshReport } from "tetrafront";
import { readProject, writeProject, type Project } from "tetrafront/project";
import { describe, expect, test } from "vitest";

import { tetrafront } from "../../support/command-line.js";
import { offFile, stlBinary } from "../../support/surface-files.js";
import { boxSurface, crossingNeedles, sphereSurface } from "../../support/surfaces.js";
import { temporaryFolder } from "../../support/temporary-folder.js";

const folder = temporaryFolder();
const { inFolder, save } = folder;
const cli = (...args: string[]) => tetrafront(folder.path, args);

function projectIn(name: string): Project {
  const read = readProject(readFileSync(inFolder(name), "utf8"));
  if (!read.success) throw new Error(read.errors[0].message);
  return read.value;
}

describe("tetrafront convert to a project", () => {
  test("makes a project with one body, which info lists and mesh meshes", async () => {
    save("ball.stl", stlBinary(sphereSurface(6)));
    const converted = await cli("convert", "ball.stl", "-o", "ball.json");
    expect(converted).toMatchObject({ code: 0 });
    const project = projectIn("ball.json");
    expect(project).toMatchObject({ name: "ball", points: [], lines: [], patches: [] });
    expect(project.bodies).toHaveLength(1);
    expect(project.bodies?.[0]).toMatchObject({ id: 1, name: "ball", patches: [{ id: 1, name: "ball" }] });

    const info = await cli("info", "ball.json");
    expect(info.stdout).toMatch(/body "ball": 432 triangles, 1 patch, box .*to be remeshed/);
    const { stdout } = await cli("info", "ball.json", "--json");
    expect((JSON.parse(stdout) as { bodies: unknown[] }).bodies[0]).toMatchObject({ triangles: 432 });

    const groups: Project["groups"] = [
      {
        id: 1,
        name: "inlet",
        members: [
          { kind: "patch", id: 1 },
          { kind: "body", id: 1 },
        ],
      },
      { id: 2, name: "", members: [] },
    ];
    save("grouped.json", writeProject({ ...project, groups }));
    const grouped = await cli("info", "grouped.json");
    expect(grouped.stdout).toContain('group "inlet": 1 patch, 1 body');
    expect(grouped.stdout).toContain("group 2: empty");
    const listed = JSON.parse((await cli("info", "grouped.json", "--json")).stdout) as { groups: unknown };
    expect(listed.groups).toEqual([
      { id: 1, name: "inlet", members: { patch: 1, body: 1 } },
      { id: 2, name: "", members: {} },
    ]);

    const checked = await cli("check", "ball.json");
    expect(checked).toMatchObject({ code: 0 });

    const meshed = await cli(
      "mesh",
      "ball.json",
      "-o",
      "ball.vtu",
      "--size",
      "0.3",
      "--report",
      "ball-report.json",
    );
    expect(meshed).toMatchObject({ code: 0 });
    const report = JSON.parse(readFileSync(inFolder("ball-report.json"), "utf8")) as MeshReport;
    expect(report.status).toBe("done");
    expect(report.dihedral.min).toBeGreaterThan(15);
    expect(report.volume).toBeGreaterThan(4);
    const read = await readMesh(readFileSync(inFolder("ball.vtu")), { fileName: "ball.vtu" });
    expect(read.success && read.value.patches).toMatchObject([{ name: "ball", tag: 1 }]);
  });

  test("repairs the surface on request", async () => {
    const { points, triangles } = boxSurface(2);
    save("open.off", offFile({ points, triangles: triangles.slice(3) }));
    expect(await cli("convert", "open.off", "-o", "closed.json", "--fill-holes", "5")).toMatchObject({
      code: 0,
    });
    expect(await cli("check", "closed.json")).toMatchObject({ code: 0 });
    expect(await cli("convert", "open.off", "-o", "open.json", "-q")).toMatchObject({ code: 0, stderr: "" });
    const { code, stdout } = await cli("check", "open.json");
    expect(code).toBe(2);
    expect(stdout).toMatch(/Body "open": /);
  });

  test("does not replace its input", async () => {
    save("same.json", "{}");
    const { code } = await cli("convert", "same.json", "-o", "same.json");
    expect(code).toBe(2);
  });
});

describe("tetrafront mesh with bodies", () => {
  test("names the body and its patch in errors", async () => {
    save("needles.off", offFile(crossingNeedles(2)));
    await cli("convert", "needles.off", "-o", "needles.json", "-q");
    const { code, stderr } = await cli("mesh", "needles.json", "-o", "needles.vtu");
    expect(code).toBe(2);
    expect(stderr).toMatch(/Body "needles": /);
  });

  test("accepts --growth, but no --surface, which each body has itself", async () => {
    save("box.off", offFile(boxSurface(2)));
    await cli("convert", "box.off", "-o", "box.json", "-q");
    expect(await cli("mesh", "box.json", "-o", "box.vtu", "--growth", "0.5", "-q")).toMatchObject({
      code: 0,
    });
    const { code, stderr } = await cli("mesh", "box.json", "-o", "box.vtu", "--surface", "keep");
    expect(code).toBe(2);
    expect(stderr).toContain("each body has a treatment of its own");
  });
});
