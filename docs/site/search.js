// SPDX-License-Identifier: MIT
// Excerpts of the pages that a search finds are read from these pages, which a browser allows from a
// server alone. Opened as a file the search lists the pages without.
DOCUMENTATION_OPTIONS.SHOW_SEARCH_SUMMARY = location.protocol !== "file:";
