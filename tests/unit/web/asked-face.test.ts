/** "Be the mesher" brings the face that it asks about into view. */
import type { Trace } from "tetrafront/trace";
import { beforeAll, expect, it } from "vitest";
import type { Position } from "../../../web/document/position";
import { areaVector, cross, distance, dot, mean, subtract, unit } from "../../../web/document/vectors";
import { showAskedFace } from "../../../web/teach/player/asked-face";
import { cornersOf } from "../../../web/teach/player/judge";
import { nextVolumeQuestion, type VolumeQuestion } from "../../../web/teach/player/volume-game";
import type { Viewer } from "../../../web/viewer/viewer";
import { galleryProject, recordFront } from "../../support/recorded-models";

let trace: Trace;
beforeAll(async () => {
  trace = await recordFront(galleryProject("unit-cube"));
});

const size = { width: 800, height: 600, coveredLeft: 0 } as const;
const focal = 700;

/** A view in perspective that fits positions without turning. */
class PlainView {
  pose = { eye: [4, -5, 3] as Position, target: [0.5, 0.5, 0.5] as Position };
  moves = 0;
  readonly labelArea = size;
  readonly framing = {
    fitPositions: (positions: readonly Position[]): void => {
      this.moves++;
      const centre = mean(positions);
      const radius = Math.max(...positions.map((position) => distance(position, centre)));
      const direction = unit(subtract(this.pose.eye, this.pose.target)) ?? [0, 0, 1];
      const away = (2.5 * radius * focal) / size.height;
      this.pose = { eye: along(centre, direction, away), target: centre };
    },
  };

  setPose(pose: PlainView["pose"]): void {
    this.pose = pose;
  }

  toScreen(position: Position): { x: number; y: number } | null {
    const { eye, target } = this.pose;
    const ahead = unit(subtract(target, eye)) ?? [0, 0, -1];
    const right = unit(cross(ahead, [0, 0, 1])) ?? [1, 0, 0];
    const up = cross(right, ahead);
    const offset = subtract(position, eye);
    const depth = dot(offset, ahead);
    if (depth <= 0) return null;
    const at = (axis: Position): number => (focal * dot(offset, axis)) / depth;
    return { x: size.width / 2 + at(right), y: size.height / 2 - at(up) };
  }
}

const along = (from: Position, direction: Position, length: number): Position => [
  from[0] + length * direction[0],
  from[1] + length * direction[1],
  from[2] + length * direction[2],
];

function questions(): readonly VolumeQuestion[] {
  const all: VolumeQuestion[] = [];
  for (let at = 0; at < trace.stepCount && all.length < 40; at += 40) {
    const question = nextVolumeQuestion(trace, at, "medium");
    if (question) all.push(question);
  }
  return all;
}

const ask = (question: VolumeQuestion, view: PlainView): void =>
  showAskedFace(
    trace,
    { question, answer: null, showsIdeal: true, choose: () => undefined },
    view as unknown as Viewer,
  );

it("from its empty side and large enough, wherever the view was", () => {
  let turned = 0;
  for (const question of questions()) {
    const view = new PlainView();
    ask(question, view);
    turned += view.moves;
    const corners = cornersOf(trace, question.step.face);
    const normal = unit(areaVector(corners)) ?? [0, 0, 1];
    const toEye = unit(subtract(view.pose.eye, mean(corners))) ?? [0, 0, 1];
    expect(dot(normal, toEye)).toBeGreaterThan(0.2);
    for (const corner of corners) {
      const at = view.toScreen(corner);
      expect(at?.x).toBeGreaterThan(0);
      expect(at?.x).toBeLessThan(size.width);
      expect(at?.y).toBeGreaterThan(0);
      expect(at?.y).toBeLessThan(size.height);
    }
  }
  expect(turned).toBeGreaterThan(5);
});

it("and leaves the view alone if the face is well seen", () => {
  for (const question of questions()) {
    const view = new PlainView();
    ask(question, view);
    const { pose, moves } = view;
    ask(question, view);
    expect(view.moves).toBe(moves);
    expect(view.pose).toBe(pose);
  }
});
