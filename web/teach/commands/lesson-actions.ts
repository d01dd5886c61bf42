/** Opens lessons, shows their models, and runs them by other rules. Loaded with the lessons. */
import type { FrontOrder, MeshReport } from "tetrafront";
import type { Trace } from "tetrafront/trace";
import { createStore, type StoreApi } from "zustand/vanilla";
import type { App } from "../../app/app";
import { meshKey } from "../../document/content-keys";
import { isShown } from "../lessons/check-task";
import { course, finishTask } from "../lessons/course";
import type { Lesson } from "../lessons/lesson";
import type { LessonAddress } from "../lessons/lesson-address";
import { loadLessonModel } from "../lessons/lesson-files";
import { rulesNamed } from "../lessons/run-rules";
import { firstState } from "../player/phases";
import type { PlayerState } from "../player/player";
import type { RecordingChoices } from "../player/recording";
import { isUntouched, settledProject } from "../../session/document-store";
import { untilState } from "../../session/until-state";
import { strings } from "../../strings";
import { addressStrings } from "../strings/address";
import { lessonStrings } from "../strings/lessons";
import { showAddressProblems } from "./address-problems";
import { showFailure } from "../../commands/messages";
import { showModel } from "../../commands/project-actions";
import { openLessonOf } from "./open-lesson";
import { playerOf } from "./player-of";

/** A recorded front of the model of a lesson. */
export interface LessonRun {
  /** Name of the rules by which it differs from the lesson's own run; empty for that. */
  readonly name: string;
  readonly order: FrontOrder;
  readonly trace: Trace;
  readonly file: Uint8Array<ArrayBuffer>;
  readonly report: MeshReport;
}

/** A document in a state of which all meshes are equal. */
interface ShownModel {
  readonly documentId: string;
  readonly meshKey: string;
}

/** The fronts that were recorded for the lesson whose model was shown last. */
export interface LessonRuns {
  readonly lesson: Lesson | null;
  /** Number of times that a model was opened for a lesson: what was begun before the last one must not go on. */
  readonly openings: number;
  /** The model of the lesson as it was opened; null until then. */
  readonly model: ShownModel | null;
  readonly runs: readonly LessonRun[];
  /** True while the model is being loaded and its front recorded. */
  readonly isPreparing: boolean;
}

const stores = new WeakMap<App, StoreApi<LessonRuns>>();

export function lessonRuns(app: App): StoreApi<LessonRuns> {
  const known = stores.get(app);
  if (known) return known;
  const made = createStore<LessonRuns>(() => ({
    lesson: null,
    openings: 0,
    model: null,
    runs: [],
    isPreparing: false,
  }));
  stores.set(app, made);
  playerOf(app).state.subscribe((state, before) => noteShown(made.getState(), state, before));
  return made;
}

/** Marks the tasks that are done by what the player shows, or by a step that it has played over since the state before. */
function noteShown({ lesson, runs }: LessonRuns, state: PlayerState, before: PlayerState): void {
  const { trace, step, coloring, isPlaying } = state;
  if (!lesson || !trace || !runs.some((run) => run.trace === trace)) return;
  const isPlayed = isPlaying && before.isPlaying && before.trace === trace;
  const after = isPlayed ? Math.min(before.step, step - 1) : step - 1;
  lesson.tasks.forEach((task, index) => {
    if (isShown(task, { trace, step, coloring, after })) finishTask(lesson, index);
  });
}

/** Opens the lesson of an address, shows its model, and runs it in further orders. Unknown numbers open the list, and are named. */
export async function openLessonNumber(
  app: App,
  { number, runs, step }: LessonAddress,
  asWritten = String(number),
): Promise<void> {
  app.shell.setState({ rightTab: "lessons", drawer: "right" });
  closeLesson(app);
  try {
    const { lessons } = await course();
    const lesson = lessons[number - 1];
    if (lesson) {
      if (isEditedModel(app, number)) continueLesson(app, lesson, number);
      else await openLesson(app, lesson, number, runs);
      if (step !== null && shownRun(app)) showStep(app, step);
    } else showAddressProblems(app, [addressStrings.noLesson(asWritten, lessons.length)]);
  } catch {
    // The panel says why, and offers to try again.
  }
}

