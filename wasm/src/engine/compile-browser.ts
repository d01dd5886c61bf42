import type { CompileModule } from "./instantiated.js";

export const compile: CompileModule = async ({ href }) => {
  const failed = (reason: unknown): never => {
    throw new Error(`${href}${reason instanceof Error ? `: ${String(reason)}` : ` ${String(reason)}`}`);
  };
  const response = await fetch(href).catch(failed);
  if (!response.ok) return failed(`is answered with HTTP status ${response.status}`);
  // Browsers compile while receiving only if the server states the right type.
  const isNamed = response.headers.get("Content-Type") === "application/wasm";
  const compiling = isNamed
    ? WebAssembly.compileStreaming(response)
    : response.arrayBuffer().then((bytes) => WebAssembly.compile(bytes));
  return compiling.catch(failed);
};
