/** Pictures of a step and animations of the front, as files. Loaded when they are used. */
import type { App } from "../../app/app";
import { frontDrawing, labelColors, placedLabels, type DrawingView } from "../player/front-drawing";
import { lensMarks, type LensLabel } from "../player/lens-marks";
import { lensSceneOf } from "../player/lens-scene";
import { phaseAt, surfaceState } from "../player/phases";
import type { Player, PlayerState } from "../player/player";
import { recoveryMarksOf } from "../player/recovery-marks";
import { svgFont } from "../player/svg";
import { surfaceDrawing } from "../player/surface-drawing";
import { surfaceLabels } from "../player/surface-labels";
import { download, fileStem } from "../../session/files";
import { hideNotice, showNotice } from "../../session/shell";
import { shareStrings as texts } from "../strings/share";
import type { Viewer } from "../../viewer/viewer";
import { showFailure, showMessage } from "../../commands/messages";
import { playerOf } from "./player-of";

/** Frames per second of an animation, and its length in seconds. */
const frameRate = 30;
const seconds = 10;
const bitsPerSecond = 8_000_000;

const viewerOf = ({ viewer }: App): Viewer | null => viewer.getState().viewer;
/** Steps of lines and patches have the numbers that the player shows, which begin with each phase. */
function nameOf(app: App): string {
  const { trace, step } = playerOf(app).state.getState();
  const { phase, from } = trace ? phaseAt(trace, step) : { phase: "volume", from: 0 };
  return `${fileStem(app.documents.project.name)}${phase === "volume" ? "" : `-${phase}`}-step-${step - from}`;
}

/** Saves the view as it is, without background. */
export async function savePicture(app: App): Promise<void> {
  const viewer = viewerOf(app);
  if (!viewer) return;
  try {
    const picture = await viewer.picture((paper) => {
      const scale = paper.canvas.width / viewer.size.width;
      paper.scale(scale, scale);
      drawLabels(playerOf(app), viewer, paper);
    });
    download([picture], `${nameOf(app)}.png`, "image/png");
  } catch (error) {
    showFailure(app, texts.noPicture, error);
  }
}

const drawingView = (viewer: Viewer): DrawingView => ({
  ...viewer.size,
  eye: viewer.pose.eye,
  toScreen: (position) => viewer.toScreen(position),
});

/** Returns the labels of what the lens shows: of a face, or of the edge of a patch. */
function labelsOf(state: PlayerState): readonly LensLabel[] {
  const scene = lensSceneOf(state);
  if (scene) return lensMarks(scene).labels;
  const recovered = recoveryMarksOf(state);
  if (recovered) return recovered.labels;
  const { trace, step, candidate } = state;
  const surface = trace && surfaceState(trace, step);
  return trace?.surface && typeof surface === "number"
    ? surfaceLabels(trace.surface, surface, candidate)
    : [];
}

/** Draws the labels of what the lens shows, which are not in the canvas of the view, in CSS pixels of the view. */
export function drawLabels(player: Player, viewer: Viewer, paper: CanvasRenderingContext2D): void {
  const labels = placedLabels({ labels: labelsOf(player.state.getState()) }, drawingView(viewer));
  paper.save();
  paper.font = `${svgFont}px sans-serif`;
  paper.textAlign = "center";
  paper.textBaseline = "middle";
  for (const { kind, from, middle } of labels) {
    paper.beginPath();
    paper.moveTo(from.x, from.y);
    paper.lineTo(middle.x, middle.y);
    // On dark and on bright faces.
    for (const [color, width] of [
      ["#ffffff", 3],
      [labelColors[kind], 1],
    ] as const) {
      paper.strokeStyle = color;
      paper.lineWidth = width;
      paper.stroke();
    }
  }
  for (const { kind, text, middle, width, height } of labels) {
    paper.beginPath();
    paper.roundRect(middle.x - width / 2, middle.y - height / 2, width, height, 3);
    paper.fillStyle = "#ffffff";
    paper.fill();
    paper.strokeStyle = labelColors[kind];
    paper.stroke();
    paper.fillStyle = labelColors[kind];
    paper.fillText(text, middle.x, middle.y);
  }
  paper.restore();
}

