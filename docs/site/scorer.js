// SPDX-License-Identifier: MIT
// What a search lists first: pages that show how something is done, then those that say all about it, then
// names of the references, then history and measurements. Who types a name of a program, such as
// tetmend_set_group or Options::goal, is after that name.
var Scorer = (() => {
  const GUIDES = /^(howto\/.*|start|install|choosing|report|troubleshooting|python|library|c|layers|surface|pieces|viewer)$/;
  const REFERENCES = /^(cpp\/.*|cpp|.*-reference)$/;
  const BACKGROUND = /^(results\/.*|changes|contributing|dependencies|deviations|experiments|glossary|portability|reliability)$/;
  const SECTION = 40;  // from here on the words are the title of a page or a section
  const query = new URLSearchParams(window.location.search).get("q") ?? "";
  const isOfProgram = /[_:.()]/.test(query.trim());

  function score([page, title, , description, found]) {
    if (isOfProgram) return / parameter, /.test(description ?? "") ? found - 10 : found;
    if (GUIDES.test(page)) return found + (page.startsWith("howto/") ? 25 : 20);
    if (description) return found - (/ parameter, /.test(description) ? 40 : 8);
    if (REFERENCES.test(page)) return found < SECTION ? found - 4 : found - 75;
    if (BACKGROUND.test(page)) return found < SECTION ? found - 4 : found - 40;
    return found + 10;
  }

  // All but `score` are the values of Sphinx.
  return {score, objNameMatch: 11, objPartialMatch: 6, objPrio: {0: 15, 1: 5, 2: -5}, objPrioDefault: 0,
    title: 15, partialTitle: 7, term: 5, partialTerm: 2};
})();
