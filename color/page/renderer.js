// Draws dresses with WebGL 2: one context for all, the codes of each in a texture.

// Colours of a difference from none to the largest, dark to light so that they print
const LEGEND = [[0.05, 0.05, 0.09], [0.22, 0.11, 0.38], [0.55, 0.16, 0.45], [0.86, 0.31, 0.34],
                [0.98, 0.6, 0.27], [0.99, 0.92, 0.62]];
const FINER = 4; // texels in a step of a view's codes, so that none need be mixed

class Renderer {
    constructor() {
        this.canvas = document.createElement('canvas');
        const gl = this.gl = this.canvas.getContext('webgl2', {antialias: false, alpha: false});
        if (!gl) throw new Error('this browser has no WebGL 2, which the page needs to relight');
        gl.enable(gl.SCISSOR_TEST);
        this.canvas.width = Math.max(...page.dresses.map(dress => dress.width));
        this.canvas.height = Math.max(...page.dresses.map(dress => dress.height));
        this.views = new Map(page.views.map(view => [view.name, this.viewTexture(view)]));
        for (const dress of page.dresses) this.prepare(dress);
    }

    texture(target) {
        const gl = this.gl, texture = gl.createTexture();
        gl.bindTexture(target, texture);
        for (const name of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER])
            gl.texParameteri(target, name, gl.NEAREST);
        for (const name of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T])
            gl.texParameteri(target, name, gl.CLAMP_TO_EDGE);
        return texture;
    }

    viewTexture(view) {
        const gl = this.gl, texture = this.texture(gl.TEXTURE_2D);
        const codes = Float32Array.from({length: FINER * (view.code.length - 1) + 1}, (_, i) => {
            const cell = Math.floor(i / FINER), next = Math.min(cell + 1, view.code.length - 1);
            return view.code[cell] + i % FINER / FINER * (view.code[next] - view.code[cell]);
        });
        gl.texImage2D(gl.TEXTURE_2D, 0, gl.R32F, codes.length, 1, 0, gl.RED, gl.FLOAT, codes);
        return texture;
    }

    /** Texture and programs of a dress. */
    prepare(dress) {
        const gl = this.gl, planes = dress.groups.flatMap(group => group.planes);
        const size = dress.width * dress.height, layers = Math.ceil(planes.length / 4);
        const codes = new Uint16Array(4 * size * layers);
        planes.forEach((plane, i) => {
            let to = 4 * size * Math.floor(i / 4) + i % 4;
            for (let p = 0; p < size; ++p, to += 4) codes[to] = plane.codes[p];
        });
        dress.texture = this.texture(gl.TEXTURE_2D_ARRAY);
        gl.texImage3D(gl.TEXTURE_2D_ARRAY, 0, gl.RGBA16UI, dress.width, dress.height, layers, 0,
                      gl.RGBA_INTEGER, gl.UNSIGNED_SHORT, codes);
        dress.shown = this.program(dress, false);
        dress.mapped = this.program(dress, true);
    }

    /** What precedes the shader of a dress: how its planes are summed, without a loop. */
    defines(dress, difference) {
        let texel = 0, plane = 0, sum = '';
        const component = () => {
            if (texel % 4 === 0) sum += `FETCH(${texel / 4}) `;
            return `four.${'rgba'[texel++ % 4]}`;
        };
        dress.groups.forEach((group, g) => group.planes.forEach((_, i) => {
            const code = component();
            sum += i === 0 ? `GROUP(${g}, ${code}) ` : `PLANE(${plane++}, ${code}) `;
        }));
        return (difference ? '#define DIFFERENCE\n' : '') +
               `#define LOOKS ${difference ? 2 : 1}\n#define GROUPS ${dress.groups.length}\n` +
               `#define PLANES ${Math.max(plane, 1)}\n#define LEGEND ${LEGEND.length}\n` +
               `#define VIEW_CODES ${FINER * (page.views[0].code.length - 1) + 1}\n#define SUM_PLANES ${sum}\n`;
    }

    /** A program with the places of its uniforms. */
    program(dress, difference) {
        const source = document.getElementById('picture-shader').textContent.trim();
        const gl = this.gl, program = gl.createProgram();
        const compile = (kind, text) => {
            const shader = gl.createShader(kind);
            gl.shaderSource(shader, text);
            gl.compileShader(shader);
            gl.attachShader(program, shader);
            return shader;
        };
        // One triangle that covers the picture
        const shaders = [
            compile(gl.VERTEX_SHADER, '#version 300 es\nvoid main() { gl_Position = ' +
                    'vec4(vec2(gl_VertexID == 1 ? 3 : -1, gl_VertexID == 2 ? 3 : -1), 0, 1); }'),
            compile(gl.FRAGMENT_SHADER, source.replace('\n', '\n' + this.defines(dress, difference)))];
        gl.linkProgram(program);
        if (!gl.getProgramParameter(program, gl.LINK_STATUS))
            throw new Error(gl.getProgramInfoLog(program) + shaders.map(s => gl.getShaderInfoLog(s)).join(''));
        const at = name => gl.getUniformLocation(program, name);
        gl.useProgram(program);
        gl.uniform1i(at('u_codes'), 0);
        gl.uniform1i(at('u_view'), 1);
        gl.uniform2fv(at('u_level'), dress.groups.flatMap(({planes: [level]}) => [level.offset, level.step]));
        gl.uniform1f(at('u_level_scale'), page.level_scale);
        gl.uniform3fv(at('u_white'), page.display.white);
        gl.uniformMatrix3fv(at('u_rgb_from_xyz'), true, page.display.rgb_from_xyz.flat());
        gl.uniform3fv(at('u_legend'), LEGEND.flat());
        gl.uniform1i(at('u_height'), dress.height);
        return {program, at};
    }

    /** Hands the colours of looks to a program, with the steps and offsets of codes in them. */
    setColours(dress, {at}, looks, view) {
        const ofLevel = [], ofOffset = [], ofCode = [];
        for (const look of looks) {
            const colours = viewedColours(dress, look, view);
            let next = 0;
            for (const group of dress.groups) {
                ofLevel.push(...colours[next++]);
                const offset = [0, 0, 0];
                for (const plane of group.planes.slice(1)) {
                    const xyz = colours[next++];
                    xyz.forEach((v, c) => { offset[c] += plane.offset * v; });
                    ofCode.push(...xyz.map(v => plane.step * v));
                }
                ofOffset.push(...offset);
            }
        }
        const gl = this.gl;
        gl.uniform3fv(at('u_of_level'), ofLevel);
        gl.uniform3fv(at('u_of_offset'), ofOffset);
        if (ofCode.length) gl.uniform3fv(at('u_of_code'), ofCode);
    }

    /** Draws the columns from `first` to `end` of a dress. @param looks one, or two to compare */
    drawColumns(dress, looks, view, first, end) {
        const gl = this.gl, use = looks.length > 1 ? dress.mapped : dress.shown;
        const display = page.views.find(one => one.name === view.display);
        gl.useProgram(use.program);
        gl.activeTexture(gl.TEXTURE0);
        gl.bindTexture(gl.TEXTURE_2D_ARRAY, dress.texture);
        gl.activeTexture(gl.TEXTURE1);
        gl.bindTexture(gl.TEXTURE_2D, this.views.get(view.display));
        this.setColours(dress, use, looks, view);
        gl.uniform2f(use.at('u_view_scale'), display.half, display.step / FINER);
        gl.uniform1f(use.at('u_largest'), view.largest);
        gl.viewport(0, 0, dress.width, dress.height);
        gl.scissor(first, 0, end - first, dress.height);
        gl.drawArrays(gl.TRIANGLES, 0, 3);
    }

    /** Draws a dress into its canvas.
     *  @param view {mode, split (0 to 1), largest, display, observer, degree, exposure} */
    draw(dress, {left, right}, view) {
        const split = view.mode === 'split' ? Math.round(view.split * dress.width) : dress.width;
        this.drawColumns(dress, view.mode === 'difference' ? [left, right] : [left], view, 0, split);
        if (split < dress.width) this.drawColumns(dress, [right], view, split, dress.width);
        dress.context.drawImage(this.canvas, 0, this.canvas.height - dress.height, dress.width,
                                dress.height, 0, 0, dress.width, dress.height);
    }
}
