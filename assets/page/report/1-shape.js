// The surface and the bad tets, as report/shape.cpp packs them.

const FACES = [[1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1]];
const EDGES = [[0, 1], [0, 2], [0, 3], [1, 2], [1, 3], [2, 3]];
const GRID = 65535;

const about = JSON.parse(byId("shape-about").textContent);

async function inflate(text) {
  const bytes = Uint8Array.from(atob(text.trim()), (c) => c.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

/** Numbers of seven bits a byte, of either sign. */
class Numbers {
  constructor(bytes) {
    this.bytes = bytes;
    this.at = 0;
  }

  next() {
    let value = 0;
    for (let shift = 0; ; shift += 7) {
      const byte = this.bytes[this.at++];
      value |= (byte & 127) << shift;
      if (byte < 128) return (value >>> 1) ^ -(value & 1);
    }
  }

  rows(count, columns) {
    const rows = new Uint32Array(count * columns);
    for (let column = 0; column < columns; ++column) {
      for (let row = 0, last = 0; row < count; ++row) {
        if (column > 0) last = rows[row * columns + column - 1];
        last += this.next();
        rows[row * columns + column] = last;
      }
    }
    return rows;
  }

  places(count) {
    const places = new Float32Array(3 * count);
    for (let axis = 0; axis < 3; ++axis) {
      for (let i = 0, last = 0; i < count; ++i) {
        last += this.next();
        places[3 * i + axis] = last / GRID;
      }
    }
    return places;
  }
}

/** Corners of faces or edges of tets, four numbers each. */
function partsOf(tets, parts) {
  const corners = [];
  for (let i = 0; i < tets.length; i += 4) {
    for (const part of parts) for (const corner of part) corners.push(tets[i + corner]);
  }
  return new Uint32Array(corners);
}

/** Of each label its triangles on the surface, and its walls to others, seen from outside of the region. */
function regionsOf(triangles, labels, walls, sides) {
  if (labels.length === 0) return [];
  const regions = about.labels.map((label) => ({...label, triangles: [], walls: []}));
  labels.forEach((label, i) => regions[label].triangles.push(triangles[3 * i], triangles[3 * i + 1], triangles[3 * i + 2]));
  for (let i = 0; i < walls.length / 3; ++i) {
    const [a, b, c] = walls.subarray(3 * i, 3 * i + 3);
    regions[sides[2 * i]].walls.push(a, b, c);
    regions[sides[2 * i + 1]].walls.push(a, c, b);
  }
  return regions.map((region) => ({...region, triangles: new Uint32Array(region.triangles), walls: new Uint32Array(region.walls)}));
}

/** Lengths are shares of the longest side of the box. */
async function readShape() {
  const numbers = new Numbers(await inflate(byId("shape").textContent));
  const shape = {places: numbers.places(about.vertices), triangles: numbers.rows(about.triangles, 3), tets: {}};
  const labels = about.labels.length > 1 ? numbers.rows(about.triangles, 1) : [];
  shape.regions = regionsOf(shape.triangles, labels, numbers.rows(about.walls, 3), numbers.rows(about.walls, 2));
  shape.edges = numbers.rows(about.edges, 2);
  for (const when of ["before", "after"]) {
    const tets = numbers.rows(about[`bad_${when}`], 4);
    shape.tets[when] = {count: tets.length / 4, faces: partsOf(tets, FACES), edges: partsOf(tets, EDGES)};
  }
  const low = [Infinity, Infinity, Infinity];
  const high = [-Infinity, -Infinity, -Infinity];
  for (let i = 0; i < shape.places.length; ++i) {
    low[i % 3] = Math.min(low[i % 3], shape.places[i]);
    high[i % 3] = Math.max(high[i % 3], shape.places[i]);
  }
  shape.ball = about.vertices > 0 ? {centre: mix(low, high, 0.5), radius: Math.max(length(subtract(high, low)) / 2, 1e-6)} : {centre: [0, 0, 0], radius: 1};
  shape.low = low;
  shape.high = high;
  return shape;
}
