import { playerOf } from "../../../web/teach/commands/player-of";
import { replayOf } from "../../../web/teach/teach";
import type { Mesher } from "tetrafront";
import { createBody } from "tetrafront/project";
import { beforeEach, expect, it, vi } from "vitest";
import { App } from "../../../web/app/app";
import { paletteItems, type PaletteItem } from "../../../web/commands/palette-items";
import { inGroups, searchPalette } from "../../../web/commands/palette-search";
import { commands } from "../../../web/commands/registry";
import { isSimilarWord } from "../../../web/commands/similar-words";
import { addBodies } from "../../../web/document/body-edits";
import { bodiesOf } from "../../../web/document/entities";
import type { Gallery } from "../../../web/session/gallery";
import { newDocument } from "../../../web/session/document-store";
import { strings, synonyms } from "../../../web/strings";
import { searchHelp } from "../../../web/document/help-search";
import { keySections } from "../../../web/panels/help/help-dialog";
import type { Viewer } from "../../../web/viewer/viewer";
import { cubeProject } from "../../support/projects";
import { boxSurface } from "../../support/surfaces";
import { starSurface, starTrace } from "../../support/traces";
import { SilentWorker } from "../../support/silent-worker";

beforeEach(() => {
  vi.stubGlobal("Worker", SilentWorker);
});

/** An app with a view, whose mesher never answers. */
function cubeApp(models: Gallery["models"] = []): App {
  const mesher = Promise.resolve({ previewProject: () => new Promise(() => undefined) } as unknown as Mesher);
  const app = new App(
    { first: { document: newDocument(cubeProject()) }, mesher, previewMesher: mesher, library: null },
    { gallery: { opening: "", models }, generate: false, still: true, replayOf },
  );
  app.viewer.setState({ viewer: {} as Viewer });
  return app;
}

const item = (id: string, label: string, words = "", group = "Edit"): PaletteItem => ({
  id,
  group,
  label,
  words,
  hotkey: null,
  needs: null,
  run: () => undefined,
});

const listed = [
  item("undo", "Undo", "back revert"),
  item("front", "Front view", "", "View"),
  item("generate", "Generate mesh", "run start", "Mesh"),
  item("cover", "Create covering grid…", "bounding box", "Mesh"),
];
const found = Array.from({ length: 30 }, (_, i) => item(`point-${i}`, `Point ${i}`, "", "Entities"));
const ids = (query: string) => searchPalette(query, listed, found).map(({ id }) => id);

it("lists the commands without a query, and nothing else", () => {
  expect(ids("")).toEqual(["undo", "front", "generate", "cover"]);
  expect(ids("  ")).toEqual(ids(""));
});

it("finds words in any order, other words, entities, and words with mistakes", () => {
  expect(ids("view front")).toEqual(["front"]);
  expect(ids("revert")).toEqual(["undo"]);
  expect(ids("point 17")).toEqual(["point-17"]);
  expect(ids("genrate")).toEqual(["generate"]);
  expect(ids("covring grd")[0]).toBe("cover");
  expect(ids("qqqqqq")).toEqual([]);
});

it("prefers labels to other words, and exact words to similar ones", () => {
  const more = [item("a", "Box of bricks", "", "A"), item("b", "Cover", "box", "B")];
  expect(searchPalette("box", more, []).map(({ id }) => id)).toEqual(["a", "b"]);
  expect(searchPalette("undo", [...listed, item("c", "Unde", "", "C")], []).map(({ id }) => id)).toEqual([
    "undo",
  ]);
});

it("with a mistake, finds a command before an example that has the word twice, and a label before other words", () => {
  const more = [item("new", "New from template…", "box sphere"), item("sphere", "Sphere…", "ball")];
  const example = item("example", "Sphere in a box", "sphere inside", "Examples");
  expect(searchPalette("sphre", more, [example]).map(({ id }) => id)).toEqual(["sphere", "example", "new"]);
});

