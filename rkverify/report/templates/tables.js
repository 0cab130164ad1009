// Tables that can be sorted by a click on a column's head, and entries that can be found by words and by state.
"use strict";

function value(row, column) {
  const cell = row.cells[column];
  const text = cell.dataset.sort ?? cell.textContent.trim();
  const number = Number(text);
  return text !== "" && Number.isFinite(number) ? number : text;
}

function compare(a, b) {
  if (a === b) return 0;
  if (a === "" || b === "") return a === "" ? 1 : -1; // nothing comes last
  if (typeof a === typeof b && typeof a === "number") return a - b;
  return String(a).localeCompare(String(b), "en", { numeric: true });
}

function sortable(table) {
  const heads = [...table.tHead.rows[0].cells];
  const body = table.tBodies[0];
  heads.forEach((head, column) => {
    const button = document.createElement("button");
    button.type = "button";
    button.append(...head.childNodes);
    head.append(button);
    button.addEventListener("click", () => {
      const turn = head.getAttribute("aria-sort") === "ascending" ? -1 : 1;
      heads.forEach((other) => other.removeAttribute("aria-sort"));
      head.setAttribute("aria-sort", turn > 0 ? "ascending" : "descending");
      const rows = [...body.rows].sort((a, b) => turn * compare(value(a, column), value(b, column)));
      body.append(...rows);
    });
  });
}

// Pages have letters where a keyboard has their names: sigma is found as well as its letter, omega^2 as omega with a raised 2.
const GREEK = { psi: "ψ", phi: "φ", omega: "ω", sigma: "σ", rho: "ρ", lambda: "λ", delta: "δ", beta: "β", pi: "π", mu: "μ" };
const letters = (text) => text.toLowerCase().replace(/psi|phi|omega|sigma|rho|lambda|delta|beta|pi|mu/g, (name) => GREEK[name]).replace(/[\^_]/g, "");

function filtering(form) {
  const rows = [...document.getElementById(form.dataset.filters).tBodies[0].rows];
  const cards = new Map([...document.querySelectorAll("article.card")].map((card) => [card.id, card]));
  const texts = rows.map((row) => {
    const card = cards.get(row.dataset.id);
    return letters(`${row.textContent} ${card ? card.textContent : ""}`);
  });
  const show = () => {
    const words = letters(form.words.value).split(/\s+/).filter(Boolean);
    const state = form.state.value;
    let left = 0;
    rows.forEach((row, place) => {
      const fits = (!state || row.dataset.state === state) && words.every((word) => texts[place].includes(word));
      row.hidden = !fits;
      const card = cards.get(row.dataset.id);
      if (card) card.hidden = !fits;
      left += fits ? 1 : 0;
    });
    form.querySelector("output").textContent = `${left} of ${rows.length}`;
  };
  const follow = () => {
    // A link to an entry that is filtered away shows it again.
    const card = cards.get(location.hash.slice(1));
    if (card && card.hidden) {
      form.reset();
      show();
      card.scrollIntoView();
    }
  };
  form.hidden = false;
  form.addEventListener("input", show);
  form.addEventListener("submit", (event) => event.preventDefault());
  window.addEventListener("hashchange", follow);
  show();
}

document.querySelectorAll("table.sortable").forEach(sortable);
document.querySelectorAll("form.filter").forEach(filtering);
