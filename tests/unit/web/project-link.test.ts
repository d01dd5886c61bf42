import { readdirSync, readFileSync } from "node:fs";
import { readProject } from "tetrafront/project";
import { describe, expect, it } from "vitest";
import { emptyProject } from "../../../web/document/create";
import { linkedIn, linkTo, maxLinkLength, withoutLink } from "../../../web/commands/project-link";

const shown = { project: emptyProject("Δ-shaped “part” 😀"), camera: null, cut: null, front: null };
const hashOf = async (linked = shown): Promise<string> =>
  new URL(await linkTo("https://host/app/?a=1", linked)).hash;

const models = new URL("../../../public/models/", import.meta.url);

describe("a link to a project", () => {
  it.each(readdirSync(models))("holds the model %s and is short", async (file) => {
    const read = readProject(readFileSync(new URL(file, models), "utf8"));
    if (!read.success) throw new Error(read.errors[0].message);
    const linked = { ...shown, project: read.value };
    const hash = await hashOf(linked);
    expect(hash.length).toBeLessThan(8000);
    expect(await linkedIn(hash)).toEqual({ kind: "linked", linked });
  });

  it("holds the project, camera, cut and front, in the fragment alone", async () => {
    const linked = {
      ...shown,
      camera: { eye: [1 / 3, -2e-7, 1e9], target: [0, 0.1, 0.2] },
      cut: { enabled: true, axis: "z", position: 0.125, flipped: true },
      front: {
        step: -3,
        order: "smallest-first",
        coloring: "size",
        faces: "all",
        elements: "all",
        candidate: 2,
      },
    } as const;
    const link = await linkTo("https://host/app/?a=1#old", linked);
    expect(link).toMatch(/^https:\/\/host\/app\/#project=[A-Za-z0-9_-]+$/);
    expect(await linkedIn(new URL(link).hash)).toEqual({ kind: "linked", linked });
    expect(withoutLink(link).href).toBe("https://host/app/");
  });

  it("is read with the breaks of a mail program", async () => {
    const hash = await hashOf();
    expect(await linkedIn(`${hash.slice(0, 40)}%20${hash.slice(40, 60)}\n${hash.slice(60)}`)).toMatchObject({
      kind: "linked",
    });
  });

  it("is refused as a whole if a part is missing or changed", async () => {
    const hash = await hashOf();
    const prefix = "#project=";
    for (let length = prefix.length; length < hash.length - 2; length += 7)
      expect(await linkedIn(hash.slice(0, length))).toEqual({ kind: "damaged" });
    for (const text of ["", "?", "AAAA", "not base64!", `${"A".repeat(50)}`])
      expect(await linkedIn(prefix + text)).toEqual({ kind: "damaged" });
  });

  it("names the reason if the project is not valid", async () => {
    const project = { ...emptyProject("x"), points: [{ id: 1, position: [0, 0, "a"] }] } as never;
    expect(await linkedIn(await hashOf({ ...shown, project }))).toMatchObject({
      kind: "invalid",
      reason: /./,
    });
  });

  it("is none without its name", async () => {
    for (const hash of ["", "#", "#step=3", "#Project=AA"]) expect(await linkedIn(hash)).toBeNull();
  });

  it("does not unpack more than a limit, whatever its length", async () => {
    const bomb = { ...shown, project: { ...shown.project, description: " ".repeat(80 * 2 ** 20) } };
    const hash = await hashOf(bomb);
    expect(hash.length).toBeLessThan(20 * maxLinkLength);
    expect(await linkedIn(hash)).toEqual({ kind: "damaged" });
  });
});
