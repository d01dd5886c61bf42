/** Odd constants of about 32 random bits, and the two initial states of the hash. */
const factors = [0x9e3779b1, 0x85ebca77] as const;
const seeds = [0x243f6a88, 0x13198a2e] as const;

/** A hash of 64 bits over whole numbers. */
export class Hash {
  #a: number = seeds[0];
  #b: number = seeds[1];

  add(value: number): void {
    this.#a = Math.imul(this.#a ^ value, factors[0]);
    this.#b = Math.imul(this.#b ^ value, factors[1]);
    this.#a ^= this.#b >>> 15;
    this.#b ^= this.#a >>> 13;
  }

  /** The hash as two numbers of 32 bits. */
  get halves(): readonly [number, number] {
    return [this.#a, this.#b];
  }

  /** The hash as hexadecimal digits. */
  get text(): string {
    return this.halves.map((half) => (half >>> 0).toString(16).padStart(8, "0")).join("");
  }
}

const scratch = new DataView(new ArrayBuffer(8));

/** Adds the 64 bits of a number. */
export function addReal(hash: Hash, value: number): void {
  scratch.setFloat64(0, value);
  hash.add(scratch.getUint32(0));
  hash.add(scratch.getUint32(4));
}

/** Hashes a text. Two different texts have the same hash with a probability of about 5e-20. */
export const hashText = (text: string): string => hashOfText(text).text;

function hashOfText(text: string): Hash {
  const hash = new Hash();
  for (let i = 0; i < text.length; ++i) hash.add(text.charCodeAt(i));
  return hash;
}

/**
 * Returns a function that hashes lists by texts of their records. Each list is hashed once. Records that the list before had
 * too, at the same place from its beginning or its end, are not hashed again.
 */
export function listHasher<Item extends object>(
  textOf: (item: Item) => string,
): (list: readonly Item[]) => string {
  const known = new WeakMap<readonly Item[], string>();
  let last: { readonly list: readonly Item[]; readonly halves: Int32Array } = {
    list: [],
    halves: new Int32Array(),
  };
  const halvesOf = (list: readonly Item[]): Int32Array => {
    const halves = new Int32Array(2 * list.length);
    const shift = last.list.length - list.length;
    let isStart = true;
    for (const [i, item] of list.entries()) {
      isStart &&= item === last.list[i];
      const before = isStart ? i : i + shift;
      const isSame = item === last.list[before];
      const [a, b] = isSame
        ? [last.halves[2 * before], last.halves[2 * before + 1]]
        : hashOfText(textOf(item)).halves;
      halves[2 * i] = a ?? 0;
      halves[2 * i + 1] = b ?? 0;
    }
    return halves;
  };
  return (list) => {
    let text = known.get(list);
    if (text !== undefined) return text;
    last = { list, halves: halvesOf(list) };
    const hash = new Hash();
    for (const half of last.halves) hash.add(half);
    text = hash.text;
    known.set(list, text);
    return text;
  };
}
