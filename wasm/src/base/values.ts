/** Type tests for values of unknown type, and their words in messages. */

/** T as a caller without type checks may pass it. */
type Unchecked<T> = { readonly [Key in keyof T]?: unknown };

export function asObject<T>(value: T): Unchecked<T> {
  return typeof value === "object" && value !== null ? value : {};
}

/** Returns whether the value is an array of this type. Arrays of other realms (frames, test runners) count too. */
export function isArrayOf<T extends Float64Array | Uint32Array | Uint8Array>(
  type: { readonly name: string; readonly prototype: T },
  value: unknown,
): value is T {
  return ArrayBuffer.isView(value) && isA(type.name, value);
}

/** Returns whether the value is an instance of the named built-in class, in whatever realm it was made. */
export function isA(name: string, value: unknown): boolean {
  return Object.prototype.toString.call(value) === `[object ${name}]`;
}

/** Returns whether the buffer, or the buffer of a view, was transferred to another thread. */
export function isDetached(given: ArrayBufferView | ArrayBufferLike): boolean {
  if (given.byteLength > 0) return false;
  try {
    new Uint8Array(ArrayBuffer.isView(given) ? given.buffer : given);
    return false;
  } catch {
    return true;
  }
}

/** Returns a description of any value, for messages. */
export function shown(value: unknown): string {
  if (typeof value === "string") return `"${value}"`;
  if (Array.isArray(value)) return "a list";
  // "Float64Array", "Map", "Object": this name is right even if the object's own properties are not.
  if (typeof value === "object" && value !== null) return Object.prototype.toString.call(value).slice(8, -1);
  return typeof value === "function" ? "a function" : String(value);
}
