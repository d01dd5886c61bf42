/** Texts about the lessons. Those of a lesson are in its file. */
import { formatCount } from "../../strings/format";
import type { FrontOrder } from "tetrafront";

/** A large number in few letters: 74.9M. */
const short = (value: number): string =>
  value.toLocaleString("en-US", { notation: "compact", maximumFractionDigits: 1 });

const targets = {
  postponed: "a postponed face",
  line: "a line that is divided",
  patch: "the first front of a patch",
  behind: "a candidate behind the base face",
  crosses: "a candidate that crosses a face",
  "too-close": "a new node too close to a face",
  recovery: "a step of recovery",
  "new-node": "a step that makes a new node",
  end: "the last state",
} as const;

const orders: Readonly<Record<FrontOrder, string>> = {
  layered: "layered",
  "smallest-first": "smallest first",
  "first-in": "first in",
  random: "random",
};

/** Parts of names of runs, but orders. */
const rules: Readonly<Record<string, string>> = {
  strict: "never relaxed",
  unfiltered: "no filters",
  linear: "linear search",
  "tolerance-0": "never too close",
  "tolerance-0.5": "half the distance",
  "tolerance-2": "twice the distance",
};
const orderName = (part: string): string =>
  Object.entries(orders).find(([order]) => order === part)?.[1] ?? part;

export const lessonStrings = {
  title: "Lessons",
  article: "Read as an article",
  lens: "Lens and colours",
  intro:
    "Lessons on the advancing-front method. Each opens a model, shows a state of its front, and sets tasks that the app checks.",
  loading: "Loading the lessons…",
  failed: (reason: string) =>
    `The lessons could not be loaded: ${reason}. Check the connection and try again.`,
  retry: "Try again",
  errors: (count: number) => (count === 1 ? "A lesson has an error" : "Lessons have errors"),
  all: "All lessons",
  previous: "Previous lesson",
  next: "Next lesson",
  print: "Print this lesson",
  printed: (address: string) => `Tetrafront, ${address}`,
  name: (lesson: number, title: string) => `${lesson} ${title}`,
  done: (done: number, tasks: number) => (done === tasks ? "done" : `${done} of ${tasks} tasks`),
  paper: "Löhner and Parikh 1988",
  section: (section: string) => `section ${section}`,
  paperLink: "https://doi.org/10.1002/fld.1650081003",
  preparing: "Recording the front of the model…",
  otherModel: "The view does not show the front of this lesson.",
  show: "Show it",
  modelLocked:
    "The model of a lesson is not edited, because the steps and numbers of the lesson hold for it only.",
  editModel: "Edit it nevertheless",
  goTo: "Go to the beginning of the lesson",
  tasks: "Tasks",
  taskDone: "Done",
  taskOpen: "Not done yet",
  reach: (target: keyof typeof targets) => `Reach ${targets[target]} with the player.`,
  color: (coloring: string) => `Choose the colour “${coloring}” under the player.`,
  answer: "Your answer",
  check: "Check",
  right: "Right.",
  wrong: "Not yet.",
  noNumber: "Type a number.",
  noChoice: "Choose an answer.",
  compare: (order: FrontOrder) => `Run in the order “${orders[order]}”`,
  running: "Running…",
  runs: "Runs to compare",
  runMeasure: "Number of",
  run: {
    crossings: "candidates that cross",
    smallCrossings: "– a small face",
    postponed: "postponed faces",
    flat: "flat elements",
  },
  runHint:
    "Small: less than half as large as the base face. Flat: with a dihedral angle below 5° when the front has closed. Click an order to see its front.",
  showRun: (order: FrontOrder) => `Show the front in the order “${orders[order]}”`,
  orders,
  experiments: {
    title: "Experiments",
    intro:
      "Run the model of this lesson with other rules and compare. The link in the address bar opens the same runs again.",
    hint: "Faces: faces that the search has looked at. Tests: faces that were tested for crossings side by side. Postp.: postponed faces. Recov.: steps of recovery. Angle: smallest dihedral angle. Ratio: mean radius ratio. Angle and ratio are those before any optimization. Filters and search change only the first two: the work, not the mesh.",
    order: "Order",
    relaxation: "Relaxed rules",
    filters: "Filters",
    tolerance: "Too close",
    search: "Search",
    searches: { grid: "hash grid", linear: "linear" },
    on: "on",
    off: "off",
    times: (factor: number) =>
      factor === 0 ? "never" : factor === 1 ? "usual distance" : `${factor} × the distance`,
    run: "Run with these rules",
    columns: ["Rules", "Faces", "Tests", "Postp.", "Recov.", "Angle", "Ratio"],
    count: short,
    name: (parts: readonly string[], order: FrontOrder) =>
      parts.map((part) => (part === "" ? orders[order] : (rules[part] ?? orderName(part)))).join(", "),
    show: (name: string) => `Show the front of the run: ${name}`,
    degrees: (angle: number) => `${angle.toFixed(1)}°`,
  },
  finished: "All tasks of this lesson are done.",
  restart: "Start this lesson again",
  costLinear: "linear search",
  costNear: "search in space",
  costText: (elements: number, linear: number, near: number) =>
    `For ${formatCount(elements)} elements, a linear search compares ${formatCount(linear)} faces; the search in space returns ${formatCount(near)}.`,
  costAxes: { across: "elements made", up: "faces compared" },
  /** A number on an axis. */
  axisNumber: short,
  queue: {
    picture: (faces: number, first: number | null) =>
      first === null
        ? "The queue of the front is empty."
        : `The queue of the front: ${formatCount(faces)} faces in a heap, face ${formatCount(first)} on top.`,
    first: "comes next",
    joined: "joined in this step",
    ruleClass: (ruleClass: number) => `class ${ruleClass}`,
    rankHint: {
      layered:
        "Below each face: its size bucket and its layers. The lower bucket comes first, in a bucket the lower layers.",
      "smallest-first": "Below each face: its size. The smaller face comes first.",
      "first-in": "The face that joined first comes first.",
      random: "The order was drawn at random.",
    } satisfies Readonly<Record<FrontOrder, string>>,
    failedHint: "Faces that have failed come after all others; they show their rule class.",
    below: (faces: number) => `${formatCount(faces)} faces below`,
    work: (taken: number, left: number, joined: number, comparisons: number, faces: number) =>
      `This step took face ${formatCount(taken)} from the top, ${left === 0 ? "" : `removed ${formatCount(left)} more, `}and added ${formatCount(joined)}. The heap compared faces ${formatCount(comparisons)} times. To find the smallest of ${formatCount(faces)} faces without a heap takes ${formatCount(Math.max(0, faces - 1))} comparisons.`,
    noWork: (faces: number) =>
      faces === 0
        ? "No face waits."
        : `${faces === 1 ? "1 face waits" : `${formatCount(faces)} faces wait`}. No parent comes after its two children.`,
  },
  number: formatCount,
} as const;
