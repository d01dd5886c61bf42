/**
 * FNV-1a hash over 64-bit words, as cpp/src/base/fingerprint.h. JavaScript has no fast 64-bit integers, so the hash is
 * held as two halves.
 */

/** The prime of FNV-1a is 2^40 + 435. */
const LOW_OF_PRIME = 435;
const HALF = 2 ** 32;

export class Fingerprint {
  #high = 0xcbf29ce4;
  #low = 0x84222325;

  addDoubles(values: Float64Array): void {
    const double = new Float64Array(1);
    const halves = new DataView(double.buffer);
    for (const value of values) {
      // -0 and 0 are the same coordinate.
      halves.setFloat64(0, value + 0, true);
      this.#add(halves.getUint32(0, true), halves.getUint32(4, true));
    }
  }

  addIntegers(values: Uint32Array): void {
    for (const value of values) this.#add(value, 0);
  }

  /** Returns 16 hexadecimal digits. */
  text(): string {
    return hexadecimal(this.#high) + hexadecimal(this.#low);
  }

  #add(low: number, high: number): void {
    for (let shift = 0; shift < 32; shift += 8) this.#addByte((low >>> shift) & 0xff);
    for (let shift = 0; shift < 32; shift += 8) this.#addByte((high >>> shift) & 0xff);
  }

  #addByte(byte: number): void {
    const low = (this.#low ^ byte) >>> 0;
    const product = low * LOW_OF_PRIME;
    const carried = Math.floor(product / HALF) + this.#high * LOW_OF_PRIME + (low << 8);
    this.#low = product >>> 0;
    this.#high = carried >>> 0;
  }
}

const hexadecimal = (half: number): string => half.toString(16).padStart(8, "0");
