// Two renderers of a scene: WebGL 2, and SVG for print and where there is no WebGL.

const FACE_SHADER = `#version 300 es
uniform mat4 matrix; uniform vec3 towards;
in vec3 place; in vec3 normal; in vec4 colour; out vec4 shade;
void main() {
  gl_Position = matrix * vec4(place, 1);
  float light = 0.66 + 0.34 * abs(dot(normal, towards));
  shade = vec4(colour.rgb * light, colour.a);
}`;
// Each line is a strip of two triangles, as wide on the screen as it is to be.
const LINE_SHADER = `#version 300 es
uniform mat4 matrix; uniform vec2 size;
in vec2 corner; in vec3 from; in vec3 to; in vec4 colour; in vec2 look;
out vec4 shade; out float along; flat out float dashes;
void main() {
  vec4 p = matrix * vec4(from, 1); vec4 q = matrix * vec4(to, 1);
  vec2 direction = (q.xy / q.w - p.xy / p.w) * size;
  bool isDot = length(direction) < 0.5;
  if (isDot) direction = vec2(1, 0);
  float pixels = max(length(direction), 0.001);
  vec2 across = vec2(-direction.y, direction.x) / pixels;
  vec4 at = mix(p, q, corner.x);
  at.xy += across * corner.y * look.x / size * at.w;
  if (isDot) at.xy += direction * (2.0 * corner.x - 1.0) * look.x / size * at.w;
  at.z -= 0.0005 * at.w;
  gl_Position = at;
  shade = colour; along = corner.x * pixels / 2.0; dashes = look.y;
}`;
const PAINT = `#version 300 es
precision mediump float; in vec4 shade; out vec4 pixel;
void main() { pixel = vec4(shade.rgb * shade.a, shade.a); }`;
const PAINT_LINE = `#version 300 es
precision mediump float; in vec4 shade; in float along; flat in float dashes; out vec4 pixel;
void main() { if (dashes > 0.0 && mod(along, 2.0 * dashes) > dashes) discard; pixel = vec4(shade.rgb * shade.a, shade.a); }`;

class WebGlPainter {
  /** Null where the browser has no WebGL 2. */
  static on(canvas) {
    const gl = openWebGl(canvas);
    return gl ? new WebGlPainter(gl) : null;
  }

  constructor(gl) {
    this.gl = gl;
    this.faces = compileProgram(gl, FACE_SHADER, PAINT);
    this.lines = compileProgram(gl, LINE_SHADER, PAINT_LINE);
    this.buffer = gl.createBuffer();
    this.corners = gl.createBuffer();
    gl.bindBuffer(gl.ARRAY_BUFFER, this.corners);
    gl.bufferData(gl.ARRAY_BUFFER, new Float32Array([0, -1, 1, -1, 0, 1, 1, 1]), gl.STATIC_DRAW);
  }

  /** Parts of each vertex, or of each line, in a row of floats. */
  attributes(program, parts, perLine) {
    const {gl} = this;
    const stride = 4 * parts.reduce((sum, [, count]) => sum + count, 0);
    let offset = 0;
    for (const [name, count] of parts) {
      const at = gl.getAttribLocation(program, name);
      gl.enableVertexAttribArray(at);
      gl.vertexAttribPointer(at, count, gl.FLOAT, false, stride, offset);
      gl.vertexAttribDivisor(at, perLine);
      offset += 4 * count;
    }
  }

