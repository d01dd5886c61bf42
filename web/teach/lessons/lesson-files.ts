/** The files of the lessons in public/lessons: a list, a markdown file per lesson, and their own models. */
import { parseProject, type Project } from "tetrafront/project";
import { loadModel, type Gallery } from "../../session/gallery";
import { parseLesson, type Lesson, type ParsedLesson } from "./lesson";

/** Folder of the lessons, relative to the page. */
const folder = "lessons/";

/** The lessons that could be read, and what is wrong with the others. */
export interface Course {
  /** Lessons at their places in `index.json`; null for a file with errors. The number of a lesson is its place, from 1. */
  readonly lessons: readonly (Lesson | null)[];
  readonly errors: readonly string[];
}

/** Returns the text of a file of the lessons. Throws if it cannot be loaded. */
async function fetchText(file: string): Promise<string> {
  const response = await fetch(new URL(folder + file, document.baseURI));
  if (!response.ok) throw new Error(`${file} could not be loaded (${response.status})`);
  return response.text();
}

/** Loads all lessons in the order of `index.json`. A lesson with errors does not hide the others. */
export async function loadCourse(): Promise<Course> {
  const files = listOf(await fetchText("index.json"));
  const read = await Promise.all(files.map(readLesson));
  return {
    lessons: read.map((parsed) => (parsed.success ? parsed.lesson : null)),
    errors: read.flatMap((parsed) => (parsed.success ? [] : parsed.errors)),
  };
}

/** Returns the number of the nearest lesson before or after another one; null if there is none. */
export function lessonBeside({ lessons }: Course, number: number, direction: 1 | -1): number | null {
  let other = number + direction;
  while (other >= 1 && other <= lessons.length && !lessons[other - 1]) other += direction;
  return lessons[other - 1] ? other : null;
}

async function readLesson(file: string): Promise<ParsedLesson> {
  try {
    return parseLesson(file, await fetchText(file));
  } catch (error) {
    const reason = error instanceof Error ? error.message : String(error);
    return { success: false, errors: [`${reason}. Check its name in index.json.`] };
  }
}

/** Returns the names of the files in the order of the lessons. */
export function listOf(content: string): readonly string[] {
  const list: unknown = JSON.parse(content);
  const isList =
    Array.isArray(list) && list.every((name) => typeof name === "string" && name.endsWith(".md"));
  if (!isList) throw new Error("index.json must be a list of the names of markdown files");
  return list as readonly string[];
}

/** Loads the model of a lesson, with its order of the front. */
export async function loadLessonModel({ model, order }: Lesson, { models }: Gallery): Promise<Project> {
  const shown = models.find(({ id }) => id === model);
  const project = shown ? await loadModel(shown) : readModel(model, await fetchText(model));
  return { ...project, meshing: { ...project.meshing, order } };
}

function readModel(file: string, content: string): Project {
  const read = parseProject(JSON.parse(content));
  if (read.success) return read.value;
  throw new Error(`${file}: ${read.errors[0].message}`);
}
