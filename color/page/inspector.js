// The pixel that is measured: its curve, colour and difference.

function makeInspector() {
    document.getElementById('pixel').append(
        element('p', {className: 'hint', id: 'pixel-place'}, 'Point at a picture, tap it, or move with the arrow keys.'),
        element('canvas', {className: 'chart', id: 'pixel-curve', 'aria-label': 'Share of the light that the pixel sends on, by wavelength'}),
        element('div', {className: 'readout', id: 'pixel-values'}));
}

function numbers(values) {
    return values.map(v => v.toFixed(1).replace('-', '−')).join('  ');
}

/** Adapted X, Y, Z of a pixel in a look. */
function pixelColour(dress, look, pixel) {
    return colourOfValues(dress.groups.map(group => planeValues(group, pixel)),
                          viewedColours(dress, look, app.view));
}

function showPixel() {
    if (!app.pixel) return;
    const {dress, x, y} = app.pixel, {view} = app, index = y * dress.width + x;
    const sides = view.mode === 'single' ? ['left'] : ['left', 'right'];
    const display = page.views.find(one => one.name === view.display);
    const colours = sides.map(side => pixelColour(dress, app.looks[side], index));
    const labs = colours.map(labOf);
    const rows = sides.flatMap((side, i) => [
        swatch(hexOf(displayed(display, colours[i]))),
        element('span', {}, `L* a* b*  ${numbers(labs[i])}`)]);
    if (sides.length > 1)
        rows.push(element('span', {className: 'difference'}, `ΔE₀₀  ${ciede2000(...labs).toFixed(2)}`));
    document.getElementById('pixel-values').replaceChildren(...rows);
    const curves = sides.map((side, i) => ({
        values: pixelCurve(dress, app.looks[side], index), filled: i === 0, dash: i ? [5, 4] : []}));
    const most = Math.max(...curves[0].values.slice(CHART_FIRST - FIRST_NM, CHART_LAST - FIRST_NM + 1));
    document.getElementById('pixel-place').textContent =
        `${page.dresses.length > 1 ? dress.name + ', ' : ''}column ${x}, row ${y}: share of the light that is sent on, ` +
        `by wavelength in nm; at most ${(100 * most).toFixed(1)} %`;
    drawChart(document.getElementById('pixel-curve'), curves);
}