  draw(scene, camera, size, ratio) {
    const {gl} = this;
    const {canvas} = gl;
    const [width, height] = [Math.round(size.width * ratio), Math.round(size.height * ratio)];
    if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, {width, height});
    gl.viewport(0, 0, width, height);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
    const matrix = camera.matrix(size);
    this.drawFaces(scene, camera, matrix);
    this.drawLines(scene.lines.filter((line) => !line.top), matrix, size, ratio);
    this.drawLines(scene.lines.filter((line) => line.top), matrix, size, ratio);
  }

  drawFaces(scene, camera, matrix) {
    const {gl} = this;
    const data = [];
    for (const face of sortedFaces(scene, camera)) {
      const [p, q, r] = face.corners;
      const normal = unit(cross(subtract(q, p), subtract(r, p)));
      for (const corner of face.corners) data.push(...corner, ...normal, ...face.colour.map((c) => c / 255), face.opacity);
    }
    gl.useProgram(this.faces);
    gl.uniformMatrix4fv(gl.getUniformLocation(this.faces, "matrix"), false, matrix);
    gl.uniform3fv(gl.getUniformLocation(this.faces, "towards"), camera.towards);
    gl.bindBuffer(gl.ARRAY_BUFFER, this.buffer);
    gl.bufferData(gl.ARRAY_BUFFER, new Float32Array(data), gl.DYNAMIC_DRAW);
    this.attributes(this.faces, [["place", 3], ["normal", 3], ["colour", 4]], 0);
    gl.drawArrays(gl.TRIANGLES, 0, data.length / 10);
  }

  drawLines(lines, matrix, size, ratio) {
    const {gl} = this;
    const data = [];
    for (const line of lines) {
      data.push(...line.from, ...line.to, ...line.colour.map((c) => c / 255), line.opacity, line.width * ratio, line.dashed ? 7 * ratio : 0);
    }
    gl.useProgram(this.lines);
    gl.uniformMatrix4fv(gl.getUniformLocation(this.lines, "matrix"), false, matrix);
    gl.uniform2f(gl.getUniformLocation(this.lines, "size"), size.width * ratio, size.height * ratio);
    gl.bindBuffer(gl.ARRAY_BUFFER, this.corners);
    this.attributes(this.lines, [["corner", 2]], 0);
    gl.bindBuffer(gl.ARRAY_BUFFER, this.buffer);
    gl.bufferData(gl.ARRAY_BUFFER, new Float32Array(data), gl.DYNAMIC_DRAW);
    this.attributes(this.lines, [["from", 3], ["to", 3], ["colour", 4], ["look", 2]], 1);
    gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 4, lines.length);
  }
}

/** The farthest first: faces let each other shine through. */
function sortedFaces(scene, camera) {
  const depth = (face) => dot(add(add(face.corners[0], face.corners[1]), face.corners[2]), camera.towards);
  return scene.faces.map((face) => [depth(face), face]).sort((x, y) => x[0] - y[0]).map(([, face]) => face);
}

/** Moves boxes {at: [x, y], half: [width, height]} that overlap away from each other, and all of them into the picture. Those that find
    no room get `hidden`, the last ones first. */
function spread(boxes, size) {
  const extent = [size.width, size.height];
  const apart = (box, other) => {
    const overX = box.half[0] + other.half[0] - Math.abs(other.at[0] - box.at[0]);
    const overY = box.half[1] + other.half[1] - Math.abs(other.at[1] - box.at[1]);
    if (overX < 0.5 || overY < 0.5) return true;
    const axis = overX < overY ? 0 : 1;
    const way = (other.at[axis] < box.at[axis] ? -1 : 1) * (Math.min(overX, overY) / 2 + 0.2);
    box.at[axis] -= way;
    other.at[axis] += way;
    return false;
  };
  for (let round = 0, isDone = false; round < 120 && !isDone; ++round) {
    isDone = true;
    for (let i = 0; i < boxes.length; ++i) {
      for (let k = i + 1; k < boxes.length; ++k) isDone = apart(boxes[i], boxes[k]) && isDone;
    }
    for (const box of boxes) box.at = box.at.map((x, axis) => Math.max(Math.min(x, extent[axis] - box.half[axis]), box.half[axis]));
  }
  boxes.forEach((box, i) => { box.hidden = boxes.slice(0, i).some((other) => !other.hidden && overlap(box, other)); });
}

function overlap(box, other) { return [0, 1].every((axis) => Math.abs(other.at[axis] - box.at[axis]) < box.half[axis] + other.half[axis] - 1); }

/** Quiet names stay where their vertices are. One that another name would cover in part is left out; the nearest ones have the room. */
function hideCovered(names) {
  const shown = names.filter((name) => !name.hidden && !name.quiet);
  for (const name of names.filter((one) => !one.hidden && one.quiet).sort((x, y) => y.depth - x.depth)) {
    name.hidden = shown.some((other) => overlap(name, other));
    if (!name.hidden) shown.push(name);
  }
}

/** The place moved inside of 0 to `size` by `half`; null far outside. */
function within(place, half, size) {
  const far = 30;
  return place < -far || place > size + far ? null : Math.min(Math.max(place, half), size - half);
}

/** Names that would hide what they name stand around it, each in the direction of its vertex. */
function setAround(names, em) {
  if (names.length < 3) return false;
  const ends = [0, 1].map((axis) => [Math.min(...names.map(({from}) => from[axis])), Math.max(...names.map(({from}) => from[axis]))]);
  const covered = names.reduce((sum, {half}) => sum + 4 * half[0] * half[1], 0);
  const shape = ends.map(([low, high]) => high - low);
  if (covered < 0.5 * shape[0] * shape[1]) return false;
  const middle = ends.map(([low, high]) => (low + high) / 2);
  for (const name of names) {
    const way = [0, 1].map((axis) => (name.from[axis] - middle[axis]) / Math.max(shape[axis], 1));
    const length = Math.hypot(...way);
    name.at = [0, 1].map((axis) => middle[axis] + (length > 0 ? way[axis] / length : axis) * (0.7 * shape[axis] + name.half[axis] + 1.2 * em));
  }
  return true;
}

