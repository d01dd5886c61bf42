/** Files that a command reads and writes: finds conflicts before any work is done. */
import { filesOf } from "../formats/file-formats.js";
import { checkOutput, FileError, fileIdentity, STANDARD_STREAM } from "./files.js";
import { formatName } from "./input.js";

/** File and its role in the command, such as "the input". */
export interface NamedFile {
  readonly words: string;
  readonly file: string;
}

/** Returns a file to be read, with its companions. */
export function inputFiles(file: string, format: string | undefined, words = "the input"): NamedFile[] {
  if (file === STANDARD_STREAM) return [];
  return [file, ...filesOf(formatName(file, format)).slice(1)].map((each) => ({ words, file: each }));
}

/** Returns the files of the input, or of all inputs that are joined. */
export function givenFiles(
  input: string,
  { joined, from }: { readonly joined?: readonly string[] | undefined; readonly from?: string | undefined },
): NamedFile[] {
  if (joined === undefined) return inputFiles(input, from);
  return joined.flatMap((file) => inputFiles(file, from, `the input ${file}`));
}

/** Returns a file to be written, with its companions. Throws a FileError. */
export function outputFiles(file: string, format: string | undefined, words = "the output"): NamedFile[] {
  const others = filesOf(formatName(file, format)).slice(1);
  if (file === STANDARD_STREAM && others.length > 0) {
    throw new FileError("-", "the format has several files", "Use the name of a file.");
  }
  return [file, ...others].map((each) => ({ words, file: each }));
}

/** Throws a FileError if a written file would replace a file that is read, or another one that is written. */
export async function checkNoOverwrite(
  read: readonly NamedFile[],
  written: readonly NamedFile[],
): Promise<void> {
  const taken = new Map<string, NamedFile>();
  for (const { words, file } of read) {
    const identity = await fileIdentity(file);
    if (identity !== undefined) taken.set(identity, { words, file });
  }
  for (const { words, file } of written) {
    const identity = await fileIdentity(file);
    if (identity === undefined) continue;
    const other = taken.get(identity);
    if (other !== undefined) {
      throw new FileError(file, `${words} would replace ${other.words}`, `Choose another name for ${words}.`);
    }
    taken.set(identity, { words, file });
  }
}

/** Throws a FileError if one of the files cannot be written. */
export async function checkWritable(files: readonly NamedFile[]): Promise<void> {
  for (const { file } of files) await checkOutput(file);
}
