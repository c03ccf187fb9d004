// What the channels of a dress mean: the share of each at a wavelength.

/** Weight of each channel at the wavelengths, for dyes that are shown: [channel][nanometre]. */
function channelWeights(channels, dyes) {
    return channels.kind === 'depths' ? depthWeights(channels, dyes) : channels.weights;
}

/** The polynomial through the depths of dye, at the dyes' reflectances. */
function depthWeights(channels, dyes) {
    const values = reflectances => channels.degree.map(degree => channels.dyes.reduce((all, dye, d) => {
        const x = (2 * reflectances[d] - dye.lowest - dye.highest) / (dye.highest - dye.lowest);
        return all * Math.cos(degree[d] * Math.acos(clamp(x, -1, 1)));
    }, 1));
    channels.inverse ??= inverse(channels.node.map(values));
    const weights = channels.node.map(() => new Array(SAMPLES));
    for (let i = 0; i < SAMPLES; ++i) {
        const products = values(dyes.map(dye => dye[i]));
        for (let k = 0; k < weights.length; ++k)
            weights[k][i] = products.reduce((sum, v, p) => sum + v * channels.inverse[p][k], 0);
    }
    return weights;
}

/** X, Y, Z of each channel under the lamp; a perfect white has Y = 1. [CIE015] section 7.1 */
function lampMatrix(lamp, weights, observer) {
    const {x, y, z} = page.observers[observer];
    const white = lamp.reduce((sum, v, i) => sum + v * y[i], 0);
    return weights.map(weight => {
        const xyz = [0, 0, 0];
        for (let i = 0; i < SAMPLES; ++i) {
            const power = lamp[i] * weight[i] / white;
            xyz[0] += power * x[i];
            xyz[1] += power * y[i];
            xyz[2] += power * z[i];
        }
        return xyz;
    });
}

/** X, Y, Z of a reflectance under the lamp. */
function xyzOf(lamp, reflectance, observer) {
    return lampMatrix(lamp, [reflectance], observer)[0];
}

const PERFECT_WHITE = new Array(SAMPLES).fill(1);
