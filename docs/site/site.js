// SPDX-License-Identifier: BSD-3-Clause
// The menu of narrow screens, and the search. `sections` is written by scripts/documentation: a place, a
// title and a text for every section of every page.
const menu = document.getElementById('menu');
document.body.classList.add('scripted'); // without a script the list of pages is always open
menu.addEventListener('click', () => {
  const open = menu.getAttribute('aria-expanded') !== 'true';
  menu.setAttribute('aria-expanded', `${open}`);
});

const search = document.getElementById('search');
const found = document.getElementById('found');
const MOST = 12;
let index;

function indexOfSections() {
  return lunr(function () {
    this.ref('place');
    this.field('title', {boost: 5});
    this.field('text');
    this.tokenizer.separator = /[^\p{L}\p{N}_]+/u; // fit_until is a word, and so is --check without its dashes
    sections.forEach((section) => this.add(section));
  });
}

/** Sections with all words, the last of which may be unfinished. */
function sectionsWith(words) {
  const terms = words.toLowerCase().split(/[^\p{L}\p{N}_]+/u).filter(Boolean);
  if (!terms.length) return [];
  index ??= indexOfSections();
  const matches = index.query((query) => {
    terms.forEach((term, i) => {
      const last = i === terms.length - 1;
      const required = {presence: lunr.Query.presence.REQUIRED};
      query.term(lunr.stemmer(new lunr.Token(term)).toString(), last
        ? {...required, wildcard: lunr.Query.wildcard.TRAILING, usePipeline: false} : {...required, usePipeline: false});
    });
  });
  return matches.slice(0, MOST).map((match) => sections.find((section) => section.place === match.ref));
}

search.addEventListener('input', () => {
  const matches = sectionsWith(search.value);
  found.replaceChildren(...matches.map((section) => {
    const link = document.createElement('a');
    link.href = section.place;
    link.textContent = section.title;
    const item = document.createElement('li');
    item.append(link);
    return item;
  }));
  if (search.value.trim() && !matches.length) found.textContent = 'Nothing found.';
  found.hidden = !search.value.trim();
});
found.addEventListener('click', () => { found.hidden = true; });
