/** Type tests for values of unknown type, and their words in messages. */

/** What a caller without type checks may give in place of T. */
type Unchecked<T> = { readonly [Key in keyof T]?: unknown };

export function asObject<T>(value: T): Unchecked<T> {
  return typeof value === "object" && value !== null ? value : {};
}

/** Whether it is such an array, also one of another realm, as frames and tests have them. */
export function isArrayOf<T extends Float64Array | Uint32Array | Uint8Array>(
  type: { readonly name: string; readonly prototype: T },
  value: unknown,
): value is T {
  return ArrayBuffer.isView(value) && isA(type.name, value);
}

/** By the name that the language gives to the values of a class, whatever realm they are of. */
export function isA(name: string, value: unknown): boolean {
  return Object.prototype.toString.call(value) === `[object ${name}]`;
}

/** Whether a buffer, or that of a view, was transferred to somewhere else. */
export function isDetached(given: ArrayBufferView | ArrayBufferLike): boolean {
  if (given.byteLength > 0) return false;
  try {
    new Uint8Array(ArrayBuffer.isView(given) ? given.buffer : given);
    return false;
  } catch {
    return true;
  }
}

/** As words of any value, of whatever type. */
export function shown(value: unknown): string {
  if (typeof value === "string") return `"${value}"`;
  if (Array.isArray(value)) return "a list";
  // "Float64Array", "Map", "Object": by a name that no value can take away.
  if (typeof value === "object" && value !== null) return Object.prototype.toString.call(value).slice(8, -1);
  return typeof value === "function" ? "a function" : String(value);
}
