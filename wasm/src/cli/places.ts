/** Which files a command reads and writes: told before any work where one would take the place of another. */
import { checkOutput, FileProblem, placeOf, STANDARD_STREAM } from "./files.js";
import { formatName } from "./input.js";
import { filesOf } from "../formats/file-formats.js";

/** A file and what it is to the command, such as "the input". */
export interface NamedFile {
  readonly words: string;
  readonly file: string;
}

/** A file that is read, with those that belong to it. */
export function inputFiles(file: string, format: string | undefined, words = "the input"): NamedFile[] {
  if (file === STANDARD_STREAM) return [];
  return [file, ...filesOf(formatName(file, format)).slice(1)].map((each) => ({ words, file: each }));
}

/** A file that is written, with those that its format puts beside it. Throws a FileProblem. */
export function outputFiles(file: string, format: string | undefined, words = "the output"): NamedFile[] {
  const others = filesOf(formatName(file, format)).slice(1);
  if (file === STANDARD_STREAM && others.length > 0) {
    throw new FileProblem("-", "this format has several files", "Give the name of a file.");
  }
  return [file, ...others].map((each) => ({ words, file: each }));
}

/** Throws a FileProblem where what is written would replace what is read, or something else that is written. */
export async function checkApart(read: readonly NamedFile[], written: readonly NamedFile[]): Promise<void> {
  const taken = new Map<string, NamedFile>();
  for (const { words, file } of read) {
    const place = await placeOf(file);
    if (place !== undefined) taken.set(place, { words, file });
  }
  for (const { words, file } of written) {
    const place = await placeOf(file);
    if (place === undefined) continue;
    const other = taken.get(place);
    if (other !== undefined) {
      throw new FileProblem(file, `${words} would replace ${other.words}`, `Give ${words} another name.`);
    }
    taken.set(place, { words, file });
  }
}

/** Throws a FileProblem where one of these cannot be written. */
export async function checkWritable(files: readonly NamedFile[]): Promise<void> {
  for (const { file } of files) await checkOutput(file);
}
