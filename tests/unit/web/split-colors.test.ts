import { createMesher } from "tetrafront";
import { bodyPatchGroups, bodySurface, createBody, type ProjectBody } from "tetrafront/project";
import { expect, it, vi } from "vitest";
import { drawnOf, type ShownBody } from "../../../web/viewer/shown-bodies";
import { unpackedBody } from "../../../web/workers/packed-bodies";
import type { NewBody, PackedNewBody } from "../../../web/workers/surface-files";
import type { Call, Reply } from "../../../web/workers/worker-client";
import { boxSurface } from "../../support/surfaces";

const orange = [1, 0.5, 0] as const;
const blue = [0, 0, 1] as const;
const packed = { orange: 0xff8000, blue: 0x0000ff };

type Scope = typeof globalThis & { onmessage: (event: { readonly data: Call }) => void };

/** Returns the answer of the worker of surfaces, which runs in this thread. */
async function answerOf(name: string, argument: unknown): Promise<PackedNewBody> {
  const answer = new Promise<Reply>((resolve) => vi.stubGlobal("postMessage", resolve));
  await import("../../../web/workers/surface-worker");
  (globalThis as Scope).onmessage({ data: { id: 1, name, argument } });
  const reply = await answer;
  if (reply.kind !== "answer") throw new Error(JSON.stringify(reply));
  return reply.answer as PackedNewBody;
}

const unpacked = async ({ packed: body, loaded }: PackedNewBody): Promise<NewBody> => ({
  body: await unpackedBody(body),
  loaded,
});

/** Splits a patch of a body along the edges of a box. */
async function split(body: ProjectBody, patch: number, isPreview: boolean): Promise<NewBody> {
  const mesher = await createMesher();
  const surface = { ...bodySurface(body), patches: bodyPatchGroups(body) };
  const pieces = (await mesher.splitPatches(surface, { angle: 30, patches: [patch] })).mesh;
  mesher.dispose();
  const argument = { body, split: pieces, nextPatchId: 20, isPreview };
  const made = await unpacked(await answerOf("split", argument));
  const { points, triangles } = body;
  return { ...made, body: { ...made.body, points, triangles } };
}

/** A value per patch, of a surface whose triangles of one patch are drawn alike. */
function drawnValues(shown: Omit<ShownBody, "id" | "preview" | "placement">): [string, number[]] {
  const body = { id: 1, preview: null, placement: undefined, ...shown };
  const { drawn, values } = drawnOf(body, "given");
  const { patchOffsets = [0], values: perCorner = null } = drawn ?? {};
  const found = shown.patches.map((_, p) => {
    const own = perCorner?.subarray(3 * (patchOffsets[p] ?? 0), 3 * (patchOffsets[p + 1] ?? 0)) ?? [];
    expect(new Set(own).size).toBe(1);
    return own[0] ?? NaN;
  });
  return [values, found];
}

const box = boxSurface(2);
const trianglePatch = new Uint32Array(box.triangles.length / 3).map((_, t) => (t < 8 ? 0 : 1));
const groups = [
  { name: "one face", tag: 1, color: blue },
  { name: "five faces", tag: 2, color: orange },
];
const twoColors = createBody({ ...box, trianglePatch, patches: groups }, { id: 1, firstPatchId: 4 });
const { trianglePatch: _, ...whole } = twoColors;
const oneColor: ProjectBody = { ...whole, patches: [{ id: 4, name: "all", color: orange }] };

it("a preview of a split of a body in one colour draws each piece in a colour of its own", async () => {
  const given = await unpacked(await answerOf("load", oneColor));
  expect(drawnValues({ patches: oneColor.patches, given: given.loaded, split: null })).toEqual([
    "color",
    [packed.orange],
  ]);
  const after = await split(oneColor, 0, true);
  const { patches } = after.body;
  const drawn = ["patch", [0, 1, 2, 3, 4, 5]];
  expect(drawnValues({ patches, given: given.loaded, split: after })).toEqual(drawn);

  const applied = await split(oneColor, 0, false);
  expect(applied.body.patches.map(({ color }) => color)).toEqual(patches.map(() => undefined));
  expect(drawnValues({ patches, given: applied.loaded, split: null })).toEqual(drawn);
});

it("patches keep their colour beside one that is split, whose pieces differ", async () => {
  const preview = await split(twoColors, 1, true);
  const { patches } = preview.body;
  expect(drawnValues({ patches, given: null, split: preview })).toEqual(["patch", [0, 1, 2, 3, 4, 5]]);

  const { body, loaded } = await split(twoColors, 1, false);
  expect(body.patches.flatMap(({ color }) => (color ? [color] : []))).toEqual([blue]);
  expect(drawnValues({ patches: body.patches, given: loaded, split: null })).toEqual([
    "color",
    body.patches.map(({ color }, p) => (color ? packed.blue : -1 - p)),
  ]);
  // They can be loaded again as they are drawn.
  const again = await unpacked(await answerOf("load", body));
  expect(again.loaded.drawn.values).toEqual(loaded.drawn.values);
});
