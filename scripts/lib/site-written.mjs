import path from "node:path";

/**
 * Returns hooks of a plugin that call `work` with the folder of the built site when all its files are written, those of the public folder too;
 * one such plugin after the other. A failed build has no files, and prints its own error.
 */
export function whenWritten(work) {
  let folder = "";
  let isWritten = false;
  return {
    configResolved: ({ root, build: { outDir } }) => {
      folder = path.resolve(root, outDir);
    },
    writeBundle: () => {
      isWritten = true;
    },
    closeBundle: { sequential: true, handler: () => (isWritten ? work(folder) : undefined) },
  };
}
