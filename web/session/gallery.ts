import { parseProject, type Project } from "tetrafront/project";

/** One bundled sample project, as listed in public/index.json. */
export interface GalleryModel {
  readonly id: string;
  readonly title: string;
  readonly blurb: string;
  /** Heading above the models of a group, which are consecutive. */
  readonly group: string;
  /** Relative to the page. */
  readonly file: string;
}

/** The models under one heading of the gallery. */
export interface GalleryGroup {
  readonly title: string;
  readonly models: readonly GalleryModel[];
}

/** Order of the headings, the easiest first. Other groups follow in the order of the list. */
const groupOrder = [
  "First steps",
  "Curved patches",
  "Regions and cavities",
  "Background grid",
  "The paper's examples",
];

export function groupModels(models: readonly GalleryModel[]): readonly GalleryGroup[] {
  const titles = new Set([...groupOrder, ...models.map(({ group }) => group)]);
  return [...titles]
    .map((title) => ({ title, models: models.filter(({ group }) => group === title) }))
    .filter((group) => group.models.length > 0);
}

/** A picture of the meshed model, relative to the page. */
export const thumbnailOf = ({ id }: GalleryModel): string => `thumbnails/${id}.webp`;

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
  throw new Error(`${model.file}: ${read.errors[0].message}`);
}
