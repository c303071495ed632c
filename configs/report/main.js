// Brings the page to life: tables at once, viewers when they come near the window.

function startViewer(root) {
  const description = JSON.parse(root.querySelector("script").textContent);
  root.append(document.getElementById("viewer-template").content.cloneNode(true));
  root.viewer = new Viewer(root, new ImageSet(description));
  root.viewer.change({});
}

const nearby = new IntersectionObserver((entries) => {
  for (const {isIntersecting, target} of entries) {
    if (!isIntersecting || target.viewer) continue;
    nearby.unobserve(target);
    startViewer(target);
  }
}, {rootMargin: "600px"});

for (const table of document.querySelectorAll("table.sortable")) makeSortable(table);
for (const root of document.querySelectorAll(".viewer")) nearby.observe(root);

// A pixel in a table leads to the last viewer before it.
document.addEventListener("click", (event) => {
  const link = event.target.closest(".pixel-link");
  if (!link) return;
  const before = Array.from(document.querySelectorAll(".viewer")).filter((viewer) => viewer.compareDocumentPosition(link) & Node.DOCUMENT_POSITION_FOLLOWING);
  before.at(-1)?.viewer?.showPixel(Number(link.dataset.x), Number(link.dataset.y));
});
