/** Makes instances of the compiled modules. */

/** A WebAssembly.Module, under a name that also exists without the types of browsers. */
export type CompiledModule = object;

/** Fetches and compiles the file; the reason of a failure names the file. */
export type CompileModule = (address: URL) => Promise<CompiledModule>;

type ReceiveInstance = (instance: WebAssembly.Instance, module: WebAssembly.Module) => void;

/** `create`: the function that Emscripten makes for a module. */
export async function instantiated<Instance>(
  create: (options: { readonly instantiateWasm: unknown }) => Promise<Instance>,
  compiled: CompiledModule,
): Promise<Instance> {
  const module = compiled as WebAssembly.Module;
  return new Promise<Instance>((resolve, reject) => {
    // Emscripten's own promise does not report failures in this function.
    const instantiateWasm = (imports: WebAssembly.Imports, receive: ReceiveInstance) => {
      WebAssembly.instantiate(module, imports)
        .then((instance) => receive(instance, module))
        .catch(reject);
      return {};
    };
    create({ instantiateWasm }).then(resolve, reject);
  });
}
