/* In place of the theme's own script, which stops at the load of each page: it asks for a search that is not there. */
function keepClearOfMenu() {
    /* The menu is fixed above the page and grows with its lines: places that a link leads to stay below it. */
    var offset = document.querySelector("body > .container").offsetTop + "px";
    document.documentElement.style.scrollPaddingTop = offset;
    document.querySelectorAll(".bs-sidebar.affix").forEach(function (sidebar) { sidebar.style.top = offset; });
}

document.addEventListener("DOMContentLoaded", keepClearOfMenu);
window.addEventListener("resize", keepClearOfMenu);
new bootstrap.ScrollSpy(document.body, { target: ".bs-sidebar" });
