// The packed numbers of a dress: codes of 16 bits, a plane for each light group's level and shape
// values and one for the garment's coverage.

/** Bytes of a text in base64 that are deflated. */
async function inflated(base64) {
    const bytes = Uint8Array.from(atob(base64), c => c.charCodeAt(0));
    const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('deflate'));
    return new Uint8Array(await new Response(stream).arrayBuffer());
}

/** Codes of a plane, from the low and high bytes of its differences from what neighbours foretell. */
function planeCodes(bytes, offset, width, height) {
    const size = width * height, codes = new Uint16Array(size);
    for (let p = 0; p < size; ++p) {
        const folded = bytes[offset + p] | bytes[offset + size + p] << 8;
        const difference = folded & 1 ? -(folded + 1 >> 1) : folded >> 1;
        let foretold = 0;
        if (p >= width && p % width) {
            const left = codes[p - 1], above = codes[p - width];
            foretold = left + above - codes[p - width - 1];
            foretold = Math.max(Math.min(left, above), Math.min(Math.max(left, above), foretold));
        } else if (p) {
            foretold = p < width ? codes[p - 1] : codes[p - width];
        }
        codes[p] = foretold + difference;
    }
    return codes;
}

/** Fills `codes` of all planes of a dress, in their order, and the mask of its garment. */
async function unpack(dress, base64) {
    const bytes = await inflated(base64);
    const size = dress.width * dress.height;
    let offset = 0;
    for (const plane of dress.groups.flatMap(group => group.planes)) {
        plane.codes = planeCodes(bytes, offset, dress.width, dress.height);
        offset += 2 * size;
    }
    dress.coverage = planeCodes(bytes, offset, dress.width, dress.height);
    for (const group of dress.groups) group.garment = garmentMean(group, dress.coverage);
}

/** Values of the planes of a group at a pixel: the level a, then a / h times each shape value. */
function planeValues(group, pixel) {
    const [level, ...shape] = group.planes.map(plane => plane.offset + plane.step * plane.codes[pixel]);
    const a = page.level_scale * Math.expm1(level);
    const weight = a > 0 ? a / Math.cbrt(Math.min(a, 1)) : 0;
    return [a, ...shape.map(value => weight * value)];
}

/** Mean of the values over the garment's pixels: the mean colour is as linear as that of a pixel. */
function garmentMean(group, coverage) {
    const sums = group.planes.map(() => 0);
    let count = 0;
    for (let p = 0; p < coverage.length; p += 7) { // every seventh is as good
        if (!coverage[p]) continue;
        planeValues(group, p).forEach((value, i) => { sums[i] += value; });
        ++count;
    }
    return sums.map(sum => sum / Math.max(count, 1));
}
