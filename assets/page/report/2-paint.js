// Two painters of the shape: WebGL 2, and SVG where there is none.

const SHAPE_SHADER = `#version 300 es
uniform mat4 matrix; uniform float nearer;
in vec3 place; out vec3 at;
void main() { at = place; gl_Position = matrix * vec4(place, 1); gl_Position.z -= nearer * gl_Position.w; }`;
// Whatever lies beyond the cut is not there. Faces are flat; a clear surface is dense at its outline.
const SHAPE_PAINT = `#version 300 es
precision highp float;
uniform vec4 cut; uniform vec3 towards; uniform vec3 colour; uniform vec3 inside; uniform vec2 opacity; uniform bool isLine;
in vec3 at; out vec4 pixel;
void main() {
  if (dot(at, cut.xyz) > cut.w) discard;
  if (isLine) { pixel = vec4(colour * opacity.x, opacity.x); return; }
  vec3 normal = normalize(cross(dFdx(at), dFdy(at)));
  float facing = abs(dot(normal, towards));
  vec3 shade = (gl_FrontFacing ? colour : inside) * (0.7 + 0.3 * facing);
  float alpha = mix(opacity.y, opacity.x, facing);
  pixel = vec4(shade * alpha, alpha);
}`;

class ShapePainter {
  /** Null where the browser has no WebGL 2. */
  static on(canvas, shape) {
    const gl = openWebGl(canvas);
    return gl ? new ShapePainter(gl, shape) : null;
  }

  constructor(gl, shape) {
    this.gl = gl;
    this.program = compileProgram(gl, SHAPE_SHADER, SHAPE_PAINT);
    this.places = gl.createBuffer();
    gl.bindBuffer(gl.ARRAY_BUFFER, this.places);
    gl.bufferData(gl.ARRAY_BUFFER, shape.places, gl.STATIC_DRAW);
    this.surface = this.list(shape.triangles);
    this.regions = shape.regions.map(({colour, triangles, walls}) => ({colour, surface: this.list(triangles), walls: this.list(walls)}));
    this.edges = this.list(shape.edges);
    this.tets = {};
    for (const when of ["before", "after"]) {
      this.tets[when] = {faces: this.list(shape.tets[when].faces), edges: this.list(shape.tets[when].edges)};
    }
    this.at = Object.fromEntries(["matrix", "nearer", "cut", "towards", "colour", "inside", "opacity", "isLine"].map((name) => [name, gl.getUniformLocation(this.program, name)]));
  }

