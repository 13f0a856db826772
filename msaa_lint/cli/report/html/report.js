"use strict";
// Runs in every report. Without it the page reads the same; only controls (`script-only`) are missing.
document.documentElement.classList.add("with-script");
