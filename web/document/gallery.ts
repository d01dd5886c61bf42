import { parseProject, type Project } from "tetrafront";

/** One bundled sample project, as listed in public/index.json. */
export interface GalleryModel {
  readonly id: string;
  readonly title: string;
  readonly blurb: string;
  /** Models of one group stand together; the heading above them. */
  readonly group: string;
  /** Relative to the page. */
  readonly file: string;
}

export interface Gallery {
  /** Id of the model a first visitor sees. */
  readonly opening: string;
  readonly models: readonly GalleryModel[];
}

async function fetchJson(file: string): Promise<unknown> {
  const response = await fetch(new URL(file, document.baseURI));
  if (!response.ok) throw new Error(`${file} could not be loaded (${response.status})`);
  return response.json();
}

export async function loadGallery(): Promise<Gallery> {
  return (await fetchJson("index.json")) as Gallery;
}

export async function loadModel(model: GalleryModel): Promise<Project> {
  const read = parseProject(await fetchJson(model.file));
  if (read.success) return read.value;
  throw new Error(`${model.file}: ${read.problems[0].message}`);
}