it("shows a few entities of many, in groups by their best entry", () => {
  expect(ids("point")).toHaveLength(10);
  const groups = inGroups([item("x", "X", "", "B"), item("y", "Y", "", "A"), item("z", "Z", "", "B")]);
  expect(groups.map(({ group, items }) => [group, items.length])).toEqual([
    ["B", 2],
    ["A", 1],
  ]);
});

it("lists disabled entries after all others, and not without a query", () => {
  const disabled = { ...item("exact", "Export", "", "File"), needs: "Generate a mesh first." };
  const items = [item("other", "Save", "export", "File")];
  expect(searchPalette("export", items, [disabled]).map(({ id }) => id)).toEqual(["other", "exact"]);
  expect(searchPalette("", items, [disabled]).map(({ id }) => id)).toEqual(["other"]);
});

it("lists all disabled commands that it finds, and the entries of others beside them", () => {
  const disabled = Array.from({ length: 11 }, (_, i) => ({
    ...item(`export-${i}`, `Export ${i}`, "", "File"),
    needs: "Generate a mesh first.",
  }));
  const others = Array.from({ length: 11 }, (_, i) => item(`file-${i}`, `Export of ${i}`, "", "File"));
  const all = searchPalette("export", [], [...disabled, ...others]).map(({ id }) => id);
  expect(all.filter((id) => id.startsWith("export-"))).toEqual(disabled.map(({ id }) => id));
  expect(all.filter((id) => id.startsWith("file-"))).toHaveLength(10);
});

it("finds words by their beginning, not by parts of them", () => {
  const items = [item("a", "Remove all"), item("b", "Translate", "move")];
  expect(searchPalette("move", items, []).map(({ id }) => id)).toEqual(["b"]);
});

it.each([
  ["subtract", "boolean-difference"],
  ["merge bodies", "boolean-union"],
  ["fuse", "boolean-union"],
  ["pattern", "array-linear"],
  ["reflect", "transform-mirror"],
  ["translate", "tool-move"],
  ["lasso", "tool-select"],
  ["snap", "tool-point"],
  ["zoom to fit", "fit"],
])("finds a command by %s", (query, id) => {
  const known = commands.map((command) => item(command.id, command.id, synonyms[command.id]));
  expect(searchPalette(query, known, [])[0]?.id).toBe(id);
});

it("knows synonyms of existing commands only", () => {
  const known = new Set(commands.map(({ id }) => id));
  expect(Object.keys(synonyms).filter((id) => !known.has(id))).toEqual([]);
});

const gallery = [
  { id: "unit-cube", title: "Unit cube", blurb: "", group: "", file: "unit-cube.json" },
  { id: "plate-with-hole", title: "Plate with a hole", blurb: "", group: "", file: "plate-with-hole.json" },
];

/** The entries of an app with a small model, as the palette shows them for a query. */
function foundBy(query: string): readonly string[] {
  const { listed, found } = paletteItems(cubeApp(gallery), query);
  return searchPalette(query, listed, found).map(({ id }) => id);
}

it.each([
  ["image", "share-step-picture"],
  ["picture", "share-step-picture"],
  ["screenshot", "share-step-picture"],
  ["png", "share-step-picture"],
  ["share", "share-step-link"],
  ["compare", "setting-quality"],
  ["measure", "tool-measure"],
  ["distance", "tool-measure"],
  ["help", "help"],
  ["manual", "help"],
  ["export", "export"],
  ["download", "export"],
  ["paraview", "export"],
  ["nastran", "export"],
  ["vtu", "export"],
  ["shortcuts", "help"],
  ["shortcut", "help"],
  ["keyboard", "help"],
  ["embed", "share-step-embed"],
  ["weld", "repair-body"],
  ["repair", "repair-body"],
  ["remesh", "generate"],
  ["cancel", "cancel"],
  ["stop", "cancel"],
  ["axes", "view-isometric"],
  ["perspective", "view-isometric"],
  ["offline", "keep-offline"],
  ["install", "keep-offline"],
])("finds by the word %s what it means", (query, id) => {
  expect(foundBy(query)).toContain(id);
});

