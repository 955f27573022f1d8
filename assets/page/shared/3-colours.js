// Colours: of qualities, and those of the style sheet.

const BEST_QUALITY = 2;  // of the scale of colours; 1 is the goal
// Dark red for the worst, blue for the best; bad tets have a red of their own.
const EMBER = [[122, 24, 70], [196, 58, 62], [238, 124, 60], [250, 196, 104], [206, 222, 158], [112, 182, 180], [48, 112, 164]];
const BAD = [222, 32, 38];

function colourOfQuality(quality) {
  if (quality < 1) return BAD;
  const x = Math.min(Math.max(quality / BEST_QUALITY, 0), 1) * (EMBER.length - 1);
  const i = Math.min(Math.floor(x), EMBER.length - 2);
  return EMBER[i].map((c, n) => Math.round(c + (EMBER[i + 1][n] - c) * (x - i)));
}

const cssColours = new Map();
/** A variable of the style sheet as red, green, blue. */
function colourOf(name) {
  if (!cssColours.has(name)) {
    const text = getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
    const n = parseInt(text.slice(1), 16);
    cssColours.set(name, [n >> 16 & 255, n >> 8 & 255, n & 255]);
  }
  return cssColours.get(name);
}
const inCss = (colour) => `rgb(${colour.join(" ")})`;
