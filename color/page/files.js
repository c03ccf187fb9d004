// Spectrum files that are opened or dropped: lamps and dyes.

function fileButton(label, kind) {
    const input = element('input', {type: 'file', accept: '.csv,.txt', hidden: true});
    input.addEventListener('change', () => {
        for (const file of input.files) takeFile(file, kind);
        input.value = '';
    });
    return element('span', {}, input, element('button', {title: 'Lines of wavelength in nm and value', onclick: () => input.click()}, label));
}

/** A reflectance has no value above 1; a lamp most often has. */
async function takeFile(file, kind) {
    try {
        takeSpectrum(file.name.replace(/\.[^.]*$/, ''), spectrumOfText(await file.text()), kind);
    } catch (error) {
        say(`${file.name}: ${error.message}`);
    }
}

/** Adds a lamp or a dye and shows it. @param kind 'lamp', 'dye', or nothing: as the values are */
function takeSpectrum(name, values, kind) {
    const most = Math.max(...values);
    kind ??= most <= 1 && openDyes().length ? 'dye' : 'lamp';
    if (kind === 'dye') {
        if (most > 1) throw new Error('a reflectance lies between 0 and 1');
        page.dyes.push({name, reflectance: values});
        setDye({label: name, reflectance: values});
        showDye();
    } else {
        if (!(xyzOf(values, PERFECT_WHITE, '2')[1] > 0)) throw new Error('the lamp has no visible power');
        page.lamps = page.lamps.filter(lamp => lamp.name !== name);
        page.lamps.push({name, caption: 'from a file', power: values});
        changeLamp({name, kelvin: undefined});
        showLight();
    }
    say(`${kind === 'dye' ? 'Dye' : 'Lamp'} ${name}`);
}

function followDrops() {
    for (const kind of ['dragenter', 'dragover'])
        addEventListener(kind, event => {
            event.preventDefault();
            document.body.classList.add('dropping');
        });
    for (const kind of ['dragleave', 'drop'])
        addEventListener(kind, event => {
            event.preventDefault();
            document.body.classList.remove('dropping');
            for (const file of event.dataTransfer?.files ?? []) if (kind === 'drop') takeFile(file);
        });
}
