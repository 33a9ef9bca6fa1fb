/** Small systems of equations: shares of a few joints that are held or driven together. */

/**
 * Return what solves a symmetric system without negative eigenvalues; unknowns that depend on others are zero.
 *
 * Elimination takes the largest entry of the diagonal first.
 *
 * @param {number[][]} matrix
 * @param {number[]} given
 * @param {number} zero - Pivots below this part of the largest entry of the diagonal are none.
 */
export function solvedSymmetric(matrix, given, zero) {
  const rows = matrix.map((row, i) => [...row, given[i]]);
  const size = rows.length;
  const least = zero * Math.max(0, ...matrix.map((row, i) => row[i]));
  /** @type {number[]} */
  const taken = [];
  const left = new Set(rows.keys());
  while (left.size) {
    const pivot = [...left].reduce((best, i) => (rows[i][i] > rows[best][best] ? i : best));
    if (!(rows[pivot][pivot] > least)) break;
    left.delete(pivot);
    taken.push(pivot);
    for (const i of left) {
      const factor = rows[i][pivot] / rows[pivot][pivot];
      for (const j of [...left, pivot, size]) rows[i][j] -= factor * rows[pivot][j];
    }
  }
  const found = Array(size).fill(0);
  for (const pivot of taken.reverse()) {
    const known = rows[pivot].reduce((sum, x, j) => (j === pivot || j === size ? sum : sum + x * found[j]), 0);
    found[pivot] = (rows[pivot][size] - known) / rows[pivot][pivot];
  }
  return found;
}
