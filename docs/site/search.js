// SPDX-License-Identifier: MIT
// The search shows where a word stands. It reads the pages that it has found, which a browser allows from a server alone:
// of a site that was opened as a file, texts.js has the words of all pages, and answers in place of the file.
if (location.protocol === "file:" && typeof TETMEND_TEXTS !== "undefined") {
  const folder = new URL(DOCUMENTATION_OPTIONS.URL_ROOT || "./", location.href).href;
  const fetchFromServer = window.fetch;
  window.fetch = (address, ...more) => {
    const page = new URL(address, location.href).href.slice(folder.length).replace(/[#?].*/, "");
    if (!(page in TETMEND_TEXTS)) return fetchFromServer(address, ...more);
    const main = document.createElement("div");
    main.setAttribute("role", "main");
    main.textContent = TETMEND_TEXTS[page];
    return Promise.resolve(new Response(main.outerHTML));
  };
}
