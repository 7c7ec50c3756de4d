// A row that a link leads to may lie in a part of the page that is folded away.
function unfold() {
  var target = location.hash && document.getElementById(location.hash.slice(1));
  for (var part = target; part; part = part.parentElement) if (part.tagName === "DETAILS") part.open = true;
  if (target) target.scrollIntoView({ block: "center" });
}
addEventListener("hashchange", unfold);
addEventListener("load", unfold);
// What is folded away to be read on paper is unfolded there.
addEventListener("beforeprint", function () {
  document.querySelectorAll("details.printed").forEach(function (part) { part.open = true; });
});
