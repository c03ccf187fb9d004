// Controls of the dye: the named ones, a colour, a curve that is drawn, a file.

function chosenDyes() {
    return app.dye === 'all' ? openDyes() : [app.dye];
}

/** The dye that the controls show: as chosen, or that of the first dress that has it. */
function shownDye() {
    const name = chosenDyes()[0];
    return look().dyes[name] ?? {label: 'as rendered', reflectance: page.dresses.flatMap(dress => dress.channels.dyes ?? [])
        .find(dye => dye.name === name).reflectance};
}

function setDye(dye) {
    for (const name of chosenDyes()) look().dyes[name] = dye;
    changed();
}

function dyeHex(reflectance) {
    const d65 = page.d65, white = xyzOf(d65, PERFECT_WHITE, '2');
    const xyz = xyzOf(d65, reflectance, '2').map((v, c) => v / white[c] * page.display.white[c]);
    return hexOf(times(page.display.rgb_from_xyz, xyz).map(v => displayCode(plainView(), v)));
}

function dyeChips() {
    return element('div', {className: 'chips dyes'}, page.dyes.map(dye => {
        dye.hex ??= dyeHex(dye.reflectance);
        return element('button', {
            'aria-pressed': shownDye().label === dye.name,
            onclick: () => { setDye({label: dye.name, reflectance: dye.reflectance}); showDye(); }},
            swatch(dye.hex), dye.name);
    }));
}

function useHex(hex) {
    const reflectance = reflectanceOfHex(hex);
    if (reflectance) setDye({label: '#' + hex.replace('#', ''), reflectance});
    else say(linearOfHex(hex) ? `No smooth reflectance has the colour ${hex}` : 'A colour is written as #rrggbb');
    showDye();
}

function colourRow() {
    const hex = dyeHex(shownDye().reflectance);
    const text = element('input', {type: 'text', value: hex, 'aria-label': 'Colour as #rrggbb', spellcheck: false});
    text.addEventListener('change', () => useHex(text.value));
    const picker = element('input', {type: 'color', value: hex, 'aria-label': 'Colour'});
    picker.addEventListener('input', () => useHex(picker.value));
    return element('div', {className: 'row'}, picker, text, fileButton('Open a dye …', 'dye'));
}

/** Lets a pointer, or the arrow keys, draw the reflectance. */
function dyeDrawing() {
    const canvas = element('canvas', {className: 'chart drawing', id: 'dye-curve', tabIndex: 0, role: 'img',
        'aria-label': 'Reflectance of the dye; draw it, or move along it with left and right and change it with up and down'});
    let last = null, cursor = 550;
    const draw = (from, to) => {
        const values = [...shownDye().reflectance];
        const [low, high] = from.nm < to.nm ? [from, to] : [to, from];
        for (let nm = Math.round(low.nm); nm <= Math.round(high.nm); ++nm) {
            const share = high.nm > low.nm ? clamp((nm - low.nm) / (high.nm - low.nm), 0, 1) : 0;
            values[nm - FIRST_NM] = low.value + share * (high.value - low.value);
        }
        if (low.nm <= CHART_FIRST + 1) values.fill(low.value, 0, CHART_FIRST - FIRST_NM + 1);
        if (high.nm >= CHART_LAST - 1) values.fill(high.value, CHART_LAST - FIRST_NM);
        setDye({label: 'drawn', reflectance: values});
        showDyeCurve();
    };
    const point = event => {
        const box = canvas.getBoundingClientRect();
        return {nm: clamp(CHART_FIRST + (event.clientX - box.left) / box.width * (CHART_LAST - CHART_FIRST), CHART_FIRST, CHART_LAST),
                value: clamp((box.bottom - 18 - event.clientY) / (box.height - 22), 0, 1)};
    };
    canvas.addEventListener('pointerdown', event => {
        canvas.setPointerCapture(event.pointerId);
        last = point(event);
        draw(last, last);
    });
    canvas.addEventListener('pointermove', event => {
        if (!last) return;
        const now = point(event);
        draw(last, now);
        last = now;
    });
    for (const end of ['pointerup', 'pointercancel']) canvas.addEventListener(end, () => { last = null; });
    canvas.addEventListener('keydown', event => {
        const along = {ArrowLeft: -10, ArrowRight: 10}[event.key], up = {ArrowUp: 0.03, ArrowDown: -0.03}[event.key];
        if (along === undefined && up === undefined) return;
        event.preventDefault();
        cursor = clamp(cursor + (along ?? 0), CHART_FIRST, CHART_LAST);
        if (up)
            setDye({label: 'drawn', reflectance: shownDye().reflectance.map((v, i) =>
                clamp(v + up * Math.exp(-Math.pow((FIRST_NM + i - cursor) / 15, 2)), 0, 1))});
        showDyeCurve(cursor);
    });
    return canvas;
}

/** @param cursor a wavelength that is marked, nm */
function showDyeCurve(cursor) {
    const canvas = document.getElementById('dye-curve');
    if (!canvas) return;
    const {label, reflectance} = shownDye();
    drawChart(canvas, [{values: reflectance, filled: true}], 1);
    if (cursor) canvas.getContext('2d').fillRect(chartX(cursor, canvas.getBoundingClientRect().width), 0, 1.5, 134);
    document.getElementById('dye-words').textContent = `${label}. Draw on the curve to change the reflectance.`;
}

function showDye() {
    const dyes = openDyes(), parent = document.getElementById('dye');
    if (dyes.length === 0) {
        parent.replaceChildren(element('p', {className: 'hint'}, 'The dye of this picture is fixed.'));
        return;
    }
    const choice = element('div', {className: 'segmented'});
    fillSegmented(choice, [['all', 'All'], ...dyes.map(name => [name, name])], app.dye, name => {
        app.dye = name;
        showDye();
    });
    parent.replaceChildren(...(dyes.length > 1 ? [choice] : []), dyeChips(), colourRow(), dyeDrawing(),
                           element('p', {className: 'hint', id: 'dye-words'}));
    showDyeCurve();
}
