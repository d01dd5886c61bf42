/** Entities of a Gmsh 4.1 file. They hold the physical groups of elements and the surfaces that bound volumes. */
import type { ByteReader } from "./byte-reader.js";
import type { MshNumbers } from "./msh-numbers.js";
import type { MshVolumes } from "./msh-volumes.js";

export class MshEntities {
  readonly #reader: ByteReader;
  readonly #numbers: MshNumbers;
  readonly #volumes: MshVolumes;
  /** Physical tags by "dimension tag". */
  readonly #physical = new Map<string, readonly number[]>();

  constructor(reader: ByteReader, numbers: MshNumbers, volumes: MshVolumes) {
    this.#reader = reader;
    this.#numbers = numbers;
    this.#volumes = volumes;
  }

  /** Returns the physical tags of an entity; elements belong to the first. */
  groupsOf(dimension: number, tag: number): readonly number[] {
    return this.#physical.get(`${dimension} ${tag}`) ?? [];
  }

  /** Reads the section `$Entities`. */
  async read(): Promise<void> {
    this.#reader.endLine();
    await this.#eachEntity(() => undefined);
  }

  /**
   * Reads the section `$PartitionedEntities`: the entities of a partitioned mesh. They inherit the physical groups
   * of their parents.
   */
  async readPartitioned(): Promise<void> {
    const numbers = this.#numbers;
    this.#reader.endLine();
    numbers.size();
    await numbers.skipInts(2 * numbers.count("ghosts"));
    await this.#eachEntity(async () => {
      const parent = `${numbers.int()} ${numbers.int()}`;
      await numbers.skipInts(numbers.count("partitions"));
      return this.#physical.get(parent);
    });
  }

  /** `readParent` reads the numbers after the tag and returns the physical groups to inherit. */
  async #eachEntity(readParent: ReadParent): Promise<void> {
    const counts = [0, 1, 2, 3].map(() => this.#numbers.count("entities"));
    for (const [dimension, count] of counts.entries()) {
      for (let i = 0; i < count; i++) {
        await this.#reader.fill();
        await this.#readEntity(dimension, readParent);
      }
    }
  }

  async #readEntity(dimension: number, readParent: ReadParent): Promise<void> {
    const numbers = this.#numbers;
    const tag = numbers.int();
    const inherited = await readParent();
    if (inherited !== undefined) this.#physical.set(`${dimension} ${tag}`, inherited);
    for (let c = 0; c < (dimension === 0 ? 3 : 6); c++) numbers.double();
    const groups: number[] = [];
    for (let left = numbers.count("physical groups"); left > 0; left--) {
      if (this.#reader.isLow) await this.#reader.fill();
      // Negative if the entity has the opposite orientation in its group.
      groups.push(Math.abs(numbers.int()));
    }
    if (groups.length > 0) this.#physical.set(`${dimension} ${tag}`, groups);
    const around = dimension === 0 ? 0 : numbers.count("bounding entities");
    const [group] = this.groupsOf(dimension, tag);
    for (let b = 0; b < around; b++) {
      if (this.#reader.isLow) await this.#reader.fill();
      const bounding = numbers.int();
      if (dimension === 3 && group !== undefined) this.#volumes.bound(bounding, group);
    }
  }
}

type ReadParent = () => Promise<readonly number[] | undefined> | undefined;
