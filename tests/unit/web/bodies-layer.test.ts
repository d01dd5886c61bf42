import { Raycaster, Vector2, type BufferGeometry, type Mesh, type ShaderMaterial } from "three";
import type { MeshResult } from "tetrafront";
import { createBody } from "tetrafront/project";
import { describe, expect, it } from "vitest";
import { drawnSurface } from "../../../web/document/drawn-surface";
import { BodiesLayer } from "../../../web/viewer/layers/bodies-layer";
import { Screen } from "../../../web/viewer/screen";
import type { ShownBody } from "../../../web/viewer/shown-bodies";
import { boxSurface } from "../../support/surfaces";
import { change, frontCamera, noTree, sceneState, show, viewport } from "./scene";

const surface = boxSurface(1, [-1, -1, -1], [1, 1, 1]);
const trianglePatch = Uint32Array.from({ length: surface.triangles.length / 3 }, (_, t) => t % 2);
const patches = [{ id: 4 }, { id: 9 }];
const { placement } = createBody(surface, { id: 1, firstPatchId: 4 });
const given = {
  surface: { ...surface, trianglePatch },
  drawn: drawnSurface({ ...surface, trianglePatch }, 2, trianglePatch),
};
const body: ShownBody = { id: 1, patches, placement, given, preview: null, split: null };
const start = sceneState({ bodies: [body] });

const passes = (layer: BodiesLayer) =>
  layer.root.children.flatMap(({ children }) => children as Mesh<BufferGeometry, ShaderMaterial>[]);
const at = (layer: BodiesLayer, x: number, y: number) => {
  const raycaster = new Raycaster();
  raycaster.setFromCamera(
    new Vector2((2 * x) / viewport.width - 1, 1 - (2 * y) / viewport.height),
    frontCamera(),
  );
  return layer.hit(raycaster.ray, new Screen(frontCamera(), viewport, { x, y }));
};

describe("the layer of bodies", () => {
  it("is hit where its placement puts a body, in model coordinates", () => {
    const layer = new BodiesLayer(noTree);
    show(layer, start);
    const hit = at(layer, 100, 50);
    expect(hit?.target.kind).toBe("body-patch");
    expect(hit?.depth).toBeCloseTo(9);
    hit?.position.forEach((x, k) => expect(x).toBeCloseTo([0, -1, 0][k] ?? NaN));
    const moved = { ...start, bodies: [{ ...body, placement: { position: [0, 4, 0], scale: 2 } as const }] };
    change(layer, start, moved);
    expect(at(layer, 100, 50)?.depth).toBeCloseTo(12);
    expect(at(layer, 100, 50)?.position[1]).toBeCloseTo(2);
    const away = { ...start, bodies: [{ ...body, placement: { position: [8, 0, 0] } as const }] };
    change(layer, moved, away);
    expect(at(layer, 100, 50)).toBeNull();
    change(layer, away, { ...away, origin: [8, 0, 0] });
    expect(at(layer, 100, 50)?.position[0]).toBeCloseTo(8);
    change(layer, away, { ...start, hidden: new Set(["body-1"]) });
    expect(at(layer, 100, 50)).toBeNull();
  });

  it("gives way to target sizes of a body, and stays without them, even where a mesh was shown", () => {
    const layer = new BodiesLayer(noTree);
    const nothing = new Uint32Array();
    const sizes = {
      points: new Float64Array(),
      sizes: new Float64Array(),
      range: [1, 1] as const,
      segments: nothing,
      triangles: nothing,
      plane: nothing,
    };
    const front = new Float64Array(9);
    const notYet = { ...start, front, shownSizes: { ...sizes, bodies: [] } };
    show(layer, notYet);
    expect(layer.root.children.map(({ visible }) => visible)).toEqual([true]);
    expect(passes(layer).map((pass) => pass.visible)).toEqual([true, false, false]);
    change(layer, notYet, { ...start, shownSizes: { ...sizes, bodies: [1] } });
    expect(layer.root.children.map(({ visible }) => visible)).toEqual([false]);
  });

  it("emphasizes a selected patch, and gives way to a mesh", () => {
    const layer = new BodiesLayer(noTree);
    const visible = (): boolean[] => passes(layer).map((pass) => pass.visible);
    show(layer, start);
    expect(visible()).toEqual([true, false, false]);
    const selected = { ...start, selection: [{ kind: "body-patch", id: 9 } as const] };
    change(layer, start, selected);
    expect(visible()).toEqual([true, true, true]);
    change(layer, selected, { ...selected, front: new Float64Array(9) });
    expect(visible()).toEqual([false, true, true]);
    const mesh = { tetrahedra: Uint32Array.from([0, 1, 2, 3]) };
    const meshed = { ...selected, mesh: { mesh } as MeshResult };
    change(layer, selected, meshed);
    expect(visible()).toEqual([false, true, true]);
    change(layer, meshed, { ...meshed, isMeshOfOthers: true });
    expect(visible()).toEqual([true, true, true]);
    change(layer, selected, { ...start, bodies: [] });
    expect(layer.root.children).toHaveLength(0);
  });

  it("colours given triangles by patch, and those of a preview by their deviation", () => {
    const layer = new BodiesLayer(noTree);
    const shading = () => {
      const uniforms = passes(layer)[0]?.material.uniforms;
      return [Number(uniforms?.["shaded"]?.value), Number(uniforms?.["hues"]?.value) > 0];
    };
    show(layer, start);
    expect(shading()).toEqual([1, true]);
    const values = new Float32Array(surface.triangles.length / 3).fill(0.5);
    const previewed = { ...start, bodies: [{ ...body, preview: drawnSurface(surface, 2, values) }] };
    change(layer, start, previewed);
    expect(shading()).toEqual([1, false]);
    const plain = { ...start, bodies: [{ ...body, preview: drawnSurface(surface, 2) }] };
    change(layer, previewed, plain);
    expect(shading()).toEqual([0, false]);
    change(layer, plain, { ...plain, bodySurface: "given" });
    expect(shading()).toEqual([1, true]);
  });

  it("has colours of files and of the palette in one material, with edges as all others", () => {
    const layer = new BodiesLayer(noTree);
    const colored = [{ id: 4, color: [1, 0, 0] as const }, { id: 9 }];
    const state = { ...start, bodies: [{ ...body, patches: colored }] };
    show(layer, state);
    const uniforms = () => passes(layer)[0]?.material.uniforms ?? {};
    expect(uniforms()["isPacked"]?.value).toBe(1);
    expect(uniforms()["hues"]?.value).toBe(state.colors.regions.length);
    expect(uniforms()["ramp"]?.value).not.toBeNull();
    expect(uniforms()["edges"]?.value).toBe(state.edges ? 1 : 0);
    change(layer, state, { ...state, edges: !state.edges });
    expect(uniforms()["edges"]?.value).toBe(state.edges ? 0 : 1);
  });
});
