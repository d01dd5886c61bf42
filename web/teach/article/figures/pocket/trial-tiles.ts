/** All tetrahedra on four corners of a pocket, as small pictures that the reader can choose. */
import type { Position } from "../../../../document/position";
import { dot, mean, subtract } from "../../../../document/vectors";
import { colours } from "../../kit/colours";
import { button, element } from "../../kit/dom";
import { Pen } from "../../kit/pen";
import type { Camera } from "../../kit/space";
import type { Pixel } from "../../kit/stage";
import { edgesOf, facesOf, type Pocket, type Trial } from "./pocket-rules";

const size = 64;
/** Pixels of a tile per unit of the scene. */
const magnification = 34;
const pixelRatio = 2;

interface Tile {
  readonly node: HTMLButtonElement;
  readonly pen: Pen;
}

export class TrialTiles {
  readonly element = element("div", {
    class: "tiles",
    role: "group",
    "aria-label": "Tetrahedra on four corners",
  });
  #tiles: readonly Tile[] = [];

  /** @param choose Called with the index of a tile. */
  constructor(readonly choose: (index: number) => void) {}

  /** Draws the tiles as the camera sees them. */
  show(pocket: Pocket, trials: readonly Trial[], chosen: number | null, camera: Camera): void {
    if (this.#tiles.length !== trials.length) this.#make(trials.length);
    trials.forEach((trial, index) => {
      const tile = this.#tiles[index];
      if (!tile) return;
      const fits = trial.verdict === "fits";
      tile.node.setAttribute("aria-pressed", String(index === chosen));
      tile.node.setAttribute("aria-label", nameOf(trial));
      tile.node.classList.toggle("refused", !fits);
      drawTile(tile.pen, pocket, trial, camera);
    });
  }

  #make(count: number): void {
    this.#tiles = Array.from({ length: count }, (_none, index) => {
      const canvas = element("canvas", {
        width: String(size * pixelRatio),
        height: String(size * pixelRatio),
      });
      const context = canvas.getContext("2d");
      if (!context) throw new Error("The browser has no canvas.");
      context.setTransform(pixelRatio, 0, 0, pixelRatio, 0, 0);
      context.lineJoin = "round";
      const node = button({ class: "tile", "data-tile": String(index + 1) }, "", () => this.choose(index));
      node.append(canvas);
      return { node, pen: new Pen(context) };
    });
    this.element.replaceChildren(...this.#tiles.map(({ node }) => node));
  }
}

/** Returns what a tile says to people who do not see it. */
export function nameOf({ element: corners, verdict, culprits }: Trial): string {
  const name = `Corners ${[...corners]
    .sort((a, b) => a - b)
    .map((corner) => corner + 1)
    .join(", ")}`;
  const lines = culprits.map(([a, b]) => `${a + 1}–${b + 1}`).join(" and ");
  switch (verdict) {
    case "fits":
      return `${name}: fits`;
    case "flat":
      return `${name}: flat`;
    case "crosses":
      return `${name}: ${lines} crosses an edge of the pocket`;
    case "outside":
      return `${name}: ${lines} runs outside`;
  }
}

function drawTile(
  pen: Pen,
  pocket: Pocket,
  { element: corners, verdict, culprits }: Trial,
  camera: Camera,
): void {
  const c = colours();
  const [right, up] = camera.axes;
  const middle = mean(pocket.corners);
  const pixels = pocket.corners.map((corner: Position): Pixel => {
    const from = subtract(corner, middle);
    return [size / 2 + dot(from, right) * magnification, size / 2 - dot(from, up) * magnification];
  });
  const at = (corner: number): Pixel => pixels[corner] ?? [0, 0];
  const fits = verdict === "fits";
  pen.context.clearRect(0, 0, size, size);
  for (const [a, b] of edgesOf(pocket)) pen.line(at(a), at(b), c.ink, 1, { alpha: 0.28 });
  for (const face of facesOf(corners))
    pen.polygon(face.map(at), fits ? c.new : c.refused, fits ? 0.24 : 0.13);
  for (const [i, a] of corners.entries())
    for (const b of corners.slice(i + 1))
      pen.line(at(a), at(b), fits ? c.new : c.refused, fits ? 1.6 : 1.1, { alpha: fits ? 1 : 0.7 });
  for (const [a, b] of culprits) pen.line(at(a), at(b), c.refused, 2.4, { dash: [4, 3] });
}
