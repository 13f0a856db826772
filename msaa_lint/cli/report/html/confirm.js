"use strict";
// Sliders between the pictures as written and fixed. Without them the two are beside each other.
for (const box of document.querySelectorAll(".compare")) {
  const pair = box.querySelector(".pair"), input = box.querySelector("input");
  const cut = () => {
    pair.style.setProperty("--cut", `${input.value}%`);
    input.setAttribute("aria-valuetext", `as written on the left ${input.value} %, fixed on the right ${100 - input.value} %`);
  };
  input.addEventListener("input", cut);
  // A click or a drag on the picture moves the slider.
  const point = (event) => {
    if (event.type === "pointermove" && !event.buttons) return;
    const place = pair.getBoundingClientRect();
    input.value = Math.round((100 * (event.clientX - place.left)) / place.width);
    cut();
  };
  for (const name of ["pointerdown", "pointermove"]) pair.addEventListener(name, point);
  pair.addEventListener("dragstart", (event) => event.preventDefault());
  cut();
}
