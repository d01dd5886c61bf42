import { readFile } from "node:fs/promises";
import type { CompileModule } from "./instantiated.js";

export const compile: CompileModule = async (address) => WebAssembly.compile(await readFile(address));
