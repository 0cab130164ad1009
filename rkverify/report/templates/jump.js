// A field on every page that leads to an entry by its number: C43, 80 in parentheses or E80, Fig. 7.
"use strict";

(() => {
  const form = document.querySelector("form.jump");
  const KINDS = [["claims", "C", /^c(?:laim)?$/], ["equations", "E", /^e(?:q|qn|quation)?$/], ["figures", "F", /^f(?:ig|igure)?$/]];
  const here = KINDS.find(([page]) => location.pathname.endsWith(`/${page}.html`));

  function wanted(text) {
    const found = /^([a-z]*)[\s.]*(\(?)\s*(\d+)\s*\)?$/.exec(text.trim().toLowerCase());
    if (!found) return null;
    const [, word, bracket, digits] = found;
    // A number in parentheses is an equation's; one alone is of the page that the reader is on.
    const kind = word ? KINDS.find(([, , name]) => name.test(word)) : bracket ? KINDS[1] : here;
    const number = Number(digits);
    return kind && number >= 1 && number <= Number(form.dataset[kind[0]]) ? `${kind[0]}.html#${kind[1]}${number}` : null;
  }

  form.addEventListener("submit", (event) => {
    event.preventDefault();
    const target = wanted(form.entry.value);
    form.querySelector("output").textContent = target ? "" : "no such entry: write C43, (80) or Fig. 7";
    if (target) location.href = target;
  });
  form.hidden = false;
})();
