// Looks that a reader chose go on to the next page: by storage, and by links, as files may share none.

const LOOKS = {size: ["normal", "large"], theme: ["auto", "light", "dark"]};
const kept = {};  // by name; a look that was never chosen has no entry

const themeOf = (system) => kept.theme === "light" || kept.theme === "dark" ? kept.theme : system;

function keepLook(name, value) {
  if (!LOOKS[name].includes(value)) return;
  kept[name] = value;
  try { localStorage.setItem(`tetmend-${name}`, value); } catch { /* a page within a page may have none */ }
  for (const link of document.querySelectorAll(".links a, .list a")) link.search = new URLSearchParams(kept);
}

function storedLook(name) {
  try { return localStorage.getItem(`tetmend-${name}`); } catch { return null; }
}

/** The link is believed before the storage; looks do not stay in the address, which readers hand on. */
function findLooks() {
  const asked = new URLSearchParams(location.search);
  const isAsked = Object.keys(LOOKS).some((name) => asked.has(name));
  for (const name of Object.keys(LOOKS)) {
    keepLook(name, asked.get(name) ?? storedLook(name));
    asked.delete(name);
  }
  document.documentElement.dataset.size = kept.size === "large" ? "large" : "";
  const rest = String(asked);
  if (isAsked) history.replaceState(null, "", location.pathname + (rest ? `?${rest}` : "") + location.hash);
}
