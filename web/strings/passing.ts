/** Texts about links to projects and pictures of the view. */

import { formatCount } from "./format";
export const linkStrings = {
  title: "Share link",
  intro:
    "The link opens the model with its settings, seen as you see it now. The link itself holds all of it: nothing is uploaded, and no server sees it.",
  withStep: "It also leads to the step of the front that is shown.",
  field: "Link",
  length: (characters: number) => `${formatCount(characters)} characters`,
  copied: "The link is in the clipboard.",
  copy: "Copy link",
  making: "Making the link…",
  tooLong: (characters: number, limit: number) =>
    `The link would have ${formatCount(characters)} characters. Many mail programs and messengers cut links of more than ${formatCount(limit)}. Save the project, and pass on its file.`,
  save: "Save project file",
  failed: "The link could not be made",
  noLink: "The link cannot be opened",
  damaged:
    "A part of the link is missing or changed; some programs cut long links. Ask for the link again, or for the project file. Your own project is open.",
  invalid: (reason: string) => `The project in the link is not valid: ${reason} Your own project is open.`,
} as const;

export const pictureStrings = {
  title: "Export picture",
  size: "Size",
  presets: { view: "View", double: "2 ×", "4k": "4K", square: "Square", own: "Own" },
  width: "Width",
  height: "Height",
  pixels: "px",
  transparent: "Transparent background",
  legend: "Legend",
  axes: "Axes",
  save: "Save PNG",
  cancel: "Cancel",
  limits: (side: number, area: number) =>
    `A picture has 1 to ${formatCount(side)} whole pixels a side, and at most ${area} million in all.`,
  noView: "Without a view, there is no picture",
  failed: "The picture could not be saved",
} as const;

export const offlineStrings = {
  understood: "OK",
  keeping: "All parts of Tetrafront are being kept in this browser…",
  kept: (bytes: number) =>
    `Tetrafront is kept in this browser (${(bytes / 1e6).toFixed(1)} MB), with the library for CAD files. It works without a network.`,
  notKept: "Tetrafront could not be kept for offline use",
  noNetwork: "There is no network. Try again when there is one.",
  notInstalled: "A file of the site could not be fetched, or is of another version. Try again later.",
  tooLong: (minutes: number) =>
    `It took more than ${minutes} minutes. The browser continues while this page is open; try again later.`,
  update: "A new version of Tetrafront is ready. Your projects stay as they are.",
  reload: "Reload",
} as const;

export const workerStrings = {
  understood: "OK",
  lost: (reason: string) =>
    `${reason}. Another one was started. If a result is missing, repeat the last step.`,
  notStarted: (reason: string, tries: number) =>
    `${reason}. It was started ${tries} times, and has ended each time before it was running. Your project is kept: close other tabs and programs to free memory, check the network, then reload the page.`,
} as const;

export const startStrings = {
  title: "Tetrahedra for any shape",
  what: "Tetrafront fills what you draw or open with tetrahedra for simulation, by the advancing-front method, in your browser.",
  drop: "Drop a STEP, STL or mesh here",
  /** Where nothing can be dropped. */
  choose: "Open a STEP, STL or mesh",
  dropHint: "or choose a file: IGES, 3MF, PLY, OBJ, MSH, VTU, a project…",
  empty: "Empty project",
  recent: "Recent",
  all: "All…",
  examples: "Examples",
  templates: "Templates…",
  lessons: "Lessons",
  promise: "Free software under the MIT licence. Nothing is uploaded: your files stay on this computer.",
  showAgain: "Show at start",
  close: "Close start page",
} as const;
