// Elements of the document.

/** An element with properties (`dataset`, `style`, `on...` and `aria-...` too) and children. */
function element(tag, properties = {}, ...children) {
    const made = document.createElement(tag);
    for (const [name, value] of Object.entries(properties)) {
        if (name === 'style' || name === 'dataset') Object.assign(made[name], value);
        else if (name.includes('-') || name === 'role' || name === 'for') made.setAttribute(name, value);
        else made[name] = value;
    }
    made.append(...children.flat().filter(child => child !== null && child !== undefined));
    return made;
}

/** Buttons of which one is pressed. @param choices [[value, label, title]] */
function fillSegmented(parent, choices, chosen, choose) {
    parent.replaceChildren(...choices.map(([value, label, title]) => element('button', {
        title: title ?? '', 'aria-pressed': value === chosen, onclick: () => choose(value)}, label)));
}

/** A labelled slider. @param shown text of a value */
function slider(label, {min, max, step, value, shown, track}, change) {
    const output = element('output', {}, shown(value));
    const input = element('input', {type: 'range', min, max, step, value, 'aria-label': label});
    if (track) input.style.setProperty('--track', track);
    input.addEventListener('input', () => {
        output.textContent = shown(Number(input.value));
        change(Number(input.value));
    });
    return element('div', {className: 'field'}, element('span', {}, label), output, input);
}

function swatch(hex) {
    return element('span', {className: 'swatch', style: {background: hex}});
}

/** Says something for a while, or for good where it is a failure. */
function say(text, stays = false) {
    const message = document.getElementById('message');
    message.textContent = text;
    clearTimeout(say.timer);
    if (!stays) say.timer = setTimeout(() => { message.textContent = ''; }, 3500);
}
