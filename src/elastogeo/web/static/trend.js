// What a test says where the trend is pointed at, or walked through by the arrow keys; Enter or a click opens the test.
"use strict";
(() => {
  const marks = (figure) => [...figure.querySelectorAll("svg .mark")].filter((mark) => mark.getClientRects().length);

  function tell(figure, mark) {
    for (const other of figure.querySelectorAll(".mark.near")) other.classList.remove("near");
    figure.querySelector(".reading").textContent = mark ? mark.querySelector("title").textContent : "";
    if (mark) mark.classList.add("near");
  }

  function nearest(figure, event) {
    let best = null;
    let least = 40;
    for (const mark of marks(figure)) {
      const box = mark.getBoundingClientRect();
      const across = Math.abs(box.left + box.width / 2 - event.clientX);
      const down = Math.abs(box.top + box.height / 2 - event.clientY);
      const away = across + down / 20;
      if (across < 24 && away < least) [best, least] = [mark, away];
    }
    return best;
  }

  function open(figure) {
    const mark = figure.querySelector(".mark.near");
    if (mark && mark.dataset.key) location.assign(figure.dataset.tests + mark.dataset.key);
  }

  document.addEventListener("pointermove", (event) => {
    const figure = event.target.closest && event.target.closest("figure.trend");
    if (figure && event.target.closest("svg")) tell(figure, nearest(figure, event));
  });
  document.addEventListener("click", (event) => {
    const figure = event.target.closest && event.target.closest("figure.trend");
    if (figure && event.target.closest("svg .mark.near")) open(figure);
  });
  document.addEventListener("keydown", (event) => {
    const figure = event.target.closest && event.target.closest("figure.trend");
    if (!figure || !event.target.matches(".wide")) return;
    const every = marks(figure);
    const here = every.findIndex((mark) => mark.classList.contains("near"));
    const next = { ArrowRight: here + 1, ArrowLeft: here < 0 ? every.length - 1 : here - 1, Home: 0, End: every.length - 1 };
    if (event.key in next) tell(figure, every[Math.min(Math.max(next[event.key], 0), every.length - 1)]);
    else if (event.key === "Enter") open(figure);
    else return;
    event.preventDefault();
  });

  // Another indicator was chosen: its heading takes the focus, so that a screen reader says what came.
  document.addEventListener("htmx:after:swap", () => {
    const heading = document.getElementById("trend");
    if (heading && (!document.activeElement || document.activeElement === document.body)) heading.focus({ preventScroll: true });
  });
})();
