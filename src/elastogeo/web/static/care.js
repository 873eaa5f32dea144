// Alarms: the key a opens the first acknowledgement, or that of the alarm that has the focus.
document.addEventListener("keydown", (event) => {
  if (event.target.closest("input, textarea, select") || event.ctrlKey || event.metaKey || event.altKey) return;
  if (event.key !== "a") return;
  const here = event.target.closest(".alarm") || document;
  const form = (here.querySelector("[data-key=a]") || document.querySelector("[data-key=a]"))?.parentElement;
  if (!form) return;
  event.preventDefault();
  form.open = true;
  form.querySelector("textarea").focus();
});