it("finds the commands of each menu within a menu by its name", () => {
  for (const [menu, names] of Object.entries(strings.submenus)) {
    for (const [section, name] of Object.entries(names)) {
      const found = foundBy(name);
      const own = commands.filter((one) => one.menu === menu && one.section === Number(section));
      expect([name, own.some(({ id }) => found.includes(id))]).toEqual([name, true]);
    }
  }
});

it.each([
  ["undo", "undo"],
  ["delete", "delete"],
  ["share", "share"],
  ["image", "picture"],
  ["screenshot", "picture"],
  ["measure", "tool-measure"],
  ["mesh", "generate"],
  ["cut", "cut"],
  ["section", "cut"],
  ["hole", "hole-through"],
  ["union", "boolean-union"],
  ["unit", "setting-units"],
  ["units", "setting-units"],
  ["size", "refine"],
  ["refine", "refine"],
  ["wireframe", "edges"],
  ["help", "help"],
  ["shortcuts", "help"],
  ["iso", "view-isometric"],
  ["top", "view-top"],
  ["step", "open"],
  ["import", "import-surface"],
  ["second order", "export"],
  ["log", "log"],
  ["lesson", "lessons"],
])("finds by the word %s first %s", (query, id) => {
  expect(foundBy(query)[0]).toBe(id);
});

it.each(["mesh", "points", "lines"])("does not hide a layer by the word %s alone", (query) => {
  expect(foundBy(query)[0]).not.toMatch(/^layer-/);
});

it("finds lessons by their number, and opens their pages", () => {
  expect(foundBy("lesson 10")[0]).toBe("lesson-10");
  expect(foundBy("lesson 0")[0]).toBe("lesson-0");
  expect(foundBy("lesson")).toEqual(["lessons"]);
  expect(foundBy("lesson 12")).toEqual([]);
  const open = vi.fn();
  vi.stubGlobal("window", { open });
  for (const query of ["lessons", "lesson 7"]) {
    const { listed, found } = paletteItems(cubeApp(), query);
    searchPalette(query, listed, found)[0]?.run();
  }
  expect(open.mock.calls.map(([address]) => address as string)).toEqual(["./lessons/", "./lessons/7/"]);
});

it("remeshes the triangles of bodies", () => {
  const app = cubeApp();
  const remesh = () => {
    const { listed, found } = paletteItems(app);
    return searchPalette("remesh", listed, found);
  };
  expect(remesh().find(({ id }) => id === "remesh-bodies")?.needs).toBe("Import a surface first.");
  const bodies = [1, 2].map((id) => {
    const surface = boxSurface(1, [3 * id, 0, 0], [3 * id + 1, 1, 1]);
    return { ...createBody(surface, { id, firstPatchId: 100 * id, name: "box" }), surface: "keep" as const };
  });
  app.documents.edit(addBodies(app.documents.project, bodies));
  const [first] = remesh();
  expect(first?.id).toBe("remesh-bodies");
  first?.run();
  expect(bodiesOf(app.documents.project).map(({ surface }) => surface)).toEqual([undefined, undefined]);
  app.documents.undo();
  expect(bodiesOf(app.documents.project).map(({ surface }) => surface)).toEqual(["keep", "keep"]);
});

it.each(["png", "jpg", "pdf", "svn", "xyz", "qwerty", "triangel soup", "mehs it"])(
  "finds nothing for %s, or only entries with a word like each of its words",
  (query) => {
    const words = query.split(" ");
    const { listed, found } = paletteItems(cubeApp());
    for (const { label, words: others } of searchPalette(query, listed, found)) {
      const text = `${label} ${others}`.toLowerCase();
      const letters = (word: string): string => [...word].sort().join("");
      const starts = text.split(/[^a-z0-9]+/);
      for (const word of words)
        expect(starts.some((start) => start.startsWith(word) || letters(start) === letters(word))).toBe(true);
    }
  },
);

