/**
 * Sparse Cholesky factors of normal equations, whose pattern is that of the loops: joints of one loop see each other.
 *
 * The order of the joints comes with the data. The pattern of the factor is found once; a factor is made column by
 * column, each from those to the left that reach it. Columns side by side with the same rows below them are a block,
 * whose columns are taken two at a time.
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
    this.blocks = blocks(rows);
    this.pairs = paired(this.blocks);
    this.work = new Float64Array(joints);
    const count = this.blocks.length - 1;
    this.reach = { first: new Int32Array(joints), next: new Int32Array(count), left: new Int32Array(count) };
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
   * Return what solves (A^T A + m) x = b, x in the place of b, and m.
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
    const { starts, rows, work, blocks } = this;
    const { first, next, left } = this.reach; // of a column, the first block that reaches it next; rows a block has left
    first.fill(-1);
    for (let block = 0; block + 1 < blocks.length; block++) {
      const begin = blocks[block], end = blocks[block + 1];
      for (let j = begin; j < end; j++) {
        const from = starts[j], to = starts[j + 1];
        for (let p = from; p < to; p++) work[rows[p]] = values[p];
        for (let other = first[j]; other !== -1; ) {
          const after = next[other];
          this.#subtract(values, blocks[other], blocks[other + 1], left[other]);
          left[other] -= 1;
          this.#link(other);
          other = after;
        }
        this.#subtract(values, begin, j, to - from);
        const root = Math.sqrt(work[j]);
        values[from] = root;
        for (let p = from + 1; p < to; p++) values[p] = work[rows[p]] / root;
      }
      left[block] = starts[end] - starts[end - 1] - 1;
      this.#link(block);
    }
  }

  /**
   * Note a block at the column that it reaches next.
   *
   * @param {number} block
   */
  #link(block) {
    const { first, next, left } = this.reach;
    if (!left[block]) return;
    const reached = this.rows[this.starts[this.blocks[block + 1]] - left[block]];
    next[block] = first[reached];
    first[reached] = block;
  }

  /**
   * Take what columns of a block contribute to the first of their last rows off the column that is worked on.
   *
   * @param {Float64Array} values
   * @param {number} begin
   * @param {number} end - Of the columns.
   * @param {number} count - Of the rows, the last of all these columns.
   */
  #subtract(values, begin, end, count) {
    const { starts, rows, work } = this;
    let k = begin;
    for (; k + 1 < end; k += 2) {
      const p = starts[k + 1] - count, to = starts[k + 1], shift = starts[k + 2] - to;
      const one = values[p], other = values[p + shift];
      for (let q = p; q < to; q++) work[rows[q]] -= one * values[q] + other * values[q + shift];
    }
    if (k === end) return;
    const p = starts[k + 1] - count, to = starts[k + 1], factor = values[p];
    for (let q = p; q < to; q++) work[rows[q]] -= factor * values[q];
  }

  /**
   * Put the solution in the place of what is given.
   *
   * @param {Float64Array} values
   * @param {Float64Array} given
   */
  #solved(values, given) {
    const { size, order, work } = this;
    for (let j = 0; j < size; j++) work[order[j]] = given[j];
    this.#forwards(values);
    this.#backwards(values);
    for (let j = 0; j < size; j++) given[j] = work[order[j]];
    return given;
  }

  /** @param {Float64Array} values */
  #forwards(values) {
    const { starts, rows, work, pairs } = this;
    for (let n = 0; n + 1 < pairs.length; n++) {
      const j = pairs[n], from = starts[j];
      const one = (work[j] /= values[from]);
      if (pairs[n + 1] === j + 1) {
        for (let p = from + 1; p < starts[j + 1]; p++) work[rows[p]] -= values[p] * one;
        continue;
      }
      const begin = starts[j + 1], shift = starts[j + 2] - begin;
      const other = work[j + 1] = (work[j + 1] - values[from + 1] * one) / values[begin];
      for (let p = begin + 1; p < begin + shift; p++) work[rows[p]] -= values[p - shift] * one + values[p] * other;
    }
  }

  /** @param {Float64Array} values */
  #backwards(values) {
    const { starts, rows, work, pairs } = this;
    for (let n = pairs.length - 2; n >= 0; n--) {
      const j = pairs[n], from = starts[j];
      let one = work[j];
      if (pairs[n + 1] === j + 1) {
        for (let p = from + 1; p < starts[j + 1]; p++) one -= values[p] * work[rows[p]];
        work[j] = one / values[from];
        continue;
      }
      const begin = starts[j + 1], shift = starts[j + 2] - begin;
      let other = work[j + 1];
      for (let p = begin + 1; p < begin + shift; p++) {
        const below = work[rows[p]];
        one -= values[p - shift] * below;
        other -= values[p] * below;
      }
      work[j + 1] = other /= values[begin];
      work[j] = (one - values[from + 1] * other) / values[from];
    }
  }
}

/**
 * Return where blocks of columns begin: each but the last has the rows of the next one, and its own.
 *
 * @param {Int32Array[]} rows - Of each column.
 */
function blocks(rows) {
  const joins = (/** @type {Int32Array} */ one, /** @type {number} */ j) =>
    j > 0 && rows[j - 1][1] === j && rows[j - 1].length === one.length + 1;
  return Int32Array.from([...rows.flatMap((one, j) => (joins(one, j) ? [] : [j])), rows.length]);
}

/**
 * Return where columns begin that are taken two at a time, or alone where a block ends.
 *
 * @param {Int32Array} blocks
 */
function paired(blocks) {
  const made = [];
  for (let n = 0; n + 1 < blocks.length; n++) for (let j = blocks[n]; j < blocks[n + 1]; j += 2) made.push(j);
  return Int32Array.from([...made, blocks[blocks.length - 1]]);
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
