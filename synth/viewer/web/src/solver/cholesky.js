/**
 * Sparse Cholesky factors of normal equations, whose pattern is that of the loops: joints of one loop see each other.
 *
 * The order of the joints comes with the data. The pattern of the factor is found once; a factor is made column by
 * column, each from those to the left that reach it.
 */

/** @import { Loop } from "./closure.js" */

export class NormalPattern {
  /**
   * @param {number} joints
   * @param {Loop[]} loops
   * @param {number[]} order - Where each joint goes.
   */
  constructor(joints, loops, order) {
    this.size = joints;
    this.order = Int32Array.from(order);
    const rows = filled(joints, loops, this.order);
    this.starts = new Int32Array(joints + 1);
    for (let j = 0; j < joints; j++) this.starts[j + 1] = this.starts[j] + rows[j].length;
    this.rows = new Int32Array(this.starts[joints]);
    for (let j = 0; j < joints; j++) this.rows.set(rows[j], this.starts[j]);
    this.goals = loops.map((loop) => this.#goals(loop));
  }

  /**
   * Return where the products of two columns of a loop go, pair by pair: first of 0, then of 0 and 1, ...
   *
   * @param {Loop} loop
   */
  #goals({ joints }) {
    const goals = [];
    for (let i = 0; i < joints.length; i++) {
      for (let j = 0; j <= i; j++) {
        const one = this.order[joints[i]], other = this.order[joints[j]];
        const column = Math.min(one, other), row = Math.max(one, other);
        const from = this.starts[column];
        goals.push(from + this.rows.subarray(from, this.starts[column + 1]).indexOf(row));
      }
    }
    return Int32Array.from(goals);
  }

  /**
   * Return what solves (A^T A + m) x = b, and m.
   *
   * @param {Loop[]} loops
   * @param {Float64Array} derivatives - A, loop by loop.
   * @param {number} part - m, in parts of the largest diagonal entry.
   * @returns {{solve: (given: Float64Array) => Float64Array, regular: number}}
   */
  solver(loops, derivatives, part) {
    const values = new Float64Array(this.rows.length);
    loops.forEach((loop, number) => addSquares(loop, derivatives, this.goals[number], values));
    let largest = 1;
    for (let j = 0; j < this.size; j++) largest = Math.max(largest, values[this.starts[j]]);
    const regular = part * largest;
    for (let j = 0; j < this.size; j++) values[this.starts[j]] += regular;
    this.#factorise(values);
    return { solve: (given) => this.#solved(values, given), regular };
  }

  /**
   * Put the factor in the place of the matrix.
   *
   * @param {Float64Array} values
   */
  #factorise(values) {
    const { size, starts, rows } = this;
    const work = new Float64Array(size);
    const first = new Int32Array(size).fill(-1); // of each column, the first of those that reach it next
    const next = new Int32Array(size).fill(-1);
    const reached = new Int32Array(size); // where in a column its next row is
    for (let j = 0; j < size; j++) {
      const from = starts[j], to = starts[j + 1];
      for (let p = from; p < to; p++) work[rows[p]] = values[p];
      for (let k = first[j]; k !== -1; ) {
        const after = next[k], end = starts[k + 1];
        let p = reached[k];
        const factor = values[p];
        for (let q = p; q < end; q++) work[rows[q]] -= factor * values[q];
        p += 1;
        if (p < end) {
          reached[k] = p;
          next[k] = first[rows[p]];
          first[rows[p]] = k;
        }
        k = after;
      }
      const root = Math.sqrt(work[j]);
      values[from] = root;
      for (let p = from + 1; p < to; p++) values[p] = work[rows[p]] / root;
      if (from + 1 < to) {
        reached[j] = from + 1;
        next[j] = first[rows[from + 1]];
        first[rows[from + 1]] = j;
      }
    }
  }

  /**
   * @param {Float64Array} values
   * @param {Float64Array} given
   */
  #solved(values, given) {
    const { size, starts, rows, order } = this;
    const x = new Float64Array(size);
    for (let j = 0; j < size; j++) x[order[j]] = given[j];
    for (let j = 0; j < size; j++) {
      const here = (x[j] /= values[starts[j]]);
      for (let p = starts[j] + 1; p < starts[j + 1]; p++) x[rows[p]] -= values[p] * here;
    }
    for (let j = size - 1; j >= 0; j--) {
      let sum = x[j];
      for (let p = starts[j] + 1; p < starts[j + 1]; p++) sum -= values[p] * x[rows[p]];
      x[j] = sum / values[starts[j]];
    }
    const found = new Float64Array(size);
    for (let j = 0; j < size; j++) found[j] = x[order[j]];
    return found;
  }
}

/**
 * Return the rows of each column of the factor, in order, the diagonal first.
 *
 * @param {number} size
 * @param {Loop[]} loops
 * @param {Int32Array} order
 * @returns {Int32Array[]}
 */
function filled(size, loops, order) {
  const below = Array.from({ length: size }, (_, j) => new Set([j]));
  for (const { joints } of loops) {
    for (const one of joints) {
      for (const other of joints) if (order[other] > order[one]) below[order[one]].add(order[other]);
    }
  }
  return below.map((rows, column) => {
    const sorted = Int32Array.from(rows).sort();
    if (sorted.length > 1) for (const row of sorted.subarray(1)) below[sorted[1]].add(row);
    if (sorted[0] !== column) throw new Error(`column ${column} of the factor begins above its diagonal`);
    return sorted;
  });
}

/**
 * Add the products of the columns of a loop's derivatives.
 *
 * @param {Loop} loop
 * @param {Float64Array} derivatives
 * @param {Int32Array} goals
 * @param {Float64Array} values
 */
function addSquares({ joints, equations, start }, derivatives, goals, values) {
  const k = joints.length;
  for (let i = 0, n = 0; i < k; i++) {
    for (let j = 0; j <= i; j++, n++) {
      let sum = 0;
      for (let e = 0, at = start; e < equations; e++, at += k) sum += derivatives[at + i] * derivatives[at + j];
      values[goals[n]] += sum;
    }
  }
}
