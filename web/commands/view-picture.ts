/** A picture of the view in any size, as a file. Loaded when it is used. */
import type { App } from "../app/app";
import { download, fileStem } from "../session/files";
import { pictureStrings as texts } from "../strings/passing";
import type { PictureSize } from "../viewer/picture-tiles";
import type { Viewer } from "../viewer/viewer";
import { drawLegend } from "./drawn-legend";
import { showFailure, showMessage } from "./messages";

export interface PictureChoices extends PictureSize {
  /** Without the background of the view. */
  readonly isTransparent: boolean;
  readonly legend: boolean;
  readonly axes: boolean;
}

/** Saves a picture as a PNG file. Returns whether it was saved. */
export async function saveViewPicture(app: App, choices: PictureChoices): Promise<boolean> {
  const { viewer } = app.viewer.getState();
  if (!viewer) {
    showMessage(app, texts.failed, [texts.noView]);
    return false;
  }
  try {
    const picture = await pngOf(await drawn(app, viewer, choices));
    download([picture], `${fileStem(app.documents.project.name)}.png`, "image/png");
    return true;
  } catch (error) {
    showFailure(app, texts.failed, error);
    return false;
  }
}

async function drawn(app: App, viewer: Viewer, choices: PictureChoices): Promise<HTMLCanvasElement> {
  const canvas = Object.assign(document.createElement("canvas"), {
    width: choices.width,
    height: choices.height,
  });
  const paper = canvas.getContext("2d");
  if (!paper) throw new Error("The browser offers no canvas");
  if (!choices.isTransparent) drawBackground(paper);
  const scale = viewer.drawSized(paper, choices);
  paper.save();
  const { width, height, coveredLeft } = viewer.labelArea;
  paper.translate(canvas.width / 2, canvas.height / 2);
  paper.scale(scale, scale);
  paper.translate(-(width + coveredLeft) / 2, -height / 2);
  await app.replay.drawLabels(viewer, paper);
  paper.restore();
  // On a picture of another shape, the legend is as large as beside the model.
  if (choices.legend) drawLegend(document, paper, scale);
  return canvas;
}

/** The background of the view: see viewport-panel.module.css. */
function drawBackground(paper: CanvasRenderingContext2D): void {
  const { width, height } = paper.canvas;
  const style = getComputedStyle(document.body);
  paper.save();
  paper.translate(0.5 * width, 0.38 * height);
  paper.scale(0.9 * width, 0.8 * height);
  const gradient = paper.createRadialGradient(0, 0, 0, 0, 0, 1);
  gradient.addColorStop(0, style.getPropertyValue("--tf-view-near").trim());
  gradient.addColorStop(1, style.getPropertyValue("--tf-view-far").trim());
  paper.fillStyle = gradient;
  paper.fillRect(-1, -1, 2, 2);
  paper.restore();
}

const pngOf = (canvas: HTMLCanvasElement): Promise<Blob> =>
  new Promise((resolve, reject) => {
    canvas.toBlob((blob) => {
      if (blob) resolve(blob);
      else reject(new Error("The browser cannot write a picture of this size"));
    }, "image/png");
  });
