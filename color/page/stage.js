// The pictures: a canvas each, the handle of the split view, the pixel under the pointer.

function makeStage() {
    const stage = document.getElementById('stage');
    for (const dress of page.dresses) {
        dress.canvas = element('canvas', {
            width: dress.width, height: dress.height, tabIndex: 0, role: 'img',
            'aria-label': `${dress.name}; arrow keys move the pixel that is measured`});
        dress.context = dress.canvas.getContext('2d');
        dress.handle = element('div', {
            className: 'handle', tabIndex: 0, role: 'slider', 'aria-label': 'Place of the split',
            'aria-valuemin': 0, 'aria-valuemax': 100});
        dress.mark = element('div', {className: 'mark', hidden: true});
        dress.captions = [element('span'), element('span')];
        dress.below = [
            element('div', {className: 'legend'}, element('span', {}, 'ΔE₀₀ 0'),
                element('i', {style: {background: `linear-gradient(90deg, ${legendColours()})`}}),
                element('span', {className: 'largest'})),
            element('figcaption', {}, dress.captions)];
        stage.append(element('figure', {className: 'dress'},
            element('div', {className: 'frame'}, dress.canvas, dress.handle, dress.mark), dress.below));
        followSplit(dress);
        followPixel(dress);
    }
    new ResizeObserver(fitPictures).observe(stage);
}

/** Sizes the pictures so that all are in sight, side by side, as long as none gets too narrow. */
function fitPictures() {
    const narrowest = 150, below = 64, gap = 20; // pixels of the screen
    const stage = document.getElementById('stage'), style = getComputedStyle(stage);
    const room = side => parseFloat(style[`padding${side}`]);
    const width = (stage.clientWidth - room('Left') - room('Right') + gap) / page.dresses.length - gap;
    const height = stage.clientHeight - room('Top') - room('Bottom') - below;
    for (const dress of page.dresses) {
        const scale = Math.min(Math.max(width, narrowest) / dress.width, height / dress.height);
        Object.assign(dress.canvas.style, {
            width: `${scale * dress.width}px`, height: `${scale * dress.height}px`});
    }
    placeOverlays();
}

function legendColours() {
    return LEGEND.map(hexOf).join(',');
}

/** Puts handle and mark where split and pixel are. */
function placeOverlays() {
    const {view, pixel} = app;
    for (const dress of page.dresses) {
        const {offsetLeft: left, offsetTop: top, offsetWidth: width, offsetHeight: height} = dress.canvas;
        for (const below of dress.below) below.style.width = `${width}px`;
        Object.assign(dress.handle.style, {
            left: `${left + view.split * width}px`, top: `${top}px`, height: `${height}px`});
        dress.handle.setAttribute('aria-valuenow', Math.round(100 * view.split));
        dress.mark.hidden = pixel?.dress !== dress;
        if (!dress.mark.hidden)
            Object.assign(dress.mark.style, {
                left: `${left + (pixel.x + 0.5) / dress.width * width}px`,
                top: `${top + (pixel.y + 0.5) / dress.height * height}px`});
    }
}

function followSplit(dress) {
    const move = split => {
        app.view.split = clamp(split, 0, 1);
        changed();
    };
    dress.handle.addEventListener('pointerdown', event => dress.handle.setPointerCapture(event.pointerId));
    dress.handle.addEventListener('pointermove', event => {
        if (!dress.handle.hasPointerCapture(event.pointerId)) return;
        const box = dress.canvas.getBoundingClientRect();
        move((event.clientX - box.left) / box.width);
    });
    dress.handle.addEventListener('keydown', event => {
        const by = {ArrowLeft: -0.01, ArrowRight: 0.01, Home: -1, End: 1}[event.key];
        if (by === undefined) return;
        event.preventDefault();
        move(app.view.split + by);
    });
}

function followPixel(dress) {
    const at = event => {
        const box = dress.canvas.getBoundingClientRect();
        choosePixel(dress, Math.floor((event.clientX - box.left) / box.width * dress.width),
                    Math.floor((event.clientY - box.top) / box.height * dress.height));
    };
    dress.canvas.addEventListener('pointermove', at);
    dress.canvas.addEventListener('pointerdown', at);
    dress.canvas.addEventListener('keydown', event => {
        const [dx, dy] = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1]}[event.key] ?? [];
        if (dx === undefined) return;
        event.preventDefault();
        const step = event.shiftKey ? 1 : 8;
        const {x, y} = app.pixel?.dress === dress ? app.pixel : {x: dress.width >> 1, y: dress.height >> 1};
        choosePixel(dress, x + step * dx, y + step * dy);
    });
}

function choosePixel(dress, x, y) {
    app.pixel = {dress, x: clamp(x, 0, dress.width - 1), y: clamp(y, 0, dress.height - 1)};
    placeOverlays();
    showPixel();
}

/** What stands under a picture. */
function writeCaptions() {
    const {looks, view} = app;
    for (const dress of page.dresses) {
        const name = page.dresses.length > 1 ? element('b', {}, `${dress.name} `) : '';
        dress.captions[0].replaceChildren(name, lookLabel(looks.left));
        dress.captions[1].replaceChildren(view.mode === 'single' ? '' : lookLabel(looks.right));
    }
    for (const end of document.querySelectorAll('.largest')) end.textContent = `${view.largest}`;
}
