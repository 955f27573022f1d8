// Vectors and the camera.

const add = (p, q) => [p[0] + q[0], p[1] + q[1], p[2] + q[2]];
const subtract = (p, q) => [p[0] - q[0], p[1] - q[1], p[2] - q[2]];
const scale = (p, s) => [p[0] * s, p[1] * s, p[2] * s];
const dot = (p, q) => p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
const cross = (p, q) => [p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]];
const length = (p) => Math.hypot(...p);
const unit = (p) => scale(p, 1 / Math.max(length(p), 1e-12));
const mix = (p, q, t) => add(scale(p, 1 - t), scale(q, t));

/** Looks at a ball from outside. `right`, `up` and `towards` (the eye) are unit vectors. */
class Camera {
  constructor() {
    this.centre = [0, 0, 0];
    this.radius = 1;
    this.zoom = 1;
    this.look([0.5, -0.8, 0.35], [0, 0, 1]);
  }

  look(towards, up) {
    this.towards = unit(towards);
    this.right = unit(cross(up, this.towards));
    if (length(cross(up, this.towards)) < 1e-6) this.right = unit(cross(Math.abs(this.towards[0]) < 0.9 ? [1, 0, 0] : [0, 1, 0], this.towards));
    this.up = cross(this.towards, this.right);
  }

  /** By angles, around the axes of the picture. */
  turn(across, upwards) {
    const round = (v, axis, angle) => add(add(scale(v, Math.cos(angle)), scale(cross(axis, v), Math.sin(angle))),
                                          scale(axis, dot(axis, v) * (1 - Math.cos(angle))));
    for (const [axis, angle] of [[this.up, -across], [this.right, -upwards]]) {
      const towards = round(this.towards, axis, angle);
      const up = round(this.up, axis, angle);
      this.towards = unit(towards);
      this.right = unit(cross(up, this.towards));
      this.up = cross(this.towards, this.right);
    }
  }

  /** Distance of the eye, in radii: some perspective, to tell front from back. */
  get distance() { return 4.2 * this.radius; }

  /** Pixels from the middle, y downwards, and the depth: larger is nearer. */
  project(p, size) {
    const q = subtract(p, this.centre);
    const depth = dot(q, this.towards);
    const s = this.zoom * 0.42 * Math.min(size.width, size.height) / this.radius * (this.distance / Math.max(this.distance - depth, 0.05 * this.radius));
    return [size.width / 2 + s * dot(q, this.right), size.height / 2 - s * dot(q, this.up), depth];
  }

  /** The same as a matrix for WebGL, column by column. */
  matrix(size) {
    const s = this.zoom * 0.84 * Math.min(size.width, size.height) / this.radius * this.distance;
    const x = scale(this.right, s / size.width);
    const y = scale(this.up, s / size.height);
    const far = this.distance + 40 * this.radius;
    const near = 0.05 * this.radius;
    const [a, b] = [(far + near) / (far - near), -2 * far * near / (far - near)];
    const w = scale(this.towards, -1);  // of the depth from the eye
    const z = scale(w, a);
    const at = (row, constant) => constant - dot(row, this.centre);
    return new Float32Array([x[0], y[0], z[0], w[0], x[1], y[1], z[1], w[1], x[2], y[2], z[2], w[2],
                             at(x, 0), at(y, 0), at(z, a * this.distance + b), at(w, this.distance)]);
  }
}

/** Ball around some places. */
function ballAround(places) {
  const low = [0, 1, 2].map((c) => Math.min(...places.map((p) => p[c])));
  const high = [0, 1, 2].map((c) => Math.max(...places.map((p) => p[c])));
  const centre = mix(low, high, 0.5);
  return {centre, radius: Math.max(...places.map((p) => length(subtract(p, centre))), 1e-6)};
}
