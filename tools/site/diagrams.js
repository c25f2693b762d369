// Draws the blocks ```mermaid of the pages with Mermaid.
document.addEventListener("DOMContentLoaded", () => {
  const blocks = document.querySelectorAll("pre > code.language-mermaid");
  for (const block of blocks) {
    const diagram = document.createElement("div");
    diagram.className = "mermaid";
    diagram.textContent = block.textContent;
    block.parentElement.replaceWith(diagram);
  }
  if (blocks.length > 0) {
    mermaid.initialize({ startOnLoad: false });
    mermaid.run();
  }
});
