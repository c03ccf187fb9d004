// Controls of the light: lamps, colour temperature, mixture, and the power of each light group.

const COOLEST = 1500, WARMEST = 15000; // of the slider, K

/** Light groups that the lamp controls change: all, or the chosen one. */
function chosenGroups() {
    return app.group === 'all' ? groupNames() : [app.group];
}

function chosenLamp() {
    return look().lamps[chosenGroups()[0]];
}

function changeLamp(change) {
    for (const group of chosenGroups()) look().lamps[group] = {...look().lamps[group], ...change};
    changed();
}

function lampHex(spectrum) {
    const rgb = times(page.display.rgb_from_xyz, xyzOf(spectrum, PERFECT_WHITE, '2')).map(v => Math.max(v, 0));
    const most = Math.max(...rgb);
    return hexOf(rgb.map(v => displayCode(plainView(), v / most)));
}

/** The view without a curve of its own, for swatches. */
function plainView() {
    return page.views.find(view => view.name === 'Plain');
}

function lampChips() {
    const {name, kelvin} = chosenLamp();
    return element('div', {className: 'chips lamps'}, page.lamps.map(lamp => {
        lamp.hex ??= lampHex(lamp.power);
        return element('button', {
            title: lamp.caption, 'aria-pressed': !kelvin && lamp.name === name,
            onclick: () => { changeLamp({name: lamp.name, kelvin: undefined}); showLight(); }},
            swatch(lamp.hex), element('span', {}, lamp.name, element('small', {}, lamp.caption.split(',')[0])));
    }));
}

/** Place on the slider, in mired steps, so that equal steps look equal. */
function temperatureSlider() {
    const lamp = chosenLamp();
    const colours = Array.from({length: 9}, (_, i) => lampHex(blackbody(kelvinAt(i / 8))));
    const field = slider('Colour temperature', {
        min: 0, max: 1, step: 0.001, value: placeOfKelvin(lamp.kelvin ?? 6500),
        shown: place => `${Math.round(kelvinAt(place) / 10) * 10} K`, track: `linear-gradient(90deg, ${colours})`},
        place => {
            const kelvin = Math.round(kelvinAt(place) / 10) * 10;
            changeLamp({kelvin, law: kelvin < 4000 ? 'blackbody' : lamp.law ?? 'daylight'});
            showLampCurve();
        });
    const laws = element('div', {className: 'segmented'});
    fillSegmented(laws, [['daylight', 'Daylight', 'Phases of daylight, from 4000 K'], ['blackbody', 'Blackbody', 'Glowing bodies']],
                  lamp.law ?? 'daylight', law => {
                      const kelvin = chosenLamp().kelvin ?? 6500;
                      changeLamp({law, kelvin: law === 'daylight' ? Math.max(kelvin, 4000) : kelvin});
                      showLight();
                  });
    field.append(laws);
    return field;
}

function kelvinAt(place) {
    return 1 / ((1 - place) / COOLEST + place / WARMEST);
}

function placeOfKelvin(kelvin) {
    return (1 / COOLEST - 1 / kelvin) / (1 / COOLEST - 1 / WARMEST);
}

function mixture() {
    const {second, share} = chosenLamp();
    const select = element('select', {'aria-label': 'Second lamp', onchange: () => {
        changeLamp({second: select.value || undefined, share: select.value ? chosenLamp().share || 0.5 : 0});
        showLight();
    }}, element('option', {value: ''}, 'no second lamp'),
        page.lamps.map(lamp => element('option', {value: lamp.name, selected: lamp.name === second}, `mixed with ${lamp.name}`)));
    return [element('div', {className: 'row'}, select), second ? slider('Share of the second', {
        min: 0, max: 1, step: 0.01, value: share, shown: v => `${Math.round(100 * v)} %`},
        v => { changeLamp({share: v}); showLampCurve(); }) : null];
}

function groupControls() {
    const names = groupNames();
    if (names.length < 2) return [];
    const choice = element('div', {className: 'segmented'});
    fillSegmented(choice, [['all', 'All lights'], ...names.map(name => [name, name])], app.group, group => {
        app.group = group;
        showLight();
    });
    return [choice];
}

function powerSliders() {
    return groupNames().map(name => slider(`Power of ${name}`, {
        min: 0, max: 3, step: 0.01, value: look().powers[name], shown: v => `${Math.round(100 * v)} %`},
        v => { look().powers[name] = v; changed(); }));
}

function showLampCurve() {
    drawChart(document.getElementById('lamp-curve'), [{values: lampSpectrum(chosenLamp()), filled: true}]);
    document.getElementById('lamp-words').textContent =
        chosenLamp().kelvin ? lampLabel(chosenLamp()) : `${lampLabel(chosenLamp())}: ${lampNamed(chosenLamp().name).caption}`;
}

function showLight() {
    document.getElementById('light').replaceChildren(
        ...groupControls(), lampChips(),
        element('canvas', {className: 'chart', id: 'lamp-curve', 'aria-label': 'Spectrum of the lamp'}),
        element('p', {className: 'hint', id: 'lamp-words'}),
        temperatureSlider(), ...mixture().filter(Boolean), ...powerSliders(),
        element('div', {className: 'row'}, fileButton('Open a lamp spectrum …', 'lamp')));
    showLampCurve();
}