  list(numbers) {
    const {gl} = this;
    const buffer = gl.createBuffer();
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, buffer);
    gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, numbers, gl.STATIC_DRAW);
    return {buffer, count: numbers.length};
  }

  /** Views beside each other, each the bad tets of one mesh. */
  draw(views, look, camera, size, ratio) {
    const {gl} = this;
    const [width, height] = [Math.round(size.width * ratio), Math.round(size.height * ratio)];
    if (gl.canvas.width !== width || gl.canvas.height !== height) Object.assign(gl.canvas, {width, height});
    gl.viewport(0, 0, width, height);
    gl.clearColor(0, 0, 0, 0);
    gl.depthMask(true);  // without it depths of the last picture stay
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.enable(gl.DEPTH_TEST);
    gl.depthFunc(gl.LEQUAL);
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
    gl.useProgram(this.program);
    gl.bindBuffer(gl.ARRAY_BUFFER, this.places);
    const place = gl.getAttribLocation(this.program, "place");
    gl.enableVertexAttribArray(place);
    gl.vertexAttribPointer(place, 3, gl.FLOAT, false, 0, 0);
    const part = {width: size.width / views.length, height: size.height};
    gl.uniformMatrix4fv(this.at.matrix, false, camera.matrix(part));
    gl.uniform3fv(this.at.towards, camera.towards);
    gl.uniform4fv(this.at.cut, look.cut);
    views.forEach((when, n) => {
      gl.viewport(Math.round(n * width / views.length), 0, Math.round(width / views.length), height);
      this.drawView(when, look);
    });
  }

  drawView(when, look) {
    const {gl} = this;
    const {faces, edges} = this.tets[when];
    const [surface, inside, bad, ink] = ["surface", "inside", "bad", "wire"].map(colourOf);
    gl.depthMask(true);
    if (look.isSolid) this.fillSurface(look, surface, inside, [1, 1]);
    this.fill(faces, bad, bad, [1, 1]);
    this.stroke(edges, bad.map((c) => 0.55 * c), 0.8, 0.0004);
    gl.depthMask(false);
    if (!look.isSolid) this.fillSurface(look, surface, surface, look.byLabel ? [0.25, 0.75] : [0.08, 0.55]);
    this.stroke(this.edges, ink, look.isSolid ? 0.75 : 0.5, 0.0006);
  }

  fillSurface(look, colour, inside, opacity) {
    if (!look.byLabel) return this.fill(this.surface, colour, inside, opacity);
    const {gl} = this;
    // Whoever looks into a region that is cut open sees its colour all around.
    for (const region of this.regions) this.fill(region.surface, region.colour, region.colour.map((c) => 0.85 * c), opacity);
    gl.enable(gl.CULL_FACE);
    gl.cullFace(gl.FRONT);
    for (const region of this.regions) this.fill(region.walls, region.colour, region.colour.map((c) => 0.85 * c), opacity);
    gl.disable(gl.CULL_FACE);
  }

  fill(list, colour, inside, opacity) {
    const {gl} = this;
    if (list.count === 0) return;
    gl.uniform1i(this.at.isLine, 0);
    gl.uniform1f(this.at.nearer, 0);
    gl.uniform3fv(this.at.colour, colour.map((c) => c / 255));
    gl.uniform3fv(this.at.inside, inside.map((c) => c / 255));
    gl.uniform2fv(this.at.opacity, opacity);
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, list.buffer);
    gl.drawElements(gl.TRIANGLES, list.count, gl.UNSIGNED_INT, 0);
  }

  stroke(list, colour, opacity, nearer) {
    const {gl} = this;
    if (list.count === 0) return;
    gl.uniform1i(this.at.isLine, 1);
    gl.uniform1f(this.at.nearer, nearer);
    gl.uniform3fv(this.at.colour, colour.map((c) => c / 255));
    gl.uniform2fv(this.at.opacity, [opacity, opacity]);
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, list.buffer);
    gl.drawElements(gl.LINES, list.count, gl.UNSIGNED_INT, 0);
  }
}

/** Sharp edges and bad tets, as many as a drawing bears. */
function drawFlatShape(svg, shape, views, look, camera, size) {
  const MOST = 3000;
  const part = {width: size.width / views.length, height: size.height};
  svg.setAttribute("viewBox", `0 0 ${size.width} ${size.height}`);
  const placeOf = (i) => [0, 1, 2].map((axis) => shape.places[3 * i + axis]);
  const isThere = (places) => places.every((p) => dot(p, look.cut) <= look.cut[3]);
  const drawn = views.flatMap((when, n) => {
    const at = (p) => { const [x, y] = camera.project(p, part); return `${(x + n * part.width).toFixed(1)} ${y.toFixed(1)}`; };
    const parts = [];
    const add = (numbers, corners, attributes) => {
      for (let i = 0; i < Math.min(numbers.length, corners * MOST); i += corners) {
        const places = [...numbers.subarray(i, i + corners)].map(placeOf);
        if (isThere(places)) parts.push(svgElement("polygon", {points: places.map(at).join(" "), ...attributes}));
      }
    };
    add(shape.edges, 2, {fill: "none", stroke: inCss(colourOf("wire")), "stroke-width": 0.7});
    add(shape.tets[when].faces, 3, {fill: inCss(colourOf("bad")), "fill-opacity": 0.6});
    return parts;
  });
  svg.replaceChildren(...drawn);
}