/** Returns whether the document is the model of a lesson that the reader has changed, before the page was loaded again. */
function isEditedModel({ documents }: App, number: number): boolean {
  const state = documents.state.getState();
  return state.lesson === number && !isUntouched(state);
}

/** Opens a lesson beside its model as the reader has changed it. The page of the lesson offers to bring its own model back. */
function continueLesson(app: App, lesson: Lesson, number: number): void {
  openLessonOf(app).setState({ number });
  lessonRuns(app).setState({ lesson, model: null, runs: [] });
}

/** Shows the list of the lessons. The model that is open can be edited. */
export function closeLesson(app: App): void {
  openLessonOf(app).setState({ number: null });
  app.shell.setState({ lock: null });
}

/** Opens a lesson and shows its model. `number` is its place among the lessons, from 1; `runs`: as for `showLessonModel`. */
export async function openLesson(
  app: App,
  lesson: Lesson,
  number: number,
  runs: readonly string[] = [],
): Promise<void> {
  app.shell.setState({ rightTab: "lessons" });
  openLessonOf(app).setState({ number });
  await showLessonModel(app, lesson, runs);
}

/**
 * Shows the model of a lesson with its front, in the state where the lesson begins. The present document stays available, as
 * if an example were opened. `names`: further rules by which the model is run, to be compared.
 */
export async function showLessonModel(
  app: App,
  lesson: Lesson,
  names: readonly string[] = [],
): Promise<void> {
  const store = lessonRuns(app);
  const others = names.filter((name) => name !== lesson.order);
  const openings = store.getState().openings + 1;
  const isPresent = (): boolean => store.getState().openings === openings;
  openLessonOf(app).setState({ runs: others });
  store.setState({ lesson, openings, model: null, runs: [], isPreparing: true });
  try {
    const project = await loadLessonModel(lesson, app.gallery);
    // Another lesson was opened meanwhile, or this one again.
    if (!isPresent()) return;
    showModel(app, project, openLessonOf(app).getState().number);
    const model = shownModel(app);
    store.setState({ model });
    app.view.setTool("select");
    const { modelLocked: text, editModel: edit } = lessonStrings;
    // The list of the lessons may have been opened meanwhile.
    const isOpen = openLessonOf(app).getState().number !== null;
    const lock = isOpen ? { documentId: model.documentId, text, edit } : null;
    app.shell.setState({ bottomTab: "front", drawer: "right", lock });
    await untilState(app.run.state, ({ busy }) => !busy);
    if (!isPresent() || !isShownModel(app, model)) return;
    const own = await recordRun(app, lesson, "");
    if (!own) {
      if (isPresent()) openLessonOf(app).setState({ runs: [] });
      return;
    }
    store.setState({ runs: [own] });
    for (const name of others) if (!(await addRun(app, lesson, name))) break;
    if (!isPresent()) return;
    // The address names the runs that are in the table.
    const { runs } = store.getState();
    openLessonOf(app).setState({ runs: others.filter((name) => runs.some((run) => run.name === name)) });
    // If a run was stopped, one that is complete is shown; not in place of something that was opened meanwhile.
    if (!shownRun(app)) return;
    const [first = own] = runs;
    if (others.length > 0) playerOf(app).show(first.trace, first.file);
    showBeginning(app, lesson);
  } catch (error) {
    showFailure(app, strings.messages.openFailed(lesson.title), error);
  } finally {
    if (isPresent()) store.setState({ isPreparing: false });
  }
}

/** Shows a state of the front, or the nearest one with a notice that there is no such state. */
export function showStep(app: App, step: number): void {
  playerOf(app).seek(step);
  const { step: shown, trace } = playerOf(app).state.getState();
  if (!trace || shown === step) return;
  showAddressProblems(app, [addressStrings.noStep(step, firstState(trace), trace.stepCount, shown)]);
}

