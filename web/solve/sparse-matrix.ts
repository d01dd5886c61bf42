/**
 * A sparse matrix in compressed rows of square blocks: the blocks of row i are rowStarts[i] ≤ k < rowStarts[i + 1], block k is in
 * column columns[k], and its entries are values[k · size² …], row by row.
 */
export class SparseMatrix {
  /** Rows and columns of a block: unknowns per node. */
  readonly size: number;
  readonly rowStarts: Uint32Array;
  readonly columns: Uint32Array;
  readonly values: Float64Array;

  /** A matrix of zeros, with a block for every two nodes that share an element. */
  constructor(nodeCount: number, tetrahedra: Uint32Array, size: number) {
    const { rowStarts, columns } = patternOf(nodeCount, tetrahedra);
    this.size = size;
    this.rowStarts = rowStarts;
    this.columns = columns;
    this.values = new Float64Array(size * size * columns.length);
  }

  /** Number of unknowns. */
  get order(): number {
    return this.size * (this.rowStarts.length - 1);
  }

  /** Returns the index in `values` of the first entry of a block. The block must exist. */
  blockAt(row: number, column: number): number {
    let low = this.rowStarts[row] ?? 0;
    let high = this.rowStarts[row + 1] ?? 0;
    while (low + 1 < high) {
      const middle = (low + high) >> 1;
      if ((this.columns[middle] ?? 0) <= column) low = middle;
      else high = middle;
    }
    return low * this.size * this.size;
  }

  /** Adds to one entry of a block. */
  add(at: number, value: number): void {
    this.values[at] = (this.values[at] ?? 0) + value;
  }

  /** Writes the product with a vector to `out`. */
  multiply(x: Float64Array, out: Float64Array): void {
    if (this.size === 1) this.#multiplyScalar(x, out);
    else this.#multiplyBlocks(x, out);
  }

  #multiplyScalar(x: Float64Array, out: Float64Array): void {
    const { rowStarts, columns, values } = this;
    for (let row = 0; row < out.length; ++row) {
      const end = rowStarts[row + 1] ?? 0;
      let sum = 0;
      for (let k = rowStarts[row] ?? 0; k < end; ++k) sum += (values[k] ?? 0) * (x[columns[k] ?? 0] ?? 0);
      out[row] = sum;
    }
  }

  #multiplyBlocks(x: Float64Array, out: Float64Array): void {
    const { rowStarts, columns, values, size } = this;
    out.fill(0);
    for (let row = 0; row + 1 < rowStarts.length; ++row) {
      const end = rowStarts[row + 1] ?? 0;
      for (let k = rowStarts[row] ?? 0; k < end; ++k) {
        const column = size * (columns[k] ?? 0);
        let at = k * size * size;
        for (let i = 0; i < size; ++i) {
          let sum = 0;
          for (let j = 0; j < size; ++j) sum += (values[at++] ?? 0) * (x[column + j] ?? 0);
          out[size * row + i] = (out[size * row + i] ?? 0) + sum;
        }
      }
    }
  }

  /** Returns the entries on the diagonal. */
  diagonal(): Float64Array {
    const diagonal = new Float64Array(this.order);
    for (let row = 0; row + 1 < this.rowStarts.length; ++row) {
      if (this.rowStarts[row] === this.rowStarts[row + 1]) continue;
      const block = this.blockAt(row, row);
      for (let k = 0; k < this.size; ++k)
        diagonal[this.size * row + k] = this.values[block + k * (this.size + 1)] ?? 0;
    }
    return diagonal;
  }
}

/** Returns which nodes share an element: the neighbours of each node, itself among them, ascending. */
function patternOf(
  nodeCount: number,
  tetrahedra: Uint32Array,
): { readonly rowStarts: Uint32Array; readonly columns: Uint32Array } {
  const { starts, elements } = elementsAtNodes(nodeCount, tetrahedra);
  const rowStarts = new Uint32Array(nodeCount + 1);
  const stamps = new Int32Array(nodeCount).fill(-1);
  const columns: Uint32Array[] = [];
  const row: number[] = [];
  for (let node = 0; node < nodeCount; ++node) {
    row.length = 0;
    for (let k = starts[node] ?? 0; k < (starts[node + 1] ?? 0); ++k) {
      const first = 4 * (elements[k] ?? 0);
      for (let corner = first; corner < first + 4; ++corner) {
        const other = tetrahedra[corner] ?? 0;
        if (stamps[other] === node) continue;
        stamps[other] = node;
        row.push(other);
      }
    }
    columns.push(Uint32Array.from(row).sort());
    rowStarts[node + 1] = (rowStarts[node] ?? 0) + row.length;
  }
  const all = new Uint32Array(rowStarts[nodeCount] ?? 0);
  columns.forEach((part, node) => all.set(part, rowStarts[node]));
  return { rowStarts, columns: all };
}

/** Returns the elements around each node: those of node n are elements[starts[n] … starts[n + 1] − 1]. */
function elementsAtNodes(nodeCount: number, tetrahedra: Uint32Array) {
  const starts = new Uint32Array(nodeCount + 1);
  for (const node of tetrahedra) starts[node + 1] = (starts[node + 1] ?? 0) + 1;
  for (let node = 0; node < nodeCount; ++node)
    starts[node + 1] = (starts[node + 1] ?? 0) + (starts[node] ?? 0);
  const next = starts.slice();
  const elements = new Uint32Array(tetrahedra.length);
  for (let corner = 0; corner < tetrahedra.length; ++corner) {
    const node = tetrahedra[corner] ?? 0;
    const at = next[node] ?? 0;
    elements[at] = corner >> 2;
    next[node] = at + 1;
  }
  return { starts, elements };
}
