// A dye from a colour: the smoothest reflectance that looks like it under D65, as the program finds
// it. [Burns] section "LHTSS"

const HEX_NODES = {count: 36, first: 380, last: 730};

/** Linear R, G, B of `#rrggbb`; null for another text. */
function linearOfHex(hex) {
    const digits = /^#?([0-9a-f]{2})([0-9a-f]{2})([0-9a-f]{2})$/i.exec(hex.trim());
    return digits && digits.slice(1).map(pair => decodeSrgb(parseInt(pair, 16) / 255));
}

/** Newton's method from `state`, which it changes; true if it comes to `xyz`. */
function fitReflectance(weights, xyz, state) {
    const count = weights.length;
    for (let step = 0; step < 60; ++step) {
        const m = Array.from({length: count + 3}, () => new Array(count + 3).fill(0));
        const residual = new Array(count + 3).fill(0);
        for (let c = 0; c < 3; ++c) residual[count + c] = -xyz[c];
        for (let i = 0; i < count; ++i) {
            for (const j of [i - 1, i + 1]) // slope: the sum of (z_i+1 - z_i)^2
                if (j >= 0 && j < count) {
                    m[i][i] += 2;
                    m[i][j] -= 2;
                    residual[i] += 2 * (state[i] - state[j]);
                }
            const t = Math.tanh(state[i]), slope = 0.5 * (1 - t * t);
            for (let c = 0; c < 3; ++c) { // colour: the sum of weights R equals xyz
                const row = count + c, w = weights[i][c];
                residual[i] += w * slope * state[row];
                residual[row] += w * 0.5 * (t + 1);
                m[i][i] -= w * 2 * t * slope * state[row];
                m[i][row] = m[row][i] = w * slope;
            }
        }
        if (Math.max(...residual.map(Math.abs)) < 1e-10) return true;
        const change = solve(m, residual.map(v => [v]));
        if (!change || !Number.isFinite(change[0][0])) return false;
        change.forEach(([v], i) => { state[i] -= v; });
    }
    return false;
}

/** The reflectance of `#rrggbb`; null where there is none or the text is no colour. */
function reflectanceOfHex(hex) {
    const rgb = linearOfHex(hex);
    if (!rgb) return null;
    if (rgb[0] === rgb[1] && rgb[1] === rgb[2]) return new Array(SAMPLES).fill(rgb[0]);
    const d65 = page.d65;
    const {count, first, last} = HEX_NODES;
    const weights = lampMatrix(d65, hatWeights(count, first, last), '2');
    const white = xyzOf(d65, PERFECT_WHITE, '2');
    const xyz = times(inverse(page.display.rgb_from_xyz), rgb)
        .map((v, c) => v * white[c] / page.display.white[c]);
    const grey = white.map(v => xyz[1] * v);
    for (const legs of [1, 4, 16, 64, 256]) { // strong colours are reached by way of weaker ones
        const state = new Array(count + 3).fill(0);
        let there = true;
        for (let leg = 1; there && leg <= legs; ++leg)
            there = fitReflectance(weights, grey.map((v, c) => v + (xyz[c] - v) * leg / legs), state);
        if (there)
            return sampled(Array.from({length: count}, (_, i) => first + i * (last - first) / (count - 1)),
                           state.slice(0, count).map(z => 0.5 * (Math.tanh(z) + 1)));
    }
    return null;
}
