// Chromatic adaptation, CIELAB, CIEDE2000, and the display.

/** Takes X, Y, Z under `white` to those that an eye adapted by `degree` (0 to 1) sees under the
 *  display's white; the program's matrix for 0 and 1. [CIE159] */
function adaptationMatrix(white, degree) {
    const cones = page.adaptation.cones, from = times(cones, white), to = times(cones, page.display.white);
    if (degree === 0 || from.some(v => !(v > 0)))
        return [[1, 0, 0], [0, 1, 0], [0, 0, 1]];
    const scaled = cones.map((row, i) => row.map(v => v * (degree * to[i] / from[i] + 1 - degree)));
    return product(inverse(cones), scaled);
}

/** L*, a*, b* beside the display's white. [CIE015] section 8 */
function labOf(xyz) {
    const f = xyz.map((v, c) => {
        const t = v / page.display.white[c];
        return t > 216 / 24389 ? Math.cbrt(t) : (24389 / 27 * t + 16) / 116;
    });
    return [116 * f[1] - 16, 500 * (f[0] - f[1]), 200 * (f[1] - f[2])];
}

/** [Sharma] Eqs. 2 to 22, with k_L = k_C = k_H = 1. */
function ciede2000([l1, a1, b1], [l2, a2, b2]) {
    const degree = Math.PI / 180;
    const meanChroma7 = Math.pow((Math.hypot(a1, b1) + Math.hypot(a2, b2)) / 2, 7);
    const g = 1.5 - 0.5 * Math.sqrt(meanChroma7 / (meanChroma7 + Math.pow(25, 7)));
    const c1 = Math.hypot(g * a1, b1), c2 = Math.hypot(g * a2, b2);
    const h1 = Math.atan2(b1, g * a1), h2 = Math.atan2(b2, g * a2);
    let turn = 0, hue = h1 + h2; // where a colour is grey, the sum is the other's hue
    if (c1 * c2 > 0) {
        turn = Math.atan2(Math.sin(h2 - h1), Math.cos(h2 - h1));
        hue = h1 + turn / 2;
    }
    const l = (l1 + l2) / 2 - 50, c = (c1 + c2) / 2;
    const t = 1 - 0.17 * Math.cos(hue - 30 * degree) + 0.24 * Math.cos(2 * hue) +
              0.32 * Math.cos(3 * hue + 6 * degree) - 0.2 * Math.cos(4 * hue - 63 * degree);
    let hueDegrees = hue / degree % 360;
    if (hueDegrees < 0) hueDegrees += 360;
    const c7 = Math.pow(c, 7);
    const rotation = -Math.sin(60 * degree * Math.exp(-Math.pow((hueDegrees - 275) / 25, 2))) *
                     2 * Math.sqrt(c7 / (c7 + Math.pow(25, 7)));
    const dl = (l2 - l1) / (1 + 0.015 * l * l / Math.sqrt(20 + l * l));
    const dc = (c2 - c1) / (1 + 0.045 * c);
    const dh = 2 * Math.sqrt(c1 * c2) * Math.sin(turn / 2) / (1 + 0.015 * c * t);
    return Math.sqrt(dl * dl + dc * dc + dh * dh + rotation * dc * dh);
}

/** Linear light of a code of sRGB, both 0 to 1. [IEC61966] */
function decodeSrgb(code) {
    return code <= 0.04045 ? code / 12.92 : Math.pow((code + 0.055) / 1.055, 2.4);
}

/** What a display view makes of linear light: codes at equal steps of light / (light + half). */
function displayCode(view, light) {
    const shown = Math.max(light, 0);
    const place = clamp(shown / (shown + view.half) / view.step, 0, view.code.length - 1);
    const cell = Math.min(Math.floor(place), view.code.length - 2);
    return view.code[cell] + (place - cell) * (view.code[cell + 1] - view.code[cell]);
}

/** R, G, B in 0..1 of adapted X, Y, Z. */
function displayed(view, xyz) {
    return times(page.display.rgb_from_xyz, xyz).map(light => displayCode(view, light));
}

/** `#rrggbb` of R, G, B in 0..1. */
function hexOf(rgb) {
    return '#' + rgb.map(v => Math.round(255 * clamp(v, 0, 1)).toString(16).padStart(2, '0')).join('');
}
