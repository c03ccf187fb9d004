// Small matrices as rows, and the steps that several files share.

/** The matrix product a b. */
function product(a, b) {
    return a.map(row => b[0].map((_, j) => row.reduce((sum, v, k) => sum + v * b[k][j], 0)));
}

/** The matrix times a vector. */
function times(matrix, vector) {
    return matrix.map(row => row.reduce((sum, v, k) => sum + v * vector[k], 0));
}

/** x of m x = b by elimination with row exchange; b has any number of columns. Null if m is singular. */
function solve(m, b) {
    const size = m.length;
    const rows = m.map((row, i) => [...row, ...b[i]]);
    for (let i = 0; i < size; ++i) {
        let pivot = i;
        for (let row = i + 1; row < size; ++row)
            if (Math.abs(rows[row][i]) > Math.abs(rows[pivot][i])) pivot = row;
        [rows[i], rows[pivot]] = [rows[pivot], rows[i]];
        if (!(Math.abs(rows[i][i]) > 0)) return null;
        for (let row = 0; row < size; ++row) {
            const factor = row === i ? 0 : rows[row][i] / rows[i][i];
            if (factor !== 0)
                for (let column = i; column < rows[row].length; ++column)
                    rows[row][column] -= factor * rows[i][column];
        }
    }
    return rows.map((row, i) => row.slice(size).map(v => v / row[i]));
}

/** The inverse of a matrix. */
function inverse(m) {
    return solve(m, m.map((_, i) => m.map((_, j) => (i === j ? 1 : 0))));
}

function clamp(value, low, high) {
    return Math.min(Math.max(value, low), high);
}
