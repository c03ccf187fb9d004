// Controls of the view: exposure, adaptation, observer, display.

function showView() {
    const {view} = app;
    const set = name => value => { view[name] = value; changed(); };
    const observers = element('div', {className: 'segmented'}), displays = element('div', {className: 'segmented'});
    fillSegmented(observers, [['2', '2° observer'], ['10', '10° observer']], view.observer, value => {
        set('observer')(value);
        showView();
    });
    fillSegmented(displays, page.views.map(one => [one.name, one.name, one.description]), view.display, value => {
        set('display')(value);
        showView();
    });
    document.getElementById('view').replaceChildren(
        slider('Exposure', {min: Math.min(-4, view.exposure), max: Math.max(4, view.exposure), step: 0.05, value: view.exposure,
                            shown: v => `${v > 0 ? '+' : ''}${v.toFixed(2)} stops`}, set('exposure')),
        slider('Adaptation of the eye', {min: 0, max: 1, step: 0.01, value: view.degree,
                                         shown: v => `${Math.round(100 * v)} %`}, set('degree')),
        element('p', {className: 'hint'}, '0 %: as a camera set to daylight. 100 %: as an eye used to the light.'),
        slider('Largest difference in the map', {min: 1, max: 40, step: 1, value: view.largest,
                                                 shown: v => `ΔE₀₀ ${v}`}, set('largest')),
        element('div', {className: 'row'}, observers), element('div', {className: 'row'}, displays));
}
