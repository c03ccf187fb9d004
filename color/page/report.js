// The table of the report: mean colours of each garment under the lamps of the call and in both
// looks, for reading and for print.

/** Rows [{label, xyz}] of a dress: the dye of the left look under each lamp, then the right look. */
function reportRows(dress) {
    const {looks, view} = app;
    const rows = page.shown.map(name => {
        const look = copyOfLook(looks.left);
        for (const group of Object.keys(look.lamps)) look.lamps[group] = {name};
        return {label: `${name}: ${lampNamed(name).caption}`, xyz: garmentColour(dress, look, view)};
    });
    const sides = view.mode === 'single' ? ['left'] : ['left', 'right'];
    for (const side of sides)
        rows.push({label: `${view.mode === 'single' ? 'as shown' : side}: ${lookLabel(looks[side])}`,
                   xyz: garmentColour(dress, looks[side], view)});
    return rows;
}

function showReport() {
    const {view, looks} = app;
    const display = page.views.find(one => one.name === view.display);
    const tables = page.dresses.map(dress => {
        const rows = reportRows(dress), labs = rows.map(row => labOf(row.xyz));
        return [element('h2', {}, dress.name), element('div', {className: 'wide'}, element('table', {},
            element('thead', {}, element('tr', {}, ['Mean colour of the garment', 'L*', 'a*', 'b*', 'C*', 'sRGB',
                `ΔE₀₀ to ${page.shown[0]}`].map(text => element('th', {scope: 'col'}, text)))),
            element('tbody', {}, rows.map((row, i) => {
                const [l, a, b] = labs[i], hex = hexOf(displayed(display, row.xyz));
                return element('tr', {}, element('td', {}, swatch(hex), row.label),
                    [l, a, b, Math.hypot(a, b)].map(v => element('td', {}, numbers([v]))),
                    element('td', {}, hex),
                    element('td', {}, ciede2000(labs[0], labs[i]).toFixed(2)));
            }))))];
    });
    const dyes = Object.values(looks.left.dyes).filter(Boolean).map(dye => dye.label).join(', ');
    const share = view.degree === 0 ? 'not adapted' : `adapted by ${page.adaptation.name}, ${Math.round(100 * view.degree)} %`;
    document.getElementById('report').replaceChildren(...tables.flat(), element('p', {className: 'hint'},
        `${dyes ? `Dye ${dyes}. ` : ''}Eye ${share}; observer ${view.observer}°; exposure ${view.exposure.toFixed(1)} stops. ` +
        `ΔE₀₀ is CIEDE2000. Packing of the picture: ΔE₀₀ ` +
        page.dresses.map(dress => `${dress.error.mean.toFixed(3)} in the mean, ${dress.error.p99.toFixed(2)} at the 99th percentile`).join('; ') + '.'));
}
