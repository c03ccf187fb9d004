// Spectra are arrays of one value a nanometre, from FIRST_NM to LAST_NM.

const FIRST_NM = 360, LAST_NM = 830, SAMPLES = LAST_NM - FIRST_NM + 1;
const WAVELENGTHS = Array.from({length: SAMPLES}, (_, i) => FIRST_NM + i);

/** Samples of a curve: linear between its points, constant beyond the first and the last. Of a
 *  curve with more points than samples, means about them, so that sums over them are integrals. */
function sampled(nanometres, values) {
    if (nanometres.length <= SAMPLES) return valuesAt(WAVELENGTHS, nanometres, values);
    const parts = 20; // of a nanometre
    const fine = Array.from({length: parts * (SAMPLES + 1) + 1}, (_, i) => FIRST_NM - 1 + i / parts);
    const all = valuesAt(fine, nanometres, values);
    return WAVELENGTHS.map((_, s) => {
        let mean = 0;
        for (let i = 1 - parts; i < parts; ++i)
            mean += (1 - Math.abs(i) / parts) / parts * all[(s + 1) * parts + i];
        return mean;
    });
}

/** Values of a curve at wavelengths that increase. */
function valuesAt(wavelengths, nanometres, values) {
    let next = 0;
    return wavelengths.map(nm => {
        while (next < nanometres.length && nanometres[next] < nm) ++next;
        if (next === 0) return values[0];
        if (next === nanometres.length) return values[values.length - 1];
        const share = (nm - nanometres[next - 1]) / (nanometres[next] - nanometres[next - 1]);
        return values[next - 1] + share * (values[next] - values[next - 1]);
    });
}

/** A file of `nm,value` lines; empty lines, lines with # and one header are passed over. Throws an
 *  Error that says the line. */
function spectrumOfText(text) {
    const nanometres = [], values = [];
    text.split(/\r\n|\r|\n/).forEach((line, i) => {
        if (/^\s*(#|$)/.test(line)) return;
        const cells = line.trim().split(/[,;\t ]+/).map(cell => Number(cell));
        if (cells.length < 2 || cells.slice(0, 2).some(cell => !Number.isFinite(cell))) {
            if (nanometres.length === 0 && !/^\s*[-+.\d]/.test(line)) return; // a header
            throw new Error(`line ${i + 1} is no pair of a wavelength and a value`);
        }
        if (nanometres.length && !(cells[0] > nanometres[nanometres.length - 1]))
            throw new Error(`line ${i + 1}: the wavelengths do not increase`);
        if (cells[1] < 0) throw new Error(`line ${i + 1}: a value is below 0`);
        nanometres.push(cells[0]);
        values.push(cells[1]);
    });
    if (nanometres.length < 2) throw new Error('fewer than two lines of wavelength and value');
    if (nanometres[0] > 500 || nanometres[nanometres.length - 1] < 600)
        throw new Error(`${nanometres[0]} to ${nanometres[nanometres.length - 1]} nm do not cover ` +
                        'the visible range; wavelengths are in nanometres');
    return sampled(nanometres, values);
}

/** Planck's law, relative. [CIE015] */
function blackbody(kelvin) {
    const c2 = 1.4388e7; // nm K
    const power = nm => 1 / (Math.pow(nm / 560, 5) * Math.expm1(c2 / (nm * kelvin)));
    const scale = 100 / power(560);
    return WAVELENGTHS.map(nm => scale * power(nm));
}

// The mean and the two components of daylight, from 360 nm, a row each 10 nm. [CIE015] table 6
const DAYLIGHT = [
    [61.5, 38, 5.3], [68.8, 42.4, 6.1], [63.4, 38.5, 3], [65.8, 35, 1.2], [94.8, 43.4, -1.1],
    [104.8, 46.3, -0.5], [105.9, 43.9, -0.7], [96.8, 37.1, -1.2], [113.9, 36.7, -2.6],
    [125.6, 35.9, -2.9], [125.5, 32.6, -2.8], [121.3, 27.9, -2.6], [121.3, 24.3, -2.6],
    [113.5, 20.1, -1.8], [113.1, 16.2, -1.5], [110.8, 13.2, -1.3], [106.5, 8.6, -1.2],
    [108.8, 6.1, -1], [105.3, 4.2, -0.5], [104.4, 1.9, -0.3], [100, 0, 0], [96, -1.6, 0.2],
    [95.1, -3.5, 0.5], [89.1, -3.5, 2.1], [90.5, -5.8, 3.2], [90.3, -7.2, 4.1], [88.4, -8.6, 4.7],
    [84, -9.5, 5.1], [85.1, -10.9, 6.7], [81.9, -10.7, 7.3], [82.6, -12, 8.6], [84.9, -14, 9.8],
    [81.3, -13.6, 10.2], [71.9, -12, 8.3], [74.3, -13.3, 9.6], [76.4, -12.9, 8.5],
    [63.3, -10.6, 7], [71.7, -11.6, 7.6], [77, -12.2, 8], [65.2, -10.2, 6.7], [47.7, -7.8, 5.2],
    [68.6, -11.2, 7.4], [65, -10.4, 6.8], [66, -10.6, 7], [61, -9.7, 6.4], [53.3, -8.3, 5.5],
    [58.9, -9.3, 6.1], [61.9, -9.8, 6.5]];

/** A phase of daylight of 4000 to 25000 K. [CIE015] Eqs. 3.3 to 3.5 */
function daylight(kelvin) {
    const t = 1000 / kelvin;
    const x = kelvin <= 7000 ? 0.244063 + t * (0.09911 + t * (2.9678 - 4.607 * t))
                             : 0.23704 + t * (0.24748 + t * (1.9018 - 2.0064 * t));
    const y = -3 * x * x + 2.87 * x - 0.275;
    const m = 0.0241 + 0.2562 * x - 0.7341 * y;
    const m1 = (-1.3515 - 1.7703 * x + 5.9114 * y) / m;
    const m2 = (0.03 - 31.4424 * x + 30.0717 * y) / m;
    return sampled(DAYLIGHT.map((_, i) => FIRST_NM + 10 * i),
                   DAYLIGHT.map(([s0, s1, s2]) => Math.max(0, s0 + m1 * s1 + m2 * s2)));
}

/** The spectrum divided by its luminous power, so that shares of a mixture are shares of light. */
function ofUnitLight(spectrum) {
    const y = page.observers['2'].y;
    const light = spectrum.reduce((sum, v, i) => sum + v * y[i], 0);
    return spectrum.map(v => v / light);
}

/** (1 - share) of the first and `share` of the second, by luminous power. */
function mixed(first, second, share) {
    const a = ofUnitLight(first), b = ofUnitLight(second);
    return a.map((v, i) => (1 - share) * v + share * b[i]);
}
