// The page: its state, and what happens when it changes.

// Spectra are sampled as they are read.
const page = JSON.parse(document.getElementById('page-data').textContent,
                        (_, value) => (value?.nm && value.value ? sampled(value.nm, value.value) : value));

/** What is shown. */
const app = {
    looks: {left: makeLook(page.shown[0], firstDye()), right: makeLook(page.shown[1] ?? page.shown[0], firstDye())},
    side: 'left',  // that the controls change
    group: 'all',  // light group that the lamp controls change
    dye: 'all',    // open dye that the dye controls change
    pixel: null,   // {dress, x, y}
    view: {mode: 'single', split: 0.5, largest: 10, ...page.look},
    renderer: null,
    frames: 0,     // how many were drawn
};

/** The first of the dyes that were asked for; null: as rendered. */
function firstDye() {
    const dye = page.dyes.find(one => one.name === page.first_dye);
    return dye ? {label: dye.name, reflectance: dye.reflectance} : null;
}

/** The look that the controls change. */
function look() {
    return app.looks[app.view.mode === 'single' ? 'left' : app.side];
}

/** Draws all pictures now. */
function draw() {
    for (const dress of page.dresses) app.renderer.draw(dress, app.looks, app.view);
    ++app.frames;
}

/** Something changed: draws before the next frame, and fills the report when changes pause. */
function changed() {
    if (!changed.waits)
        requestAnimationFrame(() => {
            changed.waits = false;
            draw();
            writeCaptions();
            placeOverlays();
            showPixel();
        });
    changed.waits = true;
    clearTimeout(changed.timer);
    changed.timer = setTimeout(showReport, 250);
}

function showControls() {
    document.body.dataset.mode = app.view.mode;
    fillSegmented(document.getElementById('modes'), [
        ['single', 'One look'], ['split', 'Split', 'Two looks, left and right of a handle'],
        ['difference', 'Difference', 'CIEDE2000 between the two looks']], app.view.mode, mode => {
        app.view.mode = mode;
        showControls();
        changed();
    });
    fillSegmented(document.getElementById('tabs'), [['light', 'Light'], ['dye', 'Dye'], ['view', 'View'], ['pixel', 'Pixel']],
                  document.body.dataset.tab, tab => {
                      document.body.dataset.tab = tab;
                      showControls();
                      showPixel();
                  });
    fillSegmented(document.getElementById('sides'), [['left', 'Left look'], ['right', 'Right look']], app.side, side => {
        app.side = side;
        showControls();
    });
    showLight();
    showDye();
    showView();
}

function followButtons() {
    document.getElementById('print').onclick = () => { showReport(); print(); };
    document.getElementById('save').onclick = () => {
        for (const dress of page.dresses)
            element('a', {href: dress.canvas.toDataURL('image/png'),
                          download: `${dress.name} ${lookLabel(app.looks.left)}.png`.replace(/[^\w.+-]+/g, '-')}).click();
    };
    document.getElementById('theme').onclick = () => useTheme(document.documentElement.dataset.theme === 'light' ? 'dark' : 'light');
}

function useTheme(theme) {
    document.documentElement.dataset.theme = theme;
    if (app.renderer) showControls();
}

async function start() {
    useTheme(matchMedia('(prefers-color-scheme: light)').matches ? 'light' : 'dark');
    for (const [i, dress] of page.dresses.entries()) {
        const packed = document.getElementById(`planes-${i}`);
        await unpack(dress, packed.textContent);
        packed.remove();
    }
    makeStage();
    app.renderer = new Renderer();
    makeInspector();
    followButtons();
    followDrops();
    draw();
    showControls();
    changed();
    say('');
}

// For scripts that drive the page, such as its test: the state, and what changes it.
window.tsuya = {
    page, app, draw, changed, showControls, reflectanceOfHex, spectrumOfText, takeSpectrum, labOf, ciede2000,
    garmentColour, pixelColour, daylight, legend: LEGEND,
    ready: start().catch(error => { say(error.message, true); throw error; }),
};