/** Where names stand, in letters of `em` pixels: at their vertices, or moved away from each other at the end of a line. Corners of the
    ring are p_i, too, unless that leaves no room for another name. */
function placeNames(scene, camera, size, em) {
  let isAround = false;
  const place = (hasCorners) => {
    const names = scene.names.map((name) => {
      const corner = hasCorners ? name.corner : undefined;
      const [x, y, depth] = camera.project(name.place, size);
      const letters = name.text.length + (corner ? 3.5 + 0.6 * `${corner}`.length : 0);
      // Whole where its place is near the border; gone where that is far outside, as of a caller's edge.
      const half = [0.55 * em + 0.32 * em * letters, 0.8 * em];
      const at = [within(x, half[0], size.width), within(y, half[1], size.height)];
      return {...name, corner, depth, half, at, from: [x, y], hidden: at.includes(null)};
    });
    const loud = names.filter((name) => !name.hidden && !name.quiet);
    isAround = setAround(loud, em);
    spread(loud, size);
    return names;
  };
  const count = (names) => names.filter((name) => name.hidden).length;
  const farthest = 4 * em;
  const isFar = (name) => !name.hidden && Math.hypot(name.at[0] - name.from[0], name.at[1] - name.from[1]) > farthest;
  const plain = place(false);
  const full = place(true);
  const names = count(full) > count(plain) || (!isAround && full.some(isFar)) ? plain : full;
  hideCovered(names);
  for (const name of names) name.isLed = !name.hidden && !name.quiet && [0, 1].some((axis) => Math.abs(name.at[axis] - name.from[axis]) > name.half[axis]);
  return names;
}

/** The scene as SVG, with the names. */
function drawFlat(svg, scene, camera, size) {
  svg.setAttribute("viewBox", `0 0 ${size.width} ${size.height}`);
  svg.setAttribute("preserveAspectRatio", "xMidYMid meet");
  const at = (p) => camera.project(p, size).slice(0, 2).map((x) => x.toFixed(1)).join();
  const parts = [];
  for (const face of sortedFaces(scene, camera)) {
    const [p, q, r] = face.corners;
    const normal = unit(cross(subtract(q, p), subtract(r, p)));
    const light = 0.66 + 0.34 * Math.abs(dot(normal, camera.towards));
    parts.push(svgElement("polygon", {points: face.corners.map(at).join(" "), fill: inCss(face.colour.map((c) => Math.round(c * light))), "fill-opacity": face.opacity}));
  }
  for (const top of [false, true]) {
    for (const line of scene.lines.filter((l) => Boolean(l.top) === top)) {
      const [x1, y1] = camera.project(line.from, size);
      const [x2, y2] = camera.project(line.to, size);
      parts.push(svgElement("line", {x1: x1.toFixed(1), y1: y1.toFixed(1), x2: x2.toFixed(1), y2: y2.toFixed(1), stroke: inCss(line.colour), "stroke-width": line.width,
        "stroke-opacity": line.opacity, "stroke-linecap": "round", "stroke-dasharray": line.dashed ? "7 7" : "none"}));
    }
  }
  const em = Math.max(size.height / 30, 11);
  for (const name of placeNames(scene, camera, size, em)) {
    if (name.hidden) continue;
    const [x, y] = name.at;
    if (name.isLed) parts.push(svgElement("line", {x1: name.from[0], y1: name.from[1], x2: x, y2: y, stroke: inCss(colourOf("quiet")), "stroke-width": 1}));
    const text = svgElement("text", {x, y, "text-anchor": "middle", "dominant-baseline": "central", "font-weight": name.quiet ? 400 : 700, "font-size": em,
      fill: inCss(colourOf(name.end ? "edge" : "ink")), stroke: inCss(colourOf("card")), "stroke-width": 3, "paint-order": "stroke"}, name.text);
    if (name.corner) text.append(" = ", svgElement("tspan", {"font-style": "italic"}, "p"), svgElement("tspan", {"font-size": "75%", dy: "0.25em"}, `${name.corner}`));
    parts.push(text);
  }
  svg.replaceChildren(...parts);
}
