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

  /** The hash as hexadecimal digits. */
  get text(): string {
    return [this.#a, this.#b].map((half) => (half >>> 0).toString(16).padStart(8, "0")).join("");
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
export function hashText(text: string): string {
  const hash = new Hash();
  for (let i = 0; i < text.length; ++i) hash.add(text.charCodeAt(i));
  return hash.text;
}
