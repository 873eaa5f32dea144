// Drag and drop of files and folders, with the bytes sent so far. Without it the form of the page does the same.
"use strict";
(() => {
  const form = document.getElementById("upload");
  const [drop, going, bar, much, stop, said] = ["drop", "going", "sent", "how-much", "stop", "upload-said"].map((id) =>
    document.getElementById(id));
  const largest = Number(form.dataset.largest);
  let request = null;

  // The files of something dropped, a folder's too, each with its path.
  async function filesOf(entry, path) {
    if (entry.isFile) {
      const file = await new Promise((take, refuse) => entry.file(take, refuse));
      return [[file, path + file.name]];
    }
    const reader = entry.createReader();
    const found = [];
    for (;;) { // a reader gives a hundred entries at a time
      const entries = await new Promise((take, refuse) => reader.readEntries(take, refuse));
      if (!entries.length) return found;
      for (const one of entries) found.push(...await filesOf(one, `${path}${entry.name}/`));
    }
  }

  function tell(sentence) {
    said.textContent = sentence;
    going.hidden = true;
    request = null;
  }

  function send(files) {
    if (request || !files.length) return;
    const size = files.reduce((sum, [file]) => sum + file.size, 0);
    if (size > largest) {
      tell(`${(size / 1e6).toFixed(0)} MB are too many at once: send the tests in several parts of ${largest / 1e6} MB.`);
      return;
    }
    const body = new FormData();
    for (const [file, name] of files) body.append("files", file, name);
    request = new XMLHttpRequest();
    request.open("POST", form.action);
    request.setRequestHeader("Accept", "application/json");
    request.responseType = "json";
    request.upload.addEventListener("progress", (event) => {
      bar.max = event.total;
      bar.value = event.loaded;
      much.textContent = `${(event.loaded / 1e6).toFixed(1)} of ${(event.total / 1e6).toFixed(1)} MB`;
    });
    request.addEventListener("load", () => {
      const answer = request.response || {};
      if (request.status < 300 && answer.at) window.location.assign(answer.at);
      else tell(answer.error || "It was not taken; send it again.");
    });
    request.addEventListener("error", () => tell("The connection broke; nothing was kept. Send it again."));
    request.addEventListener("abort", () => tell("Stopped; nothing was kept."));
    said.textContent = "";
    going.hidden = false;
    request.send(body);
  }

  const chosen = () => [...form.querySelectorAll("input[type=file]")].flatMap((input) =>
    [...input.files].map((file) => [file, file.webkitRelativePath || file.name]));

  form.querySelector(".drop-here").hidden = false;
  stop.addEventListener("click", () => request && request.abort());
  form.addEventListener("submit", (event) => {
    event.preventDefault();
    const files = chosen();
    if (files.length) send(files);
    else tell("Choose files or a folder first, or drop them here.");
  });
  for (const kind of ["dragover", "dragenter"]) drop.addEventListener(kind, (event) => {
    event.preventDefault();
    drop.classList.add("over");
  });
  drop.addEventListener("dragleave", () => drop.classList.remove("over"));
  drop.addEventListener("drop", async (event) => {
    event.preventDefault();
    drop.classList.remove("over");
    const entries = [...event.dataTransfer.items].map((item) => item.webkitGetAsEntry && item.webkitGetAsEntry());
    const plain = [...event.dataTransfer.files].map((file) => [file, file.name]);
    try {
      const all = entries.every(Boolean) && entries.length ? (await Promise.all(entries.map((one) => filesOf(one, "")))).flat() : plain;
      send(all);
    } catch {
      tell("What was dropped cannot be read; choose it with the button.");
    }
  });
})();