/** Saves the front as a drawing that can be scaled. */
export function saveDrawing(app: App): void {
  const viewer = viewerOf(app);
  const state = playerOf(app).state.getState();
  if (!viewer || !state.trace) return;
  const drawing =
    state.step < 0
      ? surfaceDrawing(state.trace, { ...state, labels: labelsOf(state) }, drawingView(viewer))
      : frontDrawing(
          state.trace,
          { ...state, scene: lensSceneOf(state), recovered: recoveryMarksOf(state) },
          drawingView(viewer),
        );
  download([drawing], `${nameOf(app)}.svg`, "image/svg+xml");
}

/** Apps of which a film is being recorded. */
const filmed = new WeakSet<App>();

/**
 * Plays the front once, or the range that is repeated, and saves this as a film. A notice offers to end it early. Does
 * nothing while a film is being recorded.
 */
export async function saveAnimation(app: App): Promise<void> {
  const viewer = viewerOf(app);
  const { trace, loop, step: before } = playerOf(app).state.getState();
  if (!viewer || !trace || filmed.has(app)) return;
  const type = ["video/webm;codecs=vp9", "video/webm"].find((each) => isRecordable(each));
  if (type === undefined) return showMessage(app, texts.noAnimation, [texts.noWebm]);
  const stop = new AbortController();
  filmed.add(app);
  showNotice(app.shell, {
    key: "animation",
    tone: "information",
    text: texts.recordingAnimation,
    action: { label: texts.stopAnimation, run: () => stop.abort() },
  });
  try {
    const film = await record(
      playerOf(app),
      viewer,
      { from: loop?.from ?? 0, to: loop?.to ?? trace.stepCount, type },
      stop.signal,
    );
    // Another model may have been opened meanwhile.
    if (film) download([film], `${fileStem(app.documents.project.name)}.webm`, "video/webm");
  } catch (error) {
    showFailure(app, texts.noAnimation, error);
  } finally {
    filmed.delete(app);
    hideNotice(app.shell, "animation");
    if (playerOf(app).state.getState().trace === trace) playerOf(app).seek(before);
  }
}

const isRecordable = (type: string): boolean =>
  typeof MediaRecorder !== "undefined" && MediaRecorder.isTypeSupported(type);

interface Film {
  readonly from: number;
  readonly to: number;
  readonly type: string;
}

/** Returns the film; null if the front was closed before the first picture. */
async function record(
  player: Player,
  viewer: Viewer,
  { from, to, type }: Film,
  signal: AbortSignal,
): Promise<Blob | null> {
  player.pause();
  const { trace } = player.state.getState();
  const paper = document.createElement("canvas");
  const context = paper.getContext("2d");
  if (!context) throw new Error(texts.noCanvas);
  const stream = paper.captureStream(frameRate);
  try {
    const pieces: Blob[] = [];
    const recorder = new MediaRecorder(stream, { mimeType: type, videoBitsPerSecond: bitsPerSecond });
    recorder.addEventListener("dataavailable", ({ data }) => pieces.push(data));
    const ended = new Promise((resolve) => recorder.addEventListener("stop", resolve, { once: true }));
    // The lens waits, as while playing; pausing ends the film.
    player.state.setState({ isPlaying: true });
    // The recorder goes by the clock: if pictures take long, the film has fewer of them, but the same length.
    let begin: number | null = null;
    for (let share = 0; share < 1 && !signal.aborted;) {
      const state = player.state.getState();
      if (state.trace !== trace || !state.isPlaying) break;
      share = begin === null ? 0 : Math.min(1, (performance.now() - begin) / (1000 * seconds));
      player.seek(from + (to - from) * share);
      viewer.drawOn(context);
      if (begin === null) {
        recorder.start();
        begin = performance.now();
      }
      await new Promise((resolve) => setTimeout(resolve, 1000 / frameRate));
    }
    if (recorder.state === "inactive") return null;
    recorder.stop();
    await ended;
    return new Blob(pieces, { type });
  } finally {
    player.pause();
    for (const track of stream.getTracks()) track.stop();
  }
}
