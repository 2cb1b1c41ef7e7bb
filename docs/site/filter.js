// The gallery's filter: a text and a kind; without script all problems are shown.
document.addEventListener("DOMContentLoaded", () => {
  const text = document.querySelector("#problem-text"), kind = document.querySelector("#problem-kind");
  if (!text || !kind) return;
  const show = () => {
    for (const item of document.querySelectorAll(".problems > a")) {
      const fits = item.textContent.toLowerCase().includes(text.value.toLowerCase());
      item.hidden = !fits || (kind.value !== "" && !item.dataset.kind.split(" ").includes(kind.value));
    }
  };
  text.addEventListener("input", show);
  kind.addEventListener("input", show);
});

// Wide tables scroll by the keyboard too, and the search button is called what is written on it.
document.addEventListener("DOMContentLoaded", () => {
  for (const table of document.querySelectorAll(".pst-scrollable-table-container > table, .da-wide, .da-wide > table")) {
    table.tabIndex = 0;
  }
  for (const button of document.querySelectorAll(".search-button-field")) {
    button.setAttribute("aria-label", button.textContent.trim().replace(/\s+/g, " ") || "Search");
  }
});
