"use strict";
// Runs in every report. Without it the page reads the same; only controls (`script-only`) are missing.
document.documentElement.classList.add("with-script");

// The place that the fragment names; null if there is none.
const target = () => {
  try {
    return document.getElementById(decodeURIComponent(location.hash.slice(1)));
  } catch {
    return null; // not the encoding of a text
  }
};

// The filters of findings. Their state is the fragment (#severity=error&text=resolve), so that it can be sent, and the back button undoes it.
(() => {
  const form = document.getElementById("filters");
  if (!form) return;
  const findings = [...document.querySelectorAll(".finding")];
  const places = findings.map((finding) => finding.parentNode);
  const texts = new Map();
  const byPrice = document.getElementById("by-price");
  const count = document.getElementById("count");
  const fields = [...form.elements].filter((field) => field.name);
  let sorted = false;

  const text = (finding) => {
    if (!texts.has(finding)) texts.set(finding, finding.textContent.toLowerCase());
    return texts.get(finding);
  };

  const state = () => {
    const values = new URLSearchParams();
    for (const field of fields) if (field.value) values.set(field.name, field.value);
    return values.toString();
  };

  const matches = (finding, values) =>
    ["severity", "confidence", "rule", "input"].every((name) => !values[name] || finding.dataset[name] === values[name]) &&
    (!(values.price > 0) || Number(finding.dataset.price) >= Number(values.price)) &&
    (!values.text || text(finding).includes(values.text.toLowerCase()));

  const sort = (wanted) => {
    if (wanted === sorted) return;
    sorted = wanted;
    if (wanted) {
      const ordered = [...findings].sort((a, b) => b.dataset.price - a.dataset.price);
      byPrice.append(...ordered);
    } else {
      findings.forEach((finding, number) => places[number].append(finding));
    }
    byPrice.hidden = !wanted;
  };

  const show = () => {
    const values = Object.fromEntries(fields.map((field) => [field.name, field.value]));
    let shown = 0;
    for (const finding of findings) {
      finding.hidden = !matches(finding, values);
      shown += !finding.hidden;
    }
    sort(values.sort === "price");
    for (const section of document.querySelectorAll(".group, .input")) {
      section.hidden = !section.querySelector(".finding:not([hidden])");
    }
    count.textContent = `${shown} of ${findings.length} findings`;
  };

  // A fragment without `=` is a place of the page, and leaves the filters as they are.
  const read = () => {
    const fragment = location.hash.slice(1);
    if (fragment && !fragment.includes("=")) {
      const place = target();
      if (place && place.closest("[hidden]")) form.reset();
      return;
    }
    const values = new URLSearchParams(fragment);
    for (const field of fields) {
      field.value = values.get(field.name) || "";
      if (field.tagName === "SELECT" && field.selectedIndex < 0) field.value = "";
    }
    show();
  };

  const write = (replace) => {
    const address = "#" + state();
    if (address === (location.hash || "#")) return;
    history[replace ? "replaceState" : "pushState"](null, "", address);
  };

  form.addEventListener("submit", (event) => event.preventDefault());
  form.addEventListener("input", (event) => {
    show();
    write(event.target.tagName === "INPUT");
  });
  form.addEventListener("reset", () => setTimeout(() => { show(); write(false); }));
  addEventListener("popstate", read);
  addEventListener("hashchange", read);
  show();
  read();
})();

// The page of a rule, or whatever a link leads to, opens.
(() => {
  const open = () => {
    const place = target();
    if (!place) return;
    for (let element = place; element; element = element.parentElement) if (element.tagName === "DETAILS") element.open = true;
    place.scrollIntoView();
  };
  addEventListener("hashchange", open);
  open();
})();

// What scrolls sideways can be scrolled by keyboard; what prints is open.
(() => {
  // What is not in the window has no layout yet: of a long page, it is done as time allows.
  const sources = [...document.querySelectorAll(".source")];
  const focusable = (element) => element.scrollWidth > element.clientWidth;
  const rest = (deadline) => {
    while (sources.length && deadline.timeRemaining() > 5) {
      const element = sources.shift();
      if (focusable(element)) element.tabIndex = 0;
    }
    if (sources.length) requestIdleCallback(rest);
  };
  for (const element of sources.splice(0, 50).filter(focusable)) element.tabIndex = 0;
  if (sources.length && window.requestIdleCallback) requestIdleCallback(rest);
  addEventListener("beforeprint", () => {
    for (const element of document.querySelectorAll("details.frame, details.state, .finding details")) element.open = true;
  });
})();
