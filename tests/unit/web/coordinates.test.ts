import { describe, expect, it } from "vitest";
import { measure } from "../../../web/document/measurement";
import type { Position } from "../../../web/document/position";
import { worldFrame, type Frame } from "../../../web/document/vectors";
import { principalPlane } from "../../../web/document/work-plane";
import { readCoordinates } from "../../../web/tools/drawing/coordinates";

const read = (text: string, last: Position | null = null, frame: Frame = worldFrame) =>
  readCoordinates(text, { last, frame });

const expectPosition = (typed: ReturnType<typeof read>, expected: Position): void => {
  if (!typed.success) throw new Error(typed.reason);
  typed.position.forEach((x, k) => expect(x).toBeCloseTo(expected[k] ?? NaN, 14));
};

describe("readCoordinates", () => {
  it.each<[string, Position]>([
    ["1,2,0", [1, 2, 0]],
    [" 1 , -2 ,0.5 ", [1, -2, 0.5]],
    ["1;2;3", [1, 2, 3]],
    ["1 2 3", [1, 2, 3]],
    ["sqrt(2)/2, pi/2, sin(30)", [Math.SQRT1_2, Math.PI / 2, 0.5]],
    ["cos(60), 2^3, atan(1)", [0.5, 8, 45]],
    ["1,2", [1, 2, 0]],
  ])("reads %s as a position", (text, position) => {
    expectPosition(read(text), position);
  });

  it("refers to the last place with @, and to the work plane with two numbers", () => {
    const last: Position = [1, 1, 1];
    expectPosition(read("@0.5,0,0", last), [1.5, 1, 1]);
    const { frame } = principalPlane("xz", [0, 3, 0]);
    expectPosition(read("1,2", last, frame), [1, 3, 2]);
    expectPosition(read("@1,2", last, frame), [2, 1, 3]);
  });

  it("reads a length and an angle in the work plane, from the last place or the plane's origin", () => {
    expectPosition(read("5<30"), [5 * Math.cos(Math.PI / 6), 2.5, 0]);
    expectPosition(read("2<90", [1, 1, 1]), [1, 3, 1]);
    expectPosition(read("@2<180", [1, 1, 1]), [-1, 1, 1]);
    expectPosition(read("2<-90", null, principalPlane("yz").frame), [0, 0, -2]);
  });

  it.each(["", "1", "1,2,3,4", "1,,2", "a,b", "1<2<3", "1<", "1,2,(3"])("rejects %j", (text) => {
    expect(read(text, [0, 0, 0])).toEqual({ success: false, reason: "syntax" });
  });

  it("needs a last place for relative coordinates", () => {
    expect(read("@1,0,0")).toEqual({ success: false, reason: "no-last-place" });
  });
});

describe("measure", () => {
  it("returns distance, differences and the angle at the second of three places", () => {
    expect(measure([[0, 0, 0]])).toBeNull();
    expect(measure([[1, 0, 0], [1, 3, 4]])).toEqual({ distance: 5, offset: [0, 3, 4], angle: null }); // prettier-ignore
    expect(measure([[1, 0, 0], [0, 0, 0], [0, 2, 0]])?.angle).toBeCloseTo(90, 12); // prettier-ignore
    expect(measure([[1, 0, 0], [0, 0, 0], [-1, 0, 0]])?.angle).toBeCloseTo(180, 12); // prettier-ignore
  });
});
