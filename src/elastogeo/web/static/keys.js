// Keys for those who do not reach for the mouse. Every action they start is also a link or a button on the page.
"use strict";
(() => {
  const KEYS = [
    ["/", "search"],
    ["g f", "fleet"],
    ["g a", "alarms"],
    ["g p", "plans"],
    ["g u", "upload"],
    ["j, k", "next row, row before"],
    ["Enter", "open the row"],
    ["a", "acknowledge the alarm"],
    ["?", "these keys"],
  ];
  let waiting = 0;

  const home = () => document.querySelector(".top .home").getAttribute("href").replace(/\/$/, "");
  const go = (path) => location.assign(home() + path);

  // The links that open rows of tables and cards: those j and k go through.
  const rows = () =>
    [...document.querySelectorAll("main tbody tr, main [data-row]")]
      .map((row) => row.querySelector("a[href]"))
      .filter((link) => link && link.getClientRects().length);

  function step(by) {
    const links = rows();
    if (!links.length) return;
    const here = links.findIndex((link) => link.closest("tr, [data-row]").contains(document.activeElement));
    const next = here < 0 ? (by > 0 ? 0 : links.length - 1) : Math.min(Math.max(here + by, 0), links.length - 1);
    links[next].focus();
    links[next].scrollIntoView({ block: "nearest" });
  }

  function acknowledge() {
    const row = document.activeElement.closest("tr, [data-row], li, article");
    const found = (row && row.querySelector("[data-acknowledge]")) || document.querySelector("main [data-acknowledge]");
    if (!found) return;
    const details = found.closest("details");
    if (details) {
      details.open = true;
      (details.querySelector("textarea, input:not([type=hidden])") || found).focus();
    } else {
      found.focus();
      found.click();
    }
  }

  function list() {
    let dialog = document.getElementById("keys");
    if (!dialog) {
      dialog = document.createElement("dialog");
      dialog.id = "keys";
      dialog.setAttribute("aria-labelledby", "keys-title");
      const title = document.createElement("h2");
      title.id = "keys-title";
      title.textContent = "Keys";
      const names = document.createElement("dl");
      for (const [key, what] of KEYS) {
        const name = names.appendChild(document.createElement("dt"));
        name.appendChild(document.createElement("kbd")).textContent = key;
        names.appendChild(document.createElement("dd")).textContent = what;
      }
      const form = document.createElement("form");
      form.method = "dialog";
      form.appendChild(document.createElement("button")).textContent = "Close";
      dialog.append(title, names, form);
      document.body.appendChild(dialog);
    }
    if (!dialog.open) dialog.showModal();
  }

  const AFTER_G = { f: "/", a: "/alarms", p: "/plans", u: "/upload" };

  document.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || event.isComposing) return;
    if (event.target.closest("input, textarea, select, [contenteditable]") || document.querySelector("dialog[open]")) return;
    const second = Date.now() - waiting < 1500 ? AFTER_G[event.key] : undefined;
    waiting = 0;
    if (second) go(second);
    else if (event.key === "g") waiting = Date.now();
    else if (event.key === "/") document.querySelector(".find input").focus();
    else if (event.key === "j" || event.key === "k") step(event.key === "j" ? 1 : -1);
    else if (event.key === "a") acknowledge();
    else if (event.key === "?") list();
    else return;
    event.preventDefault();
  });

  // A choice that needs no button where there is a script.
  document.addEventListener("change", (event) => {
    if (event.target.matches("select[data-submits]")) event.target.form.requestSubmit();
  });
  document.documentElement.classList.add("scripted");
})();
