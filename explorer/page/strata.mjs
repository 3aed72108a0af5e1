// SPDX-License-Identifier: Apache-2.0
// Strata over the square: which there are, and how many points each holds.

// The stratum [j/m, (j+1)/m), bounded by the doubles nearest to its fractions, that x is in.
export function stratumOf(x, m) {
  let j = Math.min(Math.floor(x * m), m - 1);
  while (j > 0 && x < j / m) j--;
  while (j + 1 < m && x >= (j + 1) / m) j++;
  return j;
}

// The divisor of n nearest to its root from below.
function divisor(n) {
  let d = Math.floor(Math.sqrt(n));
  while (n % d) d--;
  return d;
}

// The largest m with base^m <= n.
export function exponent(n, base) {
  let m = 0;
  for (let power = base; power <= n; power *= base) m++;
  return m;
}

// { columns, rows } of cells, or null for none, or too many to draw; { rooks } for n columns and n rows apart from each other.
export function strataOf(strata, n, limits) {
  if (strata.kind === "grid") {
    const columns = strata.columns || (strata.rows ? Math.max(1, Math.round(n / strata.rows)) : n / divisor(n));
    const rows = strata.rows || Math.max(1, Math.round(n / columns));
    return columns * rows <= limits.n ? { columns, rows } : null;
  }
  if (strata.kind === "rooks") return n <= limits.rooks_n ? { columns: n, rows: n, rooks: true } : null;
  if (strata.kind === "elementary") {
    const m = exponent(n, strata.base), j = Math.min(strata.split, m);
    return { columns: strata.base ** j, rows: strata.base ** (m - j) };
  }
  return null;
}

// Points in each cell ([column + row * columns]), or in each column and each row.
export function countPoints({ columns, rows, rooks }, points, axes) {
  const cells = new Uint32Array(rooks ? columns + rows : columns * rows);
  for (let i = 0; i < points.n; i++) {
    const column = stratumOf(points.xs[i * points.dim + axes[0]], columns);
    const row = stratumOf(points.xs[i * points.dim + axes[1]], rows);
    if (rooks) {
      cells[column]++;
      cells[columns + row]++;
    } else {
      cells[column + row * columns]++;
    }
  }
  return cells;
}

// How many each stratum should hold (null: not a whole number), and how many do, in words.
export function judgeStrata(layout, cells, n) {
  const { columns, rows, rooks } = layout;
  const each = rooks ? 1 : n / (columns * rows), whole = Number.isInteger(each);
  const good = cells.filter(count => count === each).length;
  if (!whole) return { each: null, text: `${columns} × ${rows} cells for ${n} points` };
  const what = rooks ? `${cells.length} columns and rows` : `${cells.length} cells of ${columns} × ${rows}`;
  return { each, text: `${good} of ${what} hold ${each === 1 ? "one point" : `${each} points`}` };
}
