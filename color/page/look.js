// A look: what lights a dress and how it is dyed. There are two, `left` and `right`.

/** A lamp of a look: of the list, of a colour temperature, or a mixture with a second of the list. */
function lampSpectrum({name, kelvin, law, second, share}) {
    const first = kelvin ? (law === 'daylight' ? daylight(kelvin) : blackbody(kelvin))
                         : lampNamed(name).power;
    return second && share > 0 ? mixed(first, lampNamed(second).power, share) : first;
}

function lampLabel({name, kelvin, second, share}) {
    const first = kelvin ? `${Math.round(kelvin)} K` : name;
    return second && share > 0 ? `${first} + ${Math.round(100 * share)} % ${second}` : first;
}

function lampNamed(name) {
    return page.lamps.find(lamp => lamp.name === name);
}

/** Names of all light groups of the dresses. */
function groupNames() {
    return [...new Set(page.dresses.flatMap(dress => dress.groups.map(group => group.name)))];
}

/** Names of the dyes that may be changed. */
function openDyes() {
    return [...new Set(page.dresses.flatMap(
        dress => (dress.channels.dyes ?? []).filter(dye => dye.open).map(dye => dye.name)))];
}

/** A look of one lamp for all light groups. A dye is {label, reflectance}; without one a dress has
 *  the dye of its file. */
function makeLook(lampName, dye = null) {
    const look = {lamps: {}, powers: {}, dyes: {}};
    for (const group of groupNames()) {
        look.lamps[group] = {name: lampName};
        look.powers[group] = lampNamed(lampName).factor;
    }
    for (const name of openDyes()) look.dyes[name] = dye;
    return look;
}

/** The same look in values of its own. */
function copyOfLook(look) {
    return structuredClone(look);
}

/** The lamps and dye of a look in words. */
function lookLabel(look) {
    const lamps = [...new Set(Object.values(look.lamps).map(lampLabel))].join(' / ');
    const dyes = [...new Set(Object.values(look.dyes).filter(Boolean).map(dye => dye.label))].join(' / ');
    return dyes ? `${dyes} · ${lamps}` : lamps;
}

/** Reflectances of a dress' dyes in a look. */
function shownDyes(dress, look) {
    return (dress.channels.dyes ?? []).map(
        dye => (dye.open && look.dyes[dye.name]?.reflectance) || dye.reflectance);
}

/** Of a dress in a look: X, Y, Z that a unit of each plane adds, [group][plane], and the white to
 *  which the eye adapts: of all groups by the light that they bring to the garment. */
function lookColours(dress, look, observer) {
    const weights = channelWeights(dress.channels, shownDyes(dress, look));
    const white = [0, 0, 0];
    const groups = dress.groups.map(group => {
        const lamp = lampSpectrum(look.lamps[group.name]), power = look.powers[group.name];
        const channels = lampMatrix(lamp, weights, observer);
        const lampWhite = xyzOf(lamp, PERFECT_WHITE, observer);
        for (let c = 0; c < 3; ++c) white[c] += (power * group.garment[0] + 1e-9) * lampWhite[c];
        return [group.mean, ...group.directions].map(shares => [0, 1, 2].map(
            c => power * shares.reduce((sum, share, k) => sum + share * channels[k][c], 0)));
    });
    return {groups, white: white.map(v => v / white[1])};
}

/** The same, adapted and exposed as the view says: [plane of all groups] -> X, Y, Z beside the
 *  display's white. */
function viewedColours(dress, look, view) {
    const {groups, white} = lookColours(dress, look, view.observer);
    const adapt = adaptationMatrix(white, view.degree), exposure = Math.pow(2, view.exposure);
    return groups.flat().map(xyz => times(adapt, xyz).map(v => exposure * v));
}

/** X, Y, Z beside the display's white of plane values, [group][plane]. */
function colourOfValues(values, colours) {
    return values.flat().reduce(
        (sum, value, i) => sum.map((v, c) => v + value * colours[i][c]), [0, 0, 0]);
}

/** The mean colour of the garment. */
function garmentColour(dress, look, view) {
    return colourOfValues(dress.groups.map(group => group.garment), viewedColours(dress, look, view));
}

/** The share of its light that a pixel sends on, by wavelength: all groups by their power. */
function pixelCurve(dress, look, pixel) {
    const weights = channelWeights(dress.channels, shownDyes(dress, look));
    const channels = weights.map(() => 0);
    for (const group of dress.groups) {
        const values = planeValues(group, pixel), power = look.powers[group.name];
        [group.mean, ...group.directions].forEach((shares, i) => shares.forEach((share, k) => {
            channels[k] += power * values[i] * share;
        }));
    }
    return WAVELENGTHS.map((_, i) => channels.reduce((sum, t, k) => sum + t * weights[k][i], 0));
}