it.each([
  ["print", []],
  ["ping", []],
  ["stop", ["cancel"]],
  ["reset", ["fit", "view-isometric"]],
  ["share", ["share", "share-step-link", "share-step-embed", "share-step-drawing", "share-step-animation"]],
  ["medit", ["export", "open"]],
])("finds nothing by %s but what it means", (query, ids) => {
  const opened = {
    id: "pipe-and-flow",
    title: "Pipe and flow",
    blurb: "Regions that share stops and points.",
  };
  const app = cubeApp([{ ...opened, group: "", file: "pipe-and-flow.json" }]);
  const { listed, found } = paletteItems(app);
  const all = searchPalette(query, listed, found).map(({ id }) => id);
  expect(all.toSorted()).toEqual(ids.toSorted());
});

it("finds steps of the front by their number, and how to ask for one", async () => {
  const app = cubeApp();
  const foundBy = (query: string) => {
    const { listed, found } = paletteItems(app, query);
    return searchPalette(query, listed, found);
  };
  const isOfFront = ({ id }: PaletteItem): boolean => id.startsWith("front-") || id === "go-to-step";
  // Without a front, they say what they need.
  const before = foundBy("step").filter(isOfFront);
  expect(before.length).toBeGreaterThan(4);
  for (const { needs } of before) expect(needs).toContain("Record the front first");
  await playerOf(app).open(starTrace(starSurface(boxSurface(3, [0, 0, 0], [1, 1, 1]))).bytes);
  const asks = foundBy("step").find(({ id }) => id === "go-to-step");
  expect(asks).toMatchObject({ begins: "step ", needs: null });
  for (const query of ["step 12", "go to step 12", "Step 12 "]) {
    playerOf(app).seek(0);
    const [found] = foundBy(query);
    expect(found?.label).toBe("Go to step 12 of the front");
    found?.run();
    expect(playerOf(app).state.getState().step).toBe(12);
  }
  expect(foundBy("step 99999").filter(isOfFront)).toEqual([]);
});

it.each(["language", "languages", "translation", "deutsch"])(
  "finds nothing by %s, which it does not have",
  (query) => {
    expect(foundBy(query)).toEqual([]);
  },
);

it("shows that there is nothing to undo", () => {
  const { found } = paletteItems(cubeApp());
  expect(found.find(({ id }) => id === "undo")?.needs).toBe("There is nothing to undo.");
});

it("takes a word with one mistake for the right one, and no other word", () => {
  const typed: readonly (readonly [string, string, boolean])[] = [
    ["genrate", "generate", true],
    ["sphree", "sphere", true],
    ["mehs", "mesh", true],
    ["boundry", "boundary", true],
    ["tetrahedorn", "tetrahedron", true],
    ["png", "pan", false],
    ["png", "point", false],
    ["line", "side", false],
    ["cut", "cuts", true],
    ["hole", "sole", false],
    ["print", "point", false],
    ["ping", "pipe", false],
    ["stop", "step", false],
    ["triangle", "tetrahedra", false],
  ];
  for (const [a, b, isSame] of typed) expect([a, b, isSimilarWord(a, b)]).toEqual([a, b, isSame]);
});

it.each([
  ["offline", "Keep for offline use", "menu Help"],
  ["start page", "Start page", "menu File"],
  ["generate mesh", "Generate mesh", "Ctrl Enter, menu Mesh"],
  ["shortcut", strings.help.title, strings.help.keys],
  ["remove", "Delete selection", "Del, menu Edit"],
])("the search of the help finds %s among the commands", (query, title, place) => {
  const found = searchHelp(query, keySections(cubeApp()));
  expect(found[0]?.section).toMatchObject({ title, text: `${title}\n${place}` });
});