/** Shows the state in which a lesson begins. */
export function showBeginning(app: App, { step, coloring }: Lesson): void {
  const player = playerOf(app);
  player.pause();
  player.state.setState({ coloring });
  player.seek(step);
}

/**
 * Records the front of the present lesson in another order or by other rules, and shows it. If another document is open, or the
 * model was changed, opens the model of the lesson first. Returns whether this has succeeded.
 */
export async function compareRun(app: App, name: string): Promise<boolean> {
  const store = lessonRuns(app);
  const { lesson, model } = store.getState();
  if (!lesson) return false;
  if (!isShownModel(app, model)) await showLessonModel(app, lesson);
  const { openings, model: opened } = store.getState();
  if (store.getState().lesson !== lesson || !isShownModel(app, opened)) return false;
  const share = shownShare(app);
  const isAdded = await addRun(app, lesson, name);
  if (store.getState().openings === openings && shownRun(app)) seekShare(app, share);
  return isAdded;
}

/** Records the front of the model of a lesson by other rules, and shows it. Returns whether this has succeeded. */
async function addRun(app: App, lesson: Lesson, name: string): Promise<boolean> {
  const store = lessonRuns(app);
  const rules = rulesNamed(name);
  if (!rules) return false;
  const { order, filters, relaxation, tolerance, search } = rules;
  const experiment = { relaxation, tolerance, search };
  const run = await recordRun(app, lesson, name, { order: order ?? undefined, filters, experiment });
  if (!run) return false;
  const others = store.getState().runs.filter((other) => other.name !== name);
  store.setState({ runs: [...others, run] });
  const { runs: named } = openLessonOf(app).getState();
  if (name !== "" && !named.includes(name)) openLessonOf(app).setState({ runs: [...named, name] });
  return true;
}

/**
 * Records the front of the model of a lesson, and shows it. Returns null if this has failed, if the model was changed or another
 * lesson was opened, or if the user has stopped it: half a front cannot be compared, so what was shown before is shown again.
 */
async function recordRun(
  app: App,
  lesson: Lesson,
  name: string,
  choices: RecordingChoices = {},
): Promise<LessonRun | null> {
  const store = lessonRuns(app);
  const { openings, model } = store.getState();
  if (!isShownModel(app, model)) return null;
  const before = shownRun(app);
  const recorded = await playerOf(app).record(choices);
  if (store.getState().openings !== openings || !isShownModel(app, model) || recorded === null) return null;
  if (recorded.isStopped) {
    if (before) playerOf(app).show(before.trace, before.file);
    else playerOf(app).close();
    return null;
  }
  if (recorded.kind === "failed") return null;
  const { trace, file, report } = recorded;
  return { name, order: choices.order ?? lesson.order, trace, file, report };
}

/** Returns the run of the lesson that the player shows; undefined if it shows something else, or nothing. */
function shownRun(app: App): LessonRun | undefined {
  const { trace } = playerOf(app).state.getState();
  return lessonRuns(app)
    .getState()
    .runs.find((run) => run.trace === trace);
}

function shownModel({ documents }: App): ShownModel {
  const state = documents.state.getState();
  return { documentId: state.id, meshKey: meshKey(settledProject(state)) };
}

function isShownModel(app: App, model: ShownModel | null): boolean {
  const shown = shownModel(app);
  return model?.documentId === shown.documentId && model.meshKey === shown.meshKey;
}

/** Shows the front of a run, and keeps its share of the steps. */
export function showRun(app: App, { trace, file }: LessonRun): void {
  const share = shownShare(app);
  playerOf(app).show(trace, file);
  seekShare(app, share);
}

/** Returns the step that is shown, as a share of all steps; negative in lines and patches, 0 if no trace is shown. */
function shownShare(app: App): number {
  const { trace, step } = playerOf(app).state.getState();
  return trace ? step / Math.max(1, trace.stepCount) : 0;
}

function seekShare(app: App, share: number): void {
  const player = playerOf(app);
  player.seek(share * (player.state.getState().trace?.stepCount ?? 0));
}
