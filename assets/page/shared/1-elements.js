// Elements of a page.

const byId = (id) => document.getElementById(id);

/** An element with attributes, and with texts or elements in it. Texts are never markup. */
function make(name, attributes = {}, ...content) {
  const element = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) {
    if (key === "onclick") element.addEventListener("click", value); else element.setAttribute(key, value);
  }
  element.append(...content);
  return element;
}

function svgElement(name, attributes, text) {
  const element = document.createElementNS("http://www.w3.org/2000/svg", name);
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
  if (text !== undefined) element.textContent = text;
  return element;
}

/** A word at the foot of the page, for a moment. */
function say(text) {
  byId("said").textContent = text;
  byId("said").classList.add("on");
  setTimeout(() => byId("said").classList.remove("on"), 1800);
}
