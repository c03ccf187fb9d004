// Curves over wavelength, 380 to 730 nm, on a canvas.

const CHART_FIRST = 380, CHART_LAST = 730;

/** Canvas of the size that its style gives it, cleared. */
function freshCanvas(canvas) {
    const scale = window.devicePixelRatio || 1, box = canvas.getBoundingClientRect();
    canvas.width = Math.max(1, Math.round(box.width * scale));
    canvas.height = Math.max(1, Math.round(box.height * scale));
    const context = canvas.getContext('2d');
    context.scale(scale, scale);
    return {context, width: box.width, height: box.height};
}

function chartX(nm, width) {
    return (nm - CHART_FIRST) / (CHART_LAST - CHART_FIRST) * width;
}

/** A colour that stands for a wavelength: its tristimulus values brought into the display. */
function wavelengthColour(nm) {
    const {x, y, z} = page.observers['2'], i = nm - FIRST_NM;
    const rgb = times(page.display.rgb_from_xyz, [x[i], y[i], z[i]].map(v => v + 0.18));
    const most = Math.max(...rgb, 1e-3);
    return hexOf(rgb.map(v => Math.pow(clamp(v / most, 0, 1), 1 / 2.2)));
}

function spectrumGradient(context, width) {
    const gradient = context.createLinearGradient(0, 0, width, 0);
    for (let nm = CHART_FIRST; nm <= CHART_LAST; nm += 10)
        gradient.addColorStop((nm - CHART_FIRST) / (CHART_LAST - CHART_FIRST), wavelengthColour(nm));
    return gradient;
}

function trace(context, values, width, height, top) {
    context.beginPath();
    for (let nm = CHART_FIRST; nm <= CHART_LAST; ++nm)
        context.lineTo(chartX(nm, width), height - 2 - values[nm - FIRST_NM] / top * (height - 6));
}

/** Draws curves [{values, colour, filled, dash}] from 0 to `top`, with ticks at each 100 nm.
 *  Without a `top` the largest value is at the upper edge. */
function drawChart(canvas, curves, top) {
    const {context, width, height} = freshCanvas(canvas);
    if (width < 2) return; // it is hidden
    const ink = getComputedStyle(canvas).color;
    const inner = height - 16;
    const most = top ?? Math.max(1e-9, ...curves.flatMap(
        curve => curve.values.slice(CHART_FIRST - FIRST_NM, CHART_LAST - FIRST_NM + 1)));
    context.font = '11px system-ui, sans-serif';
    context.textAlign = 'center';
    for (let nm = 400; nm <= 700; nm += 100) {
        context.globalAlpha = 0.18;
        context.fillStyle = ink;
        context.fillRect(chartX(nm, width), 0, 1, inner);
        context.globalAlpha = 0.75;
        context.fillText(`${nm}`, chartX(nm, width), height - 3);
    }
    for (const curve of curves) {
        if (curve.filled) {
            trace(context, curve.values, width, inner, most);
            context.lineTo(width, inner);
            context.lineTo(0, inner);
            context.globalAlpha = 0.55;
            context.fillStyle = spectrumGradient(context, width);
            context.fill();
        }
        context.globalAlpha = 1;
        trace(context, curve.values, width, inner, most);
        context.strokeStyle = curve.colour ?? ink;
        context.lineWidth = curve.filled ? 1.25 : 2;
        context.setLineDash(curve.dash ?? []);
        context.stroke();
        context.setLineDash([]);
    }
    context.globalAlpha = 0.5;
    context.fillStyle = ink;
    context.fillRect(0, inner, width, 1);
    context.globalAlpha = 1;
}
