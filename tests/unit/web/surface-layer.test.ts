/** The triangles of lines and patches in space, made when they are first looked at. */
import { createMesher } from "tetrafront";
import type { Trace } from "tetrafront/trace";
import { Mesh, type BufferGeometry } from "three";
import { beforeAll, expect, it, vi } from "vitest";
import { SurfaceLayer } from "../../../web/teach/player/surface-layer";
import { recordSurface } from "../../support/recorded-models";
import { change, sceneState, show } from "./scene";

let trace: Trace;
beforeAll(async () => {
  const mesher = await createMesher();
  ({ trace } = await recordSurface(mesher, "unit-cube"));
  mesher.dispose();
});

const surfaceOf = () => {
  if (trace.surface === null) throw new Error("the trace has no lines and patches");
  return trace.surface;
};

/** Coordinates of the finished triangles, which are drawn first. */
function finished(layer: SurfaceLayer): readonly number[] {
  const [done] = layer.root.children;
  if (!(done instanceof Mesh)) throw new Error("the first part is no mesh");
  const geometry = done.geometry as BufferGeometry;
  return [...geometry.getAttribute("position").array].slice(0, 3 * geometry.drawRange.count);
}

it("are not made for a front of which only the volume is shown", () => {
  const improvedPositions = vi.spyOn(surfaceOf(), "improvedPositions");
  const layer = new SurfaceLayer(trace);
  show(layer, sceneState());
  layer.show(null);
  expect(improvedPositions).not.toHaveBeenCalled();
  layer.show(0);
  layer.show(1);
  expect(improvedPositions).toHaveBeenCalledTimes(surfaceOf().fronts.length);
  layer.dispose();
});

it("are those of the improved patches at the end, relative to the origin", () => {
  const { fronts, stepCount } = surfaceOf();
  const expected = (origin: readonly number[]) =>
    fronts.flatMap((front, index) => {
      const positions = surfaceOf().improvedPositions(index);
      if (!positions || !front.improved) throw new Error("a patch was not improved");
      return [...front.improved.triangles].flatMap((node) =>
        origin.map((start, axis) => Math.fround((positions[3 * node + axis] ?? NaN) - start)),
      );
    });
  const layer = new SurfaceLayer(trace);
  const [state, moved] = [sceneState(), sceneState({ origin: [0.5, -0.25, 2] })];
  show(layer, state);
  layer.show(stepCount);
  expect(finished(layer)).toEqual(expected([0, 0, 0]));
  change(layer, state, moved);
  expect(finished(layer)).toEqual(expected([0.5, -0.25, 2]));
  layer.dispose();
});
