// Light and dark, on the screen and on paper.

const wantedTheme = () => (matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "light");

function setTheme(theme) {
  document.documentElement.dataset.theme = theme;
  byId("theme").textContent = theme === "dark" ? "Light" : "Dark";
  cssColours.clear();
}

function toggleTheme(show) {
  setTheme(document.documentElement.dataset.theme === "dark" ? "light" : "dark");
  show();
}

/** Follows the system; paper is white. `show` draws all again, without delay if its argument is true. */
function watchLooks(show, drawForPrint) {
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => { setTheme(wantedTheme()); show(); });
  let screenTheme = "light";
  matchMedia("print").addEventListener("change", (event) => {
    if (event.matches) screenTheme = document.documentElement.dataset.theme;
    setTheme(event.matches ? "light" : screenTheme);
    show(true);
    if (event.matches) drawForPrint();
  });
}
